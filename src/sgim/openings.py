"""How a learner decides: which episodes to open, and which plans to give out.

Nothing here checks what comes from outside or records it, as in `sgim.transitions`.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from sgim.errors import UnwrittenError
from sgim.events import Event, Opened, Planned
from sgim.ledger import Ledger, Running
from sgim.policy.competence import CompetenceModel, competences
from sgim.policy.explorer import Episode, Explorer, begin_all
from sgim.records import Demonstration, Goal, Plan
from sgim.spaces import Box
from sgim.strategy.situation import Choice, Situation
from sgim.strategy.strategy import Strategy, choose_all, chooses_together, mode_for, mode_named
from sgim.streams import Streams
from sgim.task import Task


class Openings:
    """The state of a learner, and what it decides.

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
        self._drawn_from: dict[int, np.random.Generator] = {}
        self._absent: set[str] = set()
        self._suggestions: deque[Goal] = deque()
        self._given: deque[Demonstration] = deque()
        self._was_told = False
        self._unwritten: UnwrittenError | None = None

    @property
    def absent(self) -> frozenset[str]:
        """The teachers who cannot be asked now."""
        return frozenset(self._absent)

    def decide(self, contexts: Sequence[Any]) -> list[Opened]:
        """Decide the next episodes' modes and goals, one for each context, without opening them.

        Of several, the strategy must be one that chooses together, and nothing be suggested or
        shown unasked.
        """
        first = self.ledger.next_episode
        under_way = self.ledger.running.values()
        now = [
            Situation(number, self._absent, context, under_way)
            for number, context in enumerate(contexts, start=first)
        ]
        drawn_from = {s.episode: self.streams("learner", s.episode) for s in now}
        choices = choose_all(self.strategy, now, [*drawn_from.values()])
        goals = self._checked([choice[1] for choice in choices])
        self._drawn_from = drawn_from
        if self._given or self._suggestions:
            return [self._taken_up(now[0], choices[0], goals[0])]
        return [
            Opened(s.episode, mode.name, goal, s.context, "strategy", budget)
            for s, (mode, _, budget), goal in zip(now, choices, goals, strict=True)
        ]

    def _taken_up(self, now: Situation, choice: Choice, chosen: Goal | None) -> Opened:
        """An episode for what was shown unasked, or suggested, instead of for the goal chosen."""
        number, context, (mode, _, budget) = now.episode, now.context, choice
        if self._given:
            shown = self._shown(self._given[0], chosen)
            mode = mode_for(self.strategy, self._given[0])
            return Opened(number, mode.name, shown or chosen, context, "demonstration")
        mode = self.strategy.alone if mode.pursues == "nothing" else mode
        return Opened(number, mode.name, self._suggestions[0], context, "suggestion", budget)

    def _checked(self, chosen: Sequence[Goal | None]) -> list[Goal | None]:
        """Goals that a strategy has chosen, checked."""
        if len(chosen) == 1:
            return [goal and self.task.check_goal(goal.kind, goal.point) for goal in chosen]
        goals: list[Goal | None] = [None] * len(chosen)
        kinds: dict[str, list[int]] = {}
        for i, goal in enumerate(chosen):
            if goal is not None:
                kinds.setdefault(goal.kind, []).append(i)
        for kind, members in kinds.items():
            points = [goal.point for goal in chosen if goal is not None and goal.kind == kind]
            for i, goal in zip(members, self.task.check_goals(kind, points), strict=True):
                goals[i] = goal
        return goals

    def open_new(self, contexts: Sequence[Any]) -> list[tuple[Running, Opened]]:
        """Decide and open an episode for each context: all of them, or none if that fails."""
        together = chooses_together(self.strategy) and not (self._given or self._suggestions)
        opened: list[tuple[Running, Opened]] = []
        try:
            for some in [contexts] if together and contexts else [[one] for one in contexts]:
                opened += [(self._enter(e, live=True), e) for e in self.decide(some)]
            self._take_up([running for running, _ in opened if not running.must_ask])
        except BaseException:
            for running, event in reversed(opened):
                self.unopen(running, event)
            raise
        return opened

    def open(self, event: Opened, *, live: bool = True) -> Running:
        """Open the episode that was decided; ``live`` if its explorer is to be used."""
        running = self._enter(event, live=live)
        try:
            if not running.must_ask:
                self._take_up([running])
        except BaseException:
            self.unopen(running, event)
            raise
        return running

    def _enter(self, event: Opened, *, live: bool) -> Running:
        """Enter an episode among those that are open, before its goal is taken up."""
        number = event.episode
        self.ledger.next_episode = number + 1
        # The choice was drawn from the episode's own stream, which goes on from there.
        rng = self._drawn_from.pop(number, None) or self.streams("learner", number)
        episode = Episode(number, event.goal, event.context, rng)
        mode = mode_named(self.strategy, event.mode)
        running = Running(mode, event.goal, event.context, episode, live, event.budget)
        self.ledger.running[number] = running
        if event.cause == "suggestion":
            self._suggestions.popleft()
        elif event.cause == "demonstration":
            episode.demonstration = self._given.popleft()
        return running

    def unopen(self, running: Running, event: Opened) -> None:
        """Forget an episode that could not be begun, as if it had not been decided."""
        del self.ledger.running[event.episode]
        self.ledger.next_episode = event.episode
        if event.cause == "suggestion" and event.goal is not None:
            self._suggestions.appendleft(event.goal)
        elif event.cause == "demonstration" and running.episode.demonstration is not None:
            self._given.appendleft(running.episode.demonstration)

    def _take_up(self, some: Sequence[Running]) -> None:
        """Pursue the goals of episodes, now that all there is to know about them is known."""
        goals: list[Goal] = []
        aimed: list[Episode] = []
        live: list[Running] = []
        for running in some:
            self._aim(running)
            if running.live:
                live.append(running)
                if (goal := running.episode.goal) is not None:
                    goals.append(goal)
                    aimed.append(running.episode)
        if aimed:
            known = competences(self.model, goals, [episode.context for episode in aimed])
            for episode, competence in zip(aimed, known, strict=True):
                episode.before = episode.best = competence
        for explorer, members in by_explorer(live):
            begin_all(explorer, [running.episode for running in members])

    def _aim(self, running: Running) -> None:
        episode, mode = running.episode, running.mode
        if mode.pursues == "nothing":
            episode.goal = None
        elif mode.pursues == "demonstrated" and episode.demonstration is not None:
            episode.goal = self._shown(episode.demonstration, running.chosen) or episode.goal
        if episode.demonstration is not None and running.watched is not None:
            shown_in = episode.demonstration.context
            episode.context = episode.context if shown_in is None else shown_in
        if running.live and episode.goal is None and mode.pursues != "nothing":
            running.chosen = episode.goal = self._goal_alone(running)

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

    def proposed(self, some: Sequence[Running]) -> list[Any]:
        """The policies that episodes' explorers propose next; None for those that must ask first.

        They are checked, and such that no world can change what is remembered.
        """
        ready: list[Running] = []
        given: list[Any] = []
        for explorer, members in by_explorer([r for r in some if not r.must_ask]):
            ready += members
            given += explorer.propose([running.episode for running in members])
        policies: dict[int, Any] = {}
        for running, policy in zip(ready, self._sealed(given), strict=True):
            policies[running.episode.id] = policy
        return [policies.get(running.episode.id) for running in some]

    def _sealed(self, policies: Sequence[Any]) -> list[Any]:
        """These policies checked, those of a box all at once and not to be written to."""
        space = self.task.policy_space
        if not isinstance(space, Box):
            return [self.task.check_policy(policy) for policy in policies]
        try:
            points = np.array(policies, dtype=np.float64)
        except (TypeError, ValueError):  # what is malformed is named one by one, below
            points = np.empty(0)
        if points.shape[1:] != space.low.shape or not space.contains(points):
            points = np.array([self.task.check_policy(policy) for policy in policies])
        points.setflags(write=False)
        return list(points)

    def issue(self, running: Running, policy: Any) -> Plan:
        """Give out an episode's next plan: this policy, or a request if it must ask."""
        teacher = running.mode.teacher if running.must_ask else None
        plan = self.ledger.give_out(running, policy, teacher)
        if self.record is not None:
            self._emit(Planned(plan))
        return plan

    def _emit(self, event: Event) -> None:
        """Hand an event to whoever records."""
        if self.record is not None:
            try:
                self.record(event)
            except UnwrittenError as error:  # kept by the journal: what it says has happened
                self._unwritten = self._unwritten or error


def by_explorer(some: Sequence[Running]) -> list[tuple[Explorer, list[Running]]]:
    """The episodes that each explorer has."""
    groups: dict[int, tuple[Explorer, list[Running]]] = {}
    for running in some:
        explorer = running.mode.explorer
        group = groups.get(id(explorer))
        if group is None:
            groups[id(explorer)] = explorer, [running]
        else:
            group[1].append(running)
    return list(groups.values())
