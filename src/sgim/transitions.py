"""The transitions of a learner's state: what it decides, and what it learns from each event.

Nothing here checks what comes from outside or records it; the learner's public face does. Folding
a record goes through the same transitions, so that what was learned comes out the same.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from sgim import ledger
from sgim.errors import UnwrittenError
from sgim.events import (
    Available,
    Closed,
    Demonstrated,
    Ending,
    Event,
    Observed,
    Opened,
    Planned,
    Suggested,
)
from sgim.ledger import Ledger, Running
from sgim.outcome.interest import EpisodeReport
from sgim.policy.explorer import Episode
from sgim.policy.model import CompetenceModel
from sgim.records import Demonstration, Goal, Plan, Report, Trial
from sgim.spaces import Box
from sgim.strategy.situation import Situation
from sgim.strategy.strategy import Strategy, mode_for, mode_named
from sgim.streams import Streams
from sgim.task import Task


class Transitions:
    """The state of a learner and how it changes.

    Args:
        task: The spaces of the world.
        strategy: Chooses modes and goals, with the interest map it uses.
        model: Learns from trials.
        seed: Of all the learner's random streams.

    Attributes:
        record: Called with every event as it happens; set by whoever keeps the journal.
        movements: Trials executed so far, whether they told something or failed.
        folding: Whether recorded events are being folded, which say themselves when the
            episodes end whose explorers are not in use.
    """

    def __init__(
        self, task: Task, strategy: Strategy, model: CompetenceModel, seed: int = 0
    ) -> None:
        self.task = task
        self.strategy = strategy
        self.model = model
        self.streams = Streams(seed)
        self.record: Callable[[Event], None] | None = None
        self.movements = 0
        self.folding = False
        self.ledger = Ledger()
        self._rng = (-1, self.streams("learner"))
        self._absent: set[str] = set()
        self._suggestions: deque[Goal] = deque()
        self._given: deque[Demonstration] = deque()
        self._was_told = False
        self._unwritten: UnwrittenError | None = None

    def decide_opening(self, context: Any) -> Opened:
        """Decide the next episode's mode and goal, without opening it."""
        number = self.ledger.next_episode
        self._rng = number, self.streams("learner", number)
        now = Situation(number, self._absent, context, self.ledger.running.values())
        mode, chosen, budget = self.strategy.choose(now, self._rng[1])
        if chosen is not None:
            chosen = self.task.check_goal(chosen.kind, chosen.point)
        if self._given:
            shown = self._shown(self._given[0], chosen)
            mode = mode_for(self.strategy, self._given[0])
            return Opened(number, mode.name, shown or chosen, context, "demonstration")
        if self._suggestions:
            mode = self.strategy.alone if mode.pursues == "nothing" else mode
            return Opened(number, mode.name, self._suggestions[0], context, "suggestion", budget)
        return Opened(number, mode.name, chosen, context, "strategy", budget)

    def open(self, event: Opened, *, live: bool = True) -> Running:
        """Open the episode that was decided; ``live`` if its explorer is to be used."""
        number = event.episode
        self.ledger.next_episode = number + 1
        # The choice was drawn from the episode's own stream, which goes on from there.
        decided, rng = self._rng
        if decided != number:
            rng = self.streams("learner", number)
        episode = Episode(number, event.goal, event.context, rng)
        mode = mode_named(self.strategy, event.mode)
        running = Running(mode, event.goal, event.context, episode, live, event.budget)
        self.ledger.running[number] = running
        if event.cause == "suggestion":
            self._suggestions.popleft()
        elif event.cause == "demonstration":
            episode.demonstration = self._given.popleft()
        try:
            if not running.must_ask:
                self._take_up(running)
        except BaseException:
            self.unopen(running, event)
            raise
        return running

    def unopen(self, running: Running, event: Opened) -> None:
        """Forget an episode that could not be begun, as if it had not been decided."""
        del self.ledger.running[event.episode]
        self.ledger.next_episode = event.episode
        if event.cause == "suggestion" and event.goal is not None:
            self._suggestions.appendleft(event.goal)
        elif event.cause == "demonstration" and running.episode.demonstration is not None:
            self._given.appendleft(running.episode.demonstration)

    def _take_up(self, running: Running) -> None:
        """Pursue the goal, now that all there is to know about it is known."""
        episode, mode = running.episode, running.mode
        if mode.pursues == "nothing":
            episode.goal = None
        elif mode.pursues == "demonstrated" and episode.demonstration is not None:
            episode.goal = self._shown(episode.demonstration, running.chosen) or episode.goal
        if episode.demonstration is not None and running.watched is not None:
            shown_in = episode.demonstration.context
            episode.context = episode.context if shown_in is None else shown_in
        if running.live:
            if episode.goal is None and mode.pursues != "nothing":
                running.chosen = episode.goal = self._goal_alone(running)
            if episode.goal is not None:
                competence = float(self.model.competence(episode.goal, episode.context))
                episode.before = episode.best = competence
            mode.explorer.begin(episode)

    def _goal_alone(self, running: Running) -> Goal | None:
        """A goal for an episode that was to get it from a teacher, and did not."""
        teachers = {mode.teacher for mode in self.strategy.modes.values() if mode.teacher}
        now = Situation(running.episode.id, teachers, running.episode.context)
        return self.strategy.choose(now, running.episode.rng).goal

    def _shown(self, demonstration: Demonstration, chosen: Goal | None) -> Goal | None:
        """The demonstrated outcome as a goal, of the kind chosen if it has that; else None."""
        outcomes, goals = self.task.outcome_spaces, self.task.goal_spaces
        kinds = [
            kind
            for kind, point in demonstration.outcome.items()
            if goals.get(kind) is outcomes[kind] and goals[kind].contains(point)
        ]
        if not kinds:
            return None
        kind = chosen.kind if chosen is not None and chosen.kind in kinds else kinds[0]
        return Goal(kind, demonstration.outcome[kind])

    def resumed(self, running: Running, context: Any) -> Running:
        """An open episode in the present context; its explorer is told if that has changed."""
        if self.task.context_space is not None:
            space = self.task.context_space
            if space.pack(context) != space.pack(running.episode.context):
                running.episode.context = context
                if running.live:
                    self._rebase(running.episode)
                    running.mode.explorer.moved(running.episode)
        return running

    def _rebase(self, episode: Episode) -> None:
        """Count what was gained so far, and measure from the new context on.

        Otherwise an episode would be credited with the luck of its contexts.
        """
        if episode.goal is None or episode.before is None or episode.best is None:
            return
        episode.gained += episode.best - episode.before
        competence = float(self.model.competence(episode.goal, episode.context))
        episode.before = episode.best = competence

    def proposed(self, running: Running) -> Any:
        """The policy that an episode's explorer proposes next; None if it must ask first."""
        if running.must_ask:
            return None
        return self.sealed(running.mode.explorer.propose([running.episode])[0])

    def sealed(self, policy: Any) -> Any:
        """A proposed policy, checked, and such that no world can change what is remembered."""
        point = self.task.check_policy(policy)
        if isinstance(self.task.policy_space, Box):  # whose points are arrays, checked in a copy
            point.setflags(write=False)
        return point

    def all_sealed(self, policies: Sequence[Any]) -> list[Any]:
        """As `sealed` for each of several policies; those of a box all at once."""
        space = self.task.policy_space
        if isinstance(space, Box):
            try:
                points = np.array(policies, dtype=np.float64)
            except (TypeError, ValueError):  # what is malformed is named one by one, below
                points = np.empty(0)
            if points.shape[1:] == space.low.shape and space.contains(points):
                points.setflags(write=False)
                return list(points)
        return [self.sealed(policy) for policy in policies]

    def issue(self, running: Running, policy: Any) -> Plan:
        """Give out an episode's next plan: this policy, or a request if it must ask."""
        teacher = running.mode.teacher if running.must_ask else None
        plan = self.ledger.give_out(running, policy, teacher)
        if self.record is not None:
            self._emit(Planned(plan))
        return plan

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

    def learn_trial(self, plan: Plan, running: Running, trial: Trial) -> Report:
        """Learn from a trial of an open episode."""
        self.ledger.resolve(plan, ledger.TOLD)
        self.model.update(trial)
        self.movements += 1
        episode, goal = running.episode, running.episode.goal
        episode.movements += 1
        shown: float | None = None
        if running.live and goal is not None and episode.best is not None:
            shown = self.model.shown_by(trial, goal, episode.context)
            if shown is None:
                episode.best = float(self.model.competence(goal, episode.context))
            elif shown > episode.best:
                episode.best = float(shown)
        try:
            if running.live:
                running.mode.explorer.learn(episode, trial, shown)
        finally:
            closed = self._resolved(running)
        progress = None
        if closed and episode.best is not None and episode.before is not None:
            progress = episode.best - episode.before + episode.gained
        return Report(None if shown is None else -shown, episode.best, closed, progress)

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
            ended = episode.attempts >= running.budget or (
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
        before = None if e.before is None else e.before - e.gained
        event = Closed(e.id, running.mode.name, e.goal, before, e.best, e.movements)
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

    def take_unasked(self, event: Observed | Demonstrated | Suggested | Available) -> None:
        """Fold one message that was not about a plan."""
        self._was_told = True
        match event:
            case Observed(trial):
                self.model.update(trial)
            case Demonstrated(demonstration):
                self._given.append(demonstration)
            case Suggested(goal):
                self._suggestions.append(goal)
            case Available(teacher, yes):
                (self._absent.discard if yes else self._absent.add)(teacher)

    def report_unwritten(self) -> None:
        """Raise if an event could not be written; it has happened, and the journal keeps it."""
        if self._unwritten is not None:
            error, self._unwritten = self._unwritten, None
            raise error

    def _emit(self, event: Event) -> None:
        if self.record is not None:
            try:
                self.record(event)
            except UnwrittenError as error:  # kept by the journal: what it says has happened
                self._unwritten = self._unwritten or error


_STATUS = {
    "failed": ledger.FAILED,
    "refused": ledger.REFUSED,
    "expired": ledger.EXPIRED,
    "lost": ledger.LOST,
}
