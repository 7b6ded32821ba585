"""Folding recorded events back into a learner: how a journal becomes a learner again.

Learning is a fold over events: trials go into the model and closed episodes into the strategy,
as recorded, without deciding anything anew. Only the explorers of episodes that are still open
have a state that no event holds. So decisions are made again from the start of the oldest open
episode, and compared with the record, which they must equal to the last bit.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, NoReturn

from sgim.errors import JournalError, MismatchError
from sgim.events import (
    Answered,
    Available,
    Closed,
    Demonstrated,
    Ended,
    Evaluated,
    Event,
    Observed,
    Opened,
    Session,
    Suggested,
    Told,
)
from sgim.learner import Learner
from sgim.ledger import Running
from sgim.records import Goal, Plan, Trial
from sgim.runs.rows import RecordedEvent, RecordedPlan


@dataclass
class Replayed:
    """What a fold came to.

    Attributes:
        learner: The learner, as it was after the last recorded event.
        events: How many events were folded.
        evaluations: The evaluations recorded.
        round_size: Plans asked for since none was out, those that follow answers not counted.
        round_start: Movements when none was out.
        unwritten: Events that follow from the record and are not in it, because the process
            died between writing two; to be appended.
        difference: The first recomputed decision that differed from the record, if any; the
            recorded one was adopted.
    """

    learner: Learner
    events: int = 0
    evaluations: list[Evaluated] = field(default_factory=list)
    round_size: int = 0
    round_start: int = 0
    unwritten: list[Event] = field(default_factory=list)
    difference: str | None = None


def replay(learner: Learner, events: Iterable[RecordedEvent], *, adopt: bool = False) -> Replayed:
    """Fold recorded events into a fresh learner.

    Args:
        learner: A learner made as the recorded one was, that has done nothing yet.
        events: The record, in order.
        adopt: What to do about a decision that comes out differently now (another version of
            the library, another processor): take the recorded one, keep every trial, close
            what is open, and decide anew from there; otherwise refuse.

    Raises:
        MismatchError: If a decision differs and is not to be adopted.
        JournalError: If the record contradicts itself.
    """
    record = list(events)
    fresh = copy.deepcopy(learner) if adopt else None
    try:
        return _Fold(learner, _oldest_open(record)).run(record)
    except MismatchError as error:
        if fresh is None:
            raise
        result = _Fold(fresh, math.inf).run(record)
        result.difference = str(error)
        return result


def _oldest_open(record: list[RecordedEvent]) -> float:
    open_episodes: dict[int, None] = {}
    for event in record:
        if isinstance(event, Opened):
            open_episodes[event.episode] = None
        elif isinstance(event, Closed):
            open_episodes.pop(event.episode, None)
    return min(open_episodes, default=math.inf)


class _Fold:
    def __init__(self, learner: Learner, live_from: float) -> None:
        self.learner = learner
        self.ledger = learner.ledger
        self.live_from = live_from
        self.result = Replayed(learner)
        self.concluded: dict[int, Closed] = {}
        self.after_answer = False

    def run(self, record: list[RecordedEvent]) -> Replayed:
        learner = self.learner
        learner.folding, learner.record = True, self._conclude
        for event in record:
            self._fold(event)
        learner.folding = False
        self.result.events = len(record)
        self.result.unwritten.extend(self.concluded.values())
        learner.record = self.result.unwritten.append
        for plan, running in self.ledger.plans.values():
            # Nothing has begun before the answer, so nothing is missing after it.
            running.live = running.live or plan.request is not None
        for running in list(self.ledger.running.values()):
            if running.live and self.ledger.waits(running):
                self._issue_due(running)
            elif not running.live and all(r is not running for _, r in self.ledger.plans.values()):
                self.ledger.take(running)
                learner.close(running)
        learner.record = None
        return self.result

    def _issue_due(self, running: Running) -> None:
        """Give out the plan that the process died before recording."""
        self._count_in_round()
        self.learner.issue(running, *self.learner.proposed([running]))

    def _count_in_round(self) -> None:
        if self.after_answer:
            return
        if not self.ledger.plans:
            self.result.round_size, self.result.round_start = 0, self.learner.movements
        self.result.round_size += 1

    def _conclude(self, event: Event) -> None:
        if isinstance(event, Closed):
            self.concluded[event.episode] = event

    def _fold(self, event: RecordedEvent) -> None:
        answered = False
        match event:
            case Opened():
                self._open(event)
            case RecordedPlan():
                self._plan(event)
            case Told():
                plan, running = self._out(event.plan)
                trial = Trial(plan.policy, event.outcome, plan.context)
                self.learner.learn_trial(plan, running, trial)
            case Answered():
                plan, running = self._out(event.plan)
                self.learner.learn_answers([plan], [running], [event.demonstration])
                answered = True
            case Ended():
                self.learner.learn_end(*self._out(event.plan), event.how)
            case Closed():
                self._close(event)
            case Evaluated():
                self.result.evaluations.append(event)
            case Observed() | Demonstrated() | Suggested() | Available():
                self.learner.take_unasked(event)
            case Session():
                if says_deterministic(event):
                    self.learner.declare_deterministic()
        self.after_answer = answered

    def _out(self, number: int) -> tuple[Plan, Running]:
        entry = self.ledger.plans.get(number)
        if entry is None:
            raise JournalError(
                f"the journal resolves plan {number}, which is not out: it is damaged"
            )
        return entry

    def _open(self, event: Opened) -> None:
        live = event.episode >= self.live_from
        if live:
            (decided,) = self.learner.decide([event.context])
            mine, recorded = (
                (e.mode, e.cause, e.budget, *self._goal_bytes(e.goal)) for e in (decided, event)
            )
            if mine != recorded:
                self._differ(f"episode {event.episode}", _words(decided), _words(event))
        self.learner.open(event, live=live)

    def _goal_bytes(self, goal: Goal | None) -> tuple[Any, ...]:
        if goal is None:
            return (None,)
        return goal.kind, self.learner.task.goal_spaces[goal.kind].pack(goal.point)

    def _plan(self, event: RecordedPlan) -> None:
        self._count_in_round()
        running = self.ledger.running.get(event.episode)
        if running is None:
            raise MismatchError(
                f"episode {event.episode} ended here, but plan {event.id} goes on with it there"
            )
        self.ledger.take(running)
        self.learner.resumed(running, event.context)
        if running.live:
            self._verify_plan(event, running)
        plan = self.ledger.give_out(running, event.policy, event.teacher)
        if plan.id != event.id:
            raise JournalError(
                f"the journal has plan {event.id} where {plan.id} is due: it is damaged"
            )

    def _verify_plan(self, event: RecordedPlan, running: Running) -> None:
        what, space = f"plan {event.id}", self.learner.task.policy_space
        if running.must_ask:
            if running.mode.teacher != event.teacher:
                self._differ(what, f"a request to {running.mode.teacher}", str(event.teacher))
            return
        policy = running.mode.explorer.propose([running.episode])[0]
        if event.policy is None or space.pack(policy) != space.pack(event.policy):
            self._differ(what, f"{policy!r:.300}", f"{event.policy!r:.300}")

    def _close(self, event: Closed) -> None:
        running = self.ledger.running.get(event.episode)
        if running is not None:
            if running.live:
                raise MismatchError(f"episode {event.episode} goes on here, but ended there")
            self.ledger.take(running)
            self.learner.credit(running, event)
            return
        mine = self.concluded.pop(event.episode, None)
        if mine is None:
            raise JournalError(f"the journal closes episode {event.episode} twice: it is damaged")
        ends = [(e.mode, e.before, e.after, e.movements) for e in (mine, event)]
        if ends[0] != ends[1]:
            self._differ(f"the end of episode {event.episode}", *map(str, ends))

    def _differ(self, what: str, mine: str, recorded: str) -> NoReturn:
        raise MismatchError(
            f"{what} comes out as {mine} here, but as {recorded} there. If learner and world are "
            "made as they were, this is another version of the library or another processor: go "
            "on with what is recorded by --adopt, or adopt=True"
        )


def _words(event: Opened) -> str:
    goal = "no goal" if event.goal is None else f"{event.goal.kind} {event.goal.point!r}"
    most = "" if event.budget is None else f", at most {event.budget} movements"
    return f"{event.mode} for {goal}{most} ({event.cause})"


def says_deterministic(event: RecordedEvent) -> bool:
    """Whether an event says that the run's world is deterministic."""
    return isinstance(event, Session) and bool(event.facts.get("deterministic"))


def iterate_trials(events: Iterable[RecordedEvent]) -> Iterator[Trial]:
    """The trials of a record, in the order they were told: for a warm start from another run."""
    plans: dict[int, RecordedPlan] = {}
    for event in events:
        if isinstance(event, RecordedPlan):
            plans[event.id] = event
        elif isinstance(event, Told):
            plan = plans.pop(event.plan)
            yield Trial(plan.policy, event.outcome, plan.context)
        elif isinstance(event, Ended):
            plans.pop(event.plan, None)
        elif isinstance(event, Observed):
            yield event.trial
