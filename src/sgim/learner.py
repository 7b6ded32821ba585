"""The learner: algorithm 1.4.1 of the thesis as a pure state machine.

It never sees an environment, a teacher or a clock. It emits plans and is told what happened;
whoever drives it has the world. Every decision and every message is an event, handed to
``record`` in order; `sgim.runs.replay` folds recorded events back into a learner.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sgim import demonstrations
from sgim.answers import Answers
from sgim.errors import SpaceError, unknown
from sgim.events import (
    Answered,
    Available,
    Demonstrated,
    Ended,
    Ending,
    Observed,
    Opened,
    Suggested,
    Told,
)
from sgim.ledger import Running
from sgim.policy.competence import CompetenceModel
from sgim.records import Demonstration, Outcome, Plan, Report, Trial
from sgim.strategy.strategy import Strategy
from sgim.task import Task
from sgim.transitions import Transitions


class Learner(Transitions, Answers):
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
        super().__init__(task, strategy, model, seed)
        self.recipe = None if recipe is None else dict(recipe)

    def describe(self) -> dict[str, Any]:
        """What tells learners apart: the recipe, or else the seed and the parts by their names."""
        if self.recipe is not None:
            return {"recipe": self.recipe}
        modes = {
            m.name: [type(m.explorer).__name__, m.budget, m.cost, m.teacher, m.pursues]
            for m in self.strategy.modes.values()
        }
        parts = [self.strategy, getattr(self.strategy, "interest", None), self.model]
        names = [type(part).__name__ for part in parts]
        return {"recipe": None, "seed": self.seed, "parts": names, "modes": modes}

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
        return [plan for plan, _ in self.ledger.plans.values()]  # as they were given out

    # Deciding.

    def ask(self, context: Any = None) -> Plan:
        """Decide what to do next.

        Args:
            context: The present context, if the task has contexts.

        Returns:
            A plan with a policy to try, or with a request to a teacher.
        """
        return self.ask_batch(1, [context])[0]

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
        checked = [self.task.check_context(c) for c in given]
        chosen: list[tuple[Running, Opened | None]] = []
        try:
            while len(chosen) < n and (running := self.ledger.oldest_idle()) is not None:
                chosen.append((running, None))
                self.resumed(running, checked[len(chosen) - 1])
            chosen += self.open_new(checked[len(chosen) :])
            policies = self.proposed([running for running, _ in chosen])
        except BaseException:
            for running, opening in reversed(chosen):
                if opening is None:
                    self.ledger.make_idle(running)
                else:
                    self.unopen(running, opening)
            raise
        plans = []
        for (running, opening), policy in zip(chosen, policies, strict=True):
            if opening is not None:
                self._emit(opening)
            plans.append(self.issue(running, policy))
        self.report_unwritten()
        return plans

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
        return self.answer_batch([plan], [demonstration], seconds=[seconds])[0]

    def answer_batch(
        self,
        plans: Sequence[Plan],
        shown: Sequence[Demonstration | None],
        *,
        seconds: Sequence[float | None] | None = None,
    ) -> list[Plan]:
        """As `answer` for several requests, in this order, at one pass through the explorers.

        Raises:
            TeacherError: If a demonstration is unusable; all the requests are still out then.
            PlanError: If a plan is not out, holds no request, or comes twice; the same holds.
            ValueError: If there is not one demonstration, or None, for each plan.
        """
        some = self.ledger.all_out(plans, shown, request=True)
        pairs = zip(shown, some, strict=True)
        usable = [given and self._usable(given, running) for given, running in pairs]
        trouble: BaseException | None = None
        try:
            self.learn_answers(plans, some, usable)
            policies = self.proposed(some)
        except BaseException as error:
            trouble = error
        following = []
        for i, (plan, running, given) in enumerate(zip(plans, some, usable, strict=True)):
            self._emit(Answered(plan.id, given, None if seconds is None else seconds[i]))
            if trouble is None:
                following.append(self.issue(running, policies[i]))
            else:
                self.ledger.make_idle(running)
        if trouble is not None:
            raise trouble
        self.report_unwritten()
        return following

    def _usable(self, given: Demonstration, running: Running) -> Demonstration:
        mode = running.mode
        assert mode.teacher is not None
        needing = mode.name if mode.needs_policy else None
        return demonstrations.checked(self.task, given, mode.teacher, needing=needing)

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
        return self.tell_batch([plan], [outcome], seconds=[seconds])[0]

    def tell_batch(
        self,
        plans: Sequence[Plan],
        outcomes: Sequence[Outcome],
        *,
        seconds: Sequence[float | None] | None = None,
    ) -> list[Report]:
        """As `tell` for several plans, in this order; the model learns from all of them at once.

        Args:
            plans: Different plans of this learner that hold policies and are still out.
            outcomes: What each produced.
            seconds: The robot's time that each took, if known.

        Raises:
            SpaceError: If an outcome is malformed; all the plans are still out then.
            PlanError: If a plan is not out, holds a request, or comes twice; the same holds.
            ValueError: If there is not one outcome for each plan.
        """
        some = self.ledger.all_out(plans, outcomes, request=False)
        checked = self.task.check_outcomes(outcomes)
        trials = [Trial(p.policy, o, p.context) for p, o in zip(plans, checked, strict=True)]
        known = self.remember(some, trials)
        taken = [None] * len(plans) if seconds is None else seconds
        reports: list[Report] = []
        troubles: list[BaseException] = []
        for plan, running, trial, remembered, time in zip(
            plans, some, trials, known, taken, strict=True
        ):
            if self.record is not None:
                self._emit(Told(plan.id, trial.outcome, time))
            try:
                reports.append(self.learn_trial(plan, running, trial, remembered))
            except BaseException as error:  # those behind it have happened, too
                troubles.append(error)
        if troubles:
            raise troubles[0]
        self.report_unwritten()
        return reports

    def fail(self, plan: Plan, reason: str, *, seconds: float | None = None) -> None:
        """Say that the world broke while a plan was carried out: it teaches nothing."""
        self._end(plan, "failed", reason, seconds)

    def refuse(self, plan: Plan, reason: str, *, seconds: float | None = None) -> None:
        """Say that a safety check refused a plan: it counts against the plan, not the goal.

        A refused plan is no movement; a check that always refuses must be noticed by whoever
        drives the learner.
        """
        self._end(plan, "refused", reason, seconds)

    def expire(
        self,
        plan: Plan,
        reason: str = "nobody carried it out in time",
        *,
        seconds: float | None = None,
    ) -> None:
        """Say that a plan will not be carried out any more.

        An expired request is an unanswered one: its episode goes on alone.
        """
        self._end(plan, "expired", reason, seconds)

    def lose(self, plan: Plan, reason: str = "started, and never heard of again") -> None:
        """Say that nobody knows what became of a plan; it is never silently repeated."""
        self._end(plan, "lost", reason)

    def _end(self, plan: Plan, how: Ending, reason: str, seconds: float | None = None) -> None:
        running = self.ledger.out(plan)
        self._emit(Ended(plan.id, how, reason, seconds))
        self.learn_end(plan, running, how)
        self.report_unwritten()

    # Being told unasked.

    def observe(self, trial: Trial) -> None:
        """Learn from a trial made elsewhere, such as another run's: a warm start."""
        task = self.task
        known = Trial(
            task.check_policy(trial.policy),
            task.check_outcome(trial.outcome),
            task.check_context(trial.context),
        )
        self._unasked(Observed(known))

    def demonstrate(self, demonstration: Demonstration) -> None:
        """Take an unasked demonstration; the next new episode learns from it."""
        usable = demonstrations.checked(self.task, demonstration, demonstration.teacher)
        self._unasked(Demonstrated(usable))

    def suggest(self, kind: str, point: Any) -> None:
        """Suggest a goal; the next new episode takes it up, in the mode that it would choose."""
        goal = self.task.check_goal(kind, point)
        if not self.task.goal_spaces[kind].contains(goal.point):
            raise SpaceError(f"goal {kind!r} {point!r:.100} is outside the bounds of its space")
        self._unasked(Suggested(goal))

    def set_available(self, teacher: str, yes: bool) -> None:
        """Say whether a teacher can be asked; new episodes do not ask one who is away."""
        if teacher not in self.teachers:
            raise unknown("teacher", teacher, self.teachers)
        self._unasked(Available(teacher, yes))

    @property
    def fresh(self) -> bool:
        """Whether the learner has decided nothing and been told nothing yet."""
        return self.ledger.next_plan == 0 and not self._was_told

    def _unasked(self, event: Observed | Demonstrated | Suggested | Available) -> None:
        self._emit(event)
        self.take_unasked(event)
        self.report_unwritten()
