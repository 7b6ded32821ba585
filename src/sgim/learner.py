"""The learner: algorithm 1.4.1 of the thesis as a pure state machine.

It never sees an environment, a teacher or a clock. It emits plans and is told what happened;
whoever drives it has the world. Every decision and every message is an event, handed to
``record`` in order; `sgim.replay` folds recorded events back into a learner.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from sgim import demonstrations, ledger
from sgim.errors import SgimError, TeacherError, unknown
from sgim.events import (
    Answered,
    Available,
    Closed,
    Demonstrated,
    Ended,
    Ending,
    Event,
    Observed,
    Opened,
    Planned,
    Suggested,
    Told,
)
from sgim.ledger import Ledger, Running
from sgim.outcome.interest import EpisodeReport
from sgim.policy.explorer import Episode
from sgim.policy.model import CompetenceModel, InverseModel
from sgim.records import Demonstration, Goal, Outcome, Plan, Report, Solution, Trial
from sgim.strategy.modes import Mode
from sgim.strategy.strategy import Strategy
from sgim.streams import Streams
from sgim.task import Task


class Learner:
    """Chooses each episode what to aim at and how to learn it, and learns from what it is told.

    Args:
        task: The spaces of the world.
        strategy: Chooses modes and goals, with the interest map it uses.
        model: Learns from trials; answers for goals if it is an inverse model too.
        seed: Of all the learner's random streams.
        recipe: How to make this learner again: a JSON-compatible mapping, kept in the journal.

    Attributes:
        record: Called with every event as it happens; set by whoever keeps the journal.
        movements: Trials executed so far, whether they told something or failed.
        folding: Whether recorded events are being folded, which say themselves when the
            episodes end whose explorers are not in use.
    """

    def __init__(
        self,
        task: Task,
        strategy: Strategy,
        model: CompetenceModel,
        *,
        seed: int = 0,
        recipe: Mapping[str, Any] | None = None,
    ) -> None:
        self.task = task
        self.strategy = strategy
        self.model = model
        self.streams = Streams(seed)
        self.recipe = None if recipe is None else dict(recipe)
        self.record: Callable[[Event], None] | None = None
        self.movements = 0
        self.folding = False
        self.ledger = Ledger()
        self._rng = (-1, self.streams("learner"))
        self._absent: set[str] = set()
        self._suggestions: deque[Goal] = deque()
        self._given: deque[Demonstration] = deque()

    @property
    def seed(self) -> int:
        """The seed of the learner's random streams."""
        return self.streams.seed

    @property
    def teachers(self) -> tuple[str, ...]:
        """Names of the teachers that the learner's modes may ask."""
        names = (m.teacher for m in self.strategy.modes.values() if m.teacher is not None)
        return tuple(dict.fromkeys(names))

    @property
    def pending(self) -> list[Plan]:
        """The plans that are out, oldest first."""
        return [plan for _, (plan, _) in sorted(self.ledger.plans.items())]

    # Deciding.

    def ask(self, context: Any = None) -> Plan:
        """Decide what to do next.

        Args:
            context: The present context, if the task has contexts.

        Returns:
            A plan with a policy to try, or with a request to a teacher.
        """
        context = self.task.check_context(context)
        if self.ledger.has_idle:
            running = self.resumed(self.ledger.oldest_idle(), context)
        else:
            event = self.decide_opening(context)
            running = self.open(event)
            self._emit(event)
        policy = None if running.must_ask else running.mode.explorer.propose([running.episode])[0]
        return self.issue(running, policy)

    def ask_batch(self, n: int, contexts: Sequence[Any] | None = None) -> list[Plan]:
        """Decide n plans that can be carried out side by side.

        Open episodes that wait for nothing come first, oldest first; then new ones. The plans
        are those that n calls of `ask` would give, at one pass through the explorers.

        Args:
            n: How many.
            contexts: One context for each, if the task has contexts.

        Raises:
            ValueError: If n is below 1, or there is not one context for each.
        """
        given = [None] * n if contexts is None else list(contexts)
        if n < 1 or len(given) != n:
            raise ValueError(f"ask_batch({n}) came with {len(given)} contexts; expected n ≥ 1 each")
        opened: list[Opened | None] = []
        chosen: list[Running] = []
        for context in [self.task.check_context(c) for c in given]:
            if self.ledger.has_idle:
                opened.append(None)
                chosen.append(self.resumed(self.ledger.oldest_idle(), context))
            else:
                event = self.decide_opening(context)
                opened.append(event)
                chosen.append(self.open(event))
        policies = _propose([r for r in chosen if not r.must_ask])
        plans = []
        for opening, running in zip(opened, chosen, strict=True):
            if opening is not None:
                self._emit(opening)
            plans.append(self.issue(running, None if running.must_ask else next(policies)))
        return plans

    def decide_opening(self, context: Any) -> Opened:
        """Decide the next episode's mode and goal, without opening it."""
        number = self.ledger.next_episode
        if self._given:
            demonstration = self._given[0]
            goal = Goal(*next(iter(demonstration.outcome.items())))
            mode = self._mode_for(demonstration)
            return Opened(number, mode.name, goal, context, "demonstration")
        self._rng = number, self.streams("learner", number)
        mode, chosen = self.strategy.choose(self._rng[1], self._absent, context)
        if self._suggestions:
            mode = self.strategy.alone if mode.pursues == "nothing" else mode
            return Opened(number, mode.name, self._suggestions[0], context, "suggestion")
        return Opened(number, mode.name, chosen, context, "strategy")

    def _mode_for(self, demonstration: Demonstration) -> Mode:
        """How to learn from an unasked demonstration: as from its teacher, mimicry first."""
        modes = [m for m in self.strategy.modes.values() if m.teacher == demonstration.teacher]
        usable = [m for m in modes if m.pursues == "chosen" and demonstration.policy is not None]
        usable += [m for m in modes if m.pursues == "demonstrated"]
        return usable[0] if usable else self.strategy.alone

    def mode(self, name: str) -> Mode:
        """The mode of this name; `UnknownNameError` if there is none."""
        if name == self.strategy.alone.name:
            return self.strategy.modes.get(name, self.strategy.alone)
        mode = self.strategy.modes.get(name)
        if mode is None:
            raise unknown("mode", name, [*self.strategy.modes, self.strategy.alone.name])
        return mode

    def open(self, event: Opened, *, live: bool = True) -> Running:
        """Open the episode that was decided; ``live`` if its explorer is to be used."""
        number = event.episode
        self.ledger.next_episode = number + 1
        # The choice was drawn from the episode's own stream, which goes on from there.
        decided, rng = self._rng
        if decided != number:
            rng = self.streams("learner", number)
        episode = Episode(number, event.goal, event.context, rng)
        running = Running(self.mode(event.mode), event.goal, event.context, episode, live)
        self.ledger.running[number] = running
        if event.cause == "suggestion":
            self._suggestions.popleft()
        elif event.cause == "demonstration":
            episode.demonstration = self._given.popleft()
        if not running.must_ask:
            self._take_up(running)
        return running

    def _take_up(self, running: Running) -> None:
        """Pursue the goal, now that all there is to know about it is known."""
        episode, mode = running.episode, running.mode
        if mode.pursues == "nothing":
            episode.goal = None
        elif mode.pursues == "demonstrated" and episode.demonstration is not None:
            outcome = episode.demonstration.outcome
            kind = running.chosen.kind if running.chosen is not None else ""
            kind = kind if kind in outcome else next(iter(outcome))
            episode.goal = Goal(kind, outcome[kind])
        if running.live:
            if episode.goal is not None:
                competence = self.model.competence(episode.goal, episode.context)
                episode.before = episode.best = competence
            mode.explorer.begin(episode)

    def resumed(self, running: Running, context: Any) -> Running:
        """An open episode in the present context; its search begins anew if that has changed."""
        if self.task.context_space is not None:
            space = self.task.context_space
            if space.pack(context) != space.pack(running.episode.context):
                running.episode.context = context
                if running.live:
                    running.mode.explorer.begin(running.episode)
        return running

    def issue(self, running: Running, policy: Any) -> Plan:
        """Give out an episode's next plan: this policy, or a request if it must ask."""
        teacher = running.mode.teacher if running.must_ask else None
        plan = self.ledger.give_out(running, policy, teacher)
        if self.record is not None:
            self.record(Planned(plan))
        return plan

    # Being told.

    def answer(
        self, plan: Plan, demonstration: Demonstration | None, *, seconds: float | None = None
    ) -> Plan:
        """Give a teacher's answer to a request.

        Without a demonstration the episode goes on alone, for the goal that was chosen.

        Args:
            plan: A plan of this learner that holds a request and is still out.
            demonstration: What was shown, or None if the teacher declines.
            seconds: The teacher's time that it took, if known.

        Returns:
            The plan that follows, with a policy to try.

        Raises:
            TeacherError: If the demonstration is unusable; the request is still out then.
            PlanError: If the plan is not out, or holds no request.
        """
        running = self.ledger.out(plan, request=True)
        usable = None
        if demonstration is not None:
            assert plan.request is not None
            usable = demonstrations.checked(self.task, demonstration, plan.request.teacher)
            if running.mode.pursues == "chosen" and usable.policy is None:
                raise TeacherError(
                    f"mode {running.mode.name!r} needs a demonstration with a policy or a "
                    "trajectory; this one has only an outcome"
                )
        self._emit(Answered(plan.id, usable, seconds))
        self.learn_answer(plan, running, usable)
        return self.issue(running, running.mode.explorer.propose([running.episode])[0])

    def learn_answer(
        self, plan: Plan, running: Running, demonstration: Demonstration | None
    ) -> None:
        """Take up a demonstration, or the goal chosen if there is none."""
        status = ledger.EXPIRED if demonstration is None else ledger.ANSWERED
        self.ledger.resolve(plan, status)
        if demonstration is None:
            running.mode = self.strategy.alone
        running.episode.demonstration = demonstration
        self._take_up(running)

    def tell(self, plan: Plan, outcome: Outcome, *, seconds: float | None = None) -> Report:
        """Say what a plan's policy produced.

        Args:
            plan: A plan of this learner that holds a policy and is still out.
            outcome: Kind → point, empty if nothing was produced.
            seconds: The robot's time that it took, if known.

        Returns:
            The cost of this trial and the progress of its episode.

        Raises:
            SpaceError: If the outcome is malformed; the plan is still out then.
            PlanError: If the plan is not out, or holds a request.
        """
        running = self.ledger.out(plan, request=False)
        outcome = self.task.check_outcome(outcome)
        if self.record is not None:
            self.record(Told(plan.id, outcome, seconds))
        return self.learn_trial(plan, running, Trial(plan.policy, outcome, plan.context))

    def learn_trial(self, plan: Plan, running: Running, trial: Trial) -> Report:
        """Learn from a trial of an open episode."""
        self.ledger.resolve(plan, ledger.TOLD)
        self.model.update(trial)
        self.movements += 1
        episode, goal = running.episode, running.episode.goal
        episode.movements += 1
        shown: float | None = None
        if running.live:
            if goal is not None and episode.best is not None:
                shown = self.model.shown_by(trial, goal, episode.context)
                if shown is None:
                    episode.best = self.model.competence(goal, episode.context)
                elif shown > episode.best:
                    episode.best = shown
            running.mode.explorer.learn(episode, trial, shown)
        closed = self._resolved(running)
        progress = None
        if closed and episode.best is not None and episode.before is not None:
            progress = episode.best - episode.before
        return Report(None if shown is None else -shown, episode.best, closed, progress)

    def fail(self, plan: Plan, reason: str) -> None:
        """Say that the world broke while a plan was carried out: it teaches nothing."""
        self._end(plan, "failed", reason)

    def refuse(self, plan: Plan, reason: str) -> None:
        """Say that a safety check refused a plan: it counts against the plan, not the goal."""
        self._end(plan, "refused", reason)

    def expire(self, plan: Plan, reason: str = "nobody carried it out in time") -> None:
        """Say that a plan will not be carried out any more.

        An expired request is an unanswered one: its episode goes on alone.
        """
        self._end(plan, "expired", reason)

    def lose(self, plan: Plan, reason: str = "started, and never heard of again") -> None:
        """Say that nobody knows what became of a plan; it is never silently repeated."""
        self._end(plan, "lost", reason)

    def _end(self, plan: Plan, how: Ending, reason: str) -> None:
        running = self.ledger.out(plan)
        self._emit(Ended(plan.id, how, reason))
        self.learn_end(plan, running, how)

    def learn_end(self, plan: Plan, running: Running, how: Ending) -> None:
        """Resolve a plan that has no outcome."""
        if plan.request is not None:
            self.learn_answer(plan, running, None)
            self.ledger.make_idle(running)
            return
        self.ledger.resolve(plan, _STATUS[how])
        if how == "failed":
            self.movements += 1
        elif how == "refused" and running.live:
            running.mode.explorer.refuse(running.episode)
        self._resolved(running)

    def _resolved(self, running: Running) -> bool:
        """After a plan: close its episode if that has ended, else make it idle."""
        episode = running.episode
        episode.attempts += 1
        if not running.live:
            ended = not self.folding
        else:
            ended = episode.attempts >= running.mode.budget or (
                episode.movements > 0 and running.mode.explorer.finished(episode)
            )
        if ended:
            self.close(running)
            return True
        self.ledger.make_idle(running)
        return False

    def close(self, running: Running) -> None:
        """Close an episode, and let the strategy learn from what it came to."""
        e = running.episode
        event = Closed(e.id, running.mode.name, e.goal, e.before, e.best, e.movements)
        self._emit(event)
        self.credit(running, event)

    def credit(self, running: Running, closed: Closed) -> None:
        """Forget a closed episode, and report it to the strategy if it attempted a goal."""
        del self.ledger.running[closed.episode]
        goal, before, after = closed.pursued, closed.before, closed.after
        if goal is None or before is None or after is None or not closed.movements:
            return
        report = EpisodeReport(
            closed.episode,
            closed.mode,
            running.chosen or goal,
            goal,
            running.context,
            before,
            after,
            closed.movements,
            running.episode.demonstration,
        )
        self.strategy.update(report)

    # Being told unasked.

    def observe(self, trial: Trial) -> None:
        """Learn from a trial made elsewhere, such as another run's: a warm start."""
        task = self.task
        known = Trial(
            task.check_policy(trial.policy),
            task.check_outcome(trial.outcome),
            task.check_context(trial.context),
        )
        self._emit(Observed(known))
        self.model.update(known)

    def demonstrate(self, demonstration: Demonstration) -> None:
        """Take an unasked demonstration; the next new episode learns from it."""
        usable = demonstrations.checked(self.task, demonstration, demonstration.teacher)
        self._emit(Demonstrated(usable))
        self._given.append(usable)

    def suggest(self, kind: str, point: Any) -> None:
        """Suggest a goal; the next new episode takes it up, in the mode that it would choose."""
        goal = self.task.check_goal(kind, point)
        self._emit(Suggested(goal))
        self._suggestions.append(goal)

    def set_available(self, teacher: str, yes: bool) -> None:
        """Say whether a teacher can be asked; new episodes do not ask one who is away."""
        if teacher not in self.teachers:
            raise unknown("teacher", teacher, self.teachers)
        self._emit(Available(teacher, yes))
        self.note_available(teacher, yes)

    def note_available(self, teacher: str, yes: bool) -> None:
        """Change the set of absent teachers."""
        (self._absent.discard if yes else self._absent.add)(teacher)

    def take_unasked(self, event: Observed | Demonstrated | Suggested | Available) -> None:
        """Fold one recorded message that was not about a plan."""
        match event:
            case Observed(trial):
                self.model.update(trial)
            case Demonstrated(demonstration):
                self._given.append(demonstration)
            case Suggested(goal):
                self._suggestions.append(goal)
            case Available(teacher, yes):
                self.note_available(teacher, yes)

    def _emit(self, event: Event) -> None:
        if self.record is not None:
            self.record(event)

    # Using what was learned.

    def competence(self, kind: str, point: Any, context: Any = None) -> float:
        """Competence for a goal, in the model's range ([−1, 0] for memories)."""
        goal = self.task.check_goal(kind, point)
        return self.model.competence(goal, self.task.check_context(context))

    def best_policy(self, kind: str, point: Any, context: Any = None) -> Any:
        """The policy to execute for a goal; `NoAnswerError` if nothing is known."""
        goal = self.task.check_goal(kind, point)
        return self._inverse.best_policy(goal, self.task.check_context(context))

    def best_policies(
        self, kind: str, points: Sequence[Any], contexts: Sequence[Any] | None = None
    ) -> list[Any]:
        """As `best_policy` for many goals of a kind at once; None where nothing is known."""
        goals = [self.task.check_goal(kind, p) for p in points]
        given = [None] * len(goals) if contexts is None else contexts
        return self._inverse.best_policies(goals, [self.task.check_context(c) for c in given])

    def solve(self, kind: str, point: Any, context: Any = None) -> Solution:
        """The policy for a goal, what it should produce, and how sure that is."""
        goal = self.task.check_goal(kind, point)
        return self._inverse.solve(goal, self.task.check_context(context))

    @property
    def _inverse(self) -> InverseModel:
        if not isinstance(self.model, InverseModel):
            raise SgimError(f"{type(self.model).__name__} does not answer with policies")
        return self.model


_STATUS = {
    "failed": ledger.FAILED,
    "refused": ledger.REFUSED,
    "expired": ledger.EXPIRED,
    "lost": ledger.LOST,
}


def _propose(chosen: Sequence[Running]) -> Iterator[Any]:
    """Policies for these episodes in order, each explorer asked once."""
    groups: dict[int, list[int]] = {}
    for i, running in enumerate(chosen):
        groups.setdefault(id(running.mode.explorer), []).append(i)
    policies: list[Any] = [None] * len(chosen)
    for members in groups.values():
        explorer = chosen[members[0]].mode.explorer
        for i, policy in zip(
            members, explorer.propose([chosen[i].episode for i in members]), strict=True
        ):
            policies[i] = policy
    return iter(policies)
