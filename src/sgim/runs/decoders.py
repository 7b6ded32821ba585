"""How each row becomes an event again."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, cast

from sgim.events import (
    Answered,
    Available,
    Cause,
    Closed,
    Demonstrated,
    Ended,
    Ending,
    Evaluated,
    Observed,
    Opened,
    Session,
    Suggested,
    Told,
)
from sgim.records import Demonstration, Goal, Trajectory, Trial
from sgim.runs.rows import DECLINED, Kinds, RecordedEvent, RecordedPlan, no_context
from sgim.task import Task

Stored = tuple[Any, ...]
"""A row as SQLite returns it: ``seq``, then the columns."""


class Decoders:
    """Functions from a row to its event.

    Args:
        task: The task whose spaces unpack the points.

    Attributes:
        by_name: Name of an event → function from such a row to the event.
    """

    def __init__(self, task: Task) -> None:
        space = task.context_space
        self._policy = task.policy_space.unpack
        self._outcome_kinds = Kinds("outcome kind", task.outcome_spaces, "unpack")
        self._goal_kinds = Kinds("goal kind", task.goal_spaces, "unpack")
        self._present_context = no_context if space is None else space.unpack
        self.by_name: dict[str, Callable[[Stored], RecordedEvent]] = {
            "opened": self._opened,
            "planned": self._planned,
            "answered": self._answered,
            "told": self._told,
            "ended": self._ended,
            "observed": self._observed,
            "demonstrated": self._demonstrated,
            "suggested": self._suggested,
            "available": self._available,
            "closed": self._closed,
            "evaluated": evaluated,
            "session": session,
        }

    def outcome(self, kind: str | None, point: bytes) -> dict[str, Any]:
        """The part of an outcome that one row holds; empty without a kind."""
        return {} if kind is None else {kind: self._outcome_kinds[kind](point)}

    def _opened(self, row: Stored) -> Opened:
        _, _, episode, _, mode, kind, point, _, context, _, detail = row
        cause, _, budget = detail.partition(", budget ")
        return Opened(
            episode,
            mode,
            self._goal(kind, point),
            self._context(context),
            cast(Cause, cause),
            int(budget) if budget else None,
        )

    def _planned(self, row: Stored) -> RecordedPlan:
        _, _, episode, plan, teacher, _, _, policy, context, _, request = row
        return RecordedPlan(
            plan,
            episode,
            None if policy is None else self._policy(policy),
            teacher,
            None if request is None else int(request),
            None if context is None else self._present_context(context),
        )

    def _told(self, row: Stored) -> Told:
        _, _, _, plan, _, kind, point, _, _, seconds, _ = row
        return Told(plan, {} if kind is None else {kind: self._outcome_kinds[kind](point)}, seconds)

    def _answered(self, row: Stored) -> Answered:
        _, _, _, plan, _, _, _, _, _, seconds, detail = row
        return Answered(plan, None if detail == DECLINED else self._shown(row), seconds)

    def _demonstrated(self, row: Stored) -> Demonstrated:
        return Demonstrated(self._shown(row))

    def _shown(self, row: Stored) -> Demonstration:
        _, _, _, _, teacher, kind, point, policy, context, _, detail = row
        return Demonstration(
            self.outcome(kind, point),
            None if policy is None else self._policy(policy),
            None if detail is None else Trajectory(**json.loads(detail)),
            teacher,
            self._context(context),
        )

    def _observed(self, row: Stored) -> Observed:
        _, _, _, _, _, kind, point, policy, context, _, _ = row
        outcome = self.outcome(kind, point)
        return Observed(Trial(self._policy(policy), outcome, self._context(context)))

    def _ended(self, row: Stored) -> Ended:
        _, _, _, plan, how, _, _, _, _, seconds, reason = row
        return Ended(plan, cast(Ending, how), reason, seconds)

    def _suggested(self, row: Stored) -> Suggested:
        kind, point = row[5:7]
        return Suggested(Goal(kind, self._goal_kinds[kind](point)))

    def _available(self, row: Stored) -> Available:
        _, _, _, _, teacher, _, _, _, _, _, detail = row
        return Available(teacher, detail == "yes")

    def _closed(self, row: Stored) -> Closed:
        _, _, episode, _, mode, kind, point, _, _, _, detail = row
        facts = json.loads(detail)
        goal = self._goal(kind, point)
        return Closed(episode, mode, goal, facts["before"], facts["after"], facts["movements"])

    def _goal(self, kind: str | None, point: bytes) -> Goal | None:
        return None if kind is None else Goal(kind, self._goal_kinds[kind](point))

    def _context(self, context: bytes | None) -> Any:
        return None if context is None else self._present_context(context)


def evaluated(row: Stored) -> Evaluated:
    """What an evaluation's row holds; it needs no task."""
    facts = json.loads(row[10])
    return Evaluated(facts["movements"], facts["errors"])


def session(row: Stored) -> Session:
    """What a session's row holds; it needs no task."""
    return Session(json.loads(row[10]))
