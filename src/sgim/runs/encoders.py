"""How each event becomes rows. Planned and told come once a trial and must cost little."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from sgim.events import (
    Answered,
    Available,
    Closed,
    Demonstrated,
    Ended,
    Evaluated,
    Observed,
    Opened,
    Planned,
    Session,
    Suggested,
    Told,
)
from sgim.records import Demonstration, Goal, Outcome, Trajectory
from sgim.runs.rows import ALSO, DECLINED, Kinds, Row, no_context, to_json
from sgim.task import Task


class Encoders:
    """Functions from an event to its rows.

    Args:
        task: The task whose spaces pack the points.

    Attributes:
        by_type: Type of event → function from such an event to its rows.
    """

    def __init__(self, task: Task) -> None:
        space = task.context_space
        self._policy = task.policy_space.pack
        self._outcome_kinds = Kinds("outcome kind", task.outcome_spaces, "pack")
        self._goal_kinds = Kinds("goal kind", task.goal_spaces, "pack")
        self._present_context = no_context if space is None else space.pack
        self.by_type: dict[type, Callable[[Any], list[Row]]] = {
            Opened: self._opened,
            Planned: self._planned,
            Answered: self._answered,
            Told: self._told,
            Ended: self._ended,
            Observed: self._observed,
            Demonstrated: self._demonstrated,
            Suggested: self._suggested,
            Available: self._available,
            Closed: self._closed,
            Evaluated: self._evaluated,
            Session: self._session,
        }

    def _opened(self, event: Opened) -> list[Row]:
        kind, point = self._goal(event.goal)
        context = self._context(event.context)
        detail: str = event.cause
        if event.budget is not None:
            detail = f"{detail}, budget {event.budget}"
        return [
            ("opened", event.episode, None, event.mode, kind, point, None, context, None, detail)
        ]

    def _planned(self, event: Planned) -> list[Row]:
        plan = event.plan
        context = None if plan.context is None else self._present_context(plan.context)
        request = plan.request
        teacher = policy = index = None
        if request is None:
            policy = self._policy(plan.policy)
        else:
            teacher, index = request.teacher, str(request.index)
        return [
            ("planned", plan.episode, plan.id, teacher, None, None, policy, context, None, index)
        ]

    def _told(self, event: Told) -> list[Row]:
        seconds = None if event.seconds is None else float(event.seconds)
        outcome, plan = event.outcome, event.plan
        if len(outcome) != 1:
            return self._with_outcome("told", outcome, plan=plan, seconds=seconds)
        ((kind, value),) = outcome.items()
        point = self._outcome_kinds[kind](value)
        return [("told", None, plan, None, kind, point, None, None, seconds, None)]

    def _with_outcome(
        self,
        event: str,
        outcome: Outcome,
        plan: int | None = None,
        name: str | None = None,
        policy: bytes | None = None,
        context: bytes | None = None,
        seconds: float | None = None,
        detail: str | None = None,
    ) -> list[Row]:
        rows: list[Row] = []
        for kind, value in outcome.items():
            point = self._outcome_kinds[kind](value)
            if rows:
                rows.append((ALSO, None, plan, None, kind, point, None, None, None, None))
            else:
                rows.append(
                    (event, None, plan, name, kind, point, policy, context, seconds, detail)
                )
        return rows or [(event, None, plan, name, None, None, policy, context, seconds, detail)]

    def _answered(self, event: Answered) -> list[Row]:
        seconds = None if event.seconds is None else float(event.seconds)
        shown = event.demonstration
        if shown is not None:
            return self._shown("answered", shown, event.plan, seconds)
        return [("answered", None, event.plan, None, None, None, None, None, seconds, DECLINED)]

    def _demonstrated(self, event: Demonstrated) -> list[Row]:
        return self._shown("demonstrated", event.demonstration, None, None)

    def _shown(
        self, event: str, shown: Demonstration, plan: int | None, seconds: float | None
    ) -> list[Row]:
        return self._with_outcome(
            event,
            shown.outcome,
            plan,
            shown.teacher,
            None if shown.policy is None else self._policy(shown.policy),
            self._context(shown.context),
            seconds,
            None if shown.trajectory is None else _trajectory(shown.trajectory),
        )

    def _observed(self, event: Observed) -> list[Row]:
        trial = event.trial
        policy, context = self._policy(trial.policy), self._context(trial.context)
        return self._with_outcome("observed", trial.outcome, policy=policy, context=context)

    def _ended(self, event: Ended) -> list[Row]:
        # A reason is often the text of an exception, which may hold what UTF-8 cannot.
        reason = event.reason.encode("utf-8", "backslashreplace").decode()
        seconds = None if event.seconds is None else float(event.seconds)
        return [("ended", None, event.plan, event.how, None, None, None, None, seconds, reason)]

    def _suggested(self, event: Suggested) -> list[Row]:
        kind, point = self._goal(event.goal)
        return [("suggested", None, None, None, kind, point, None, None, None, None)]

    def _available(self, event: Available) -> list[Row]:
        detail = "yes" if event.yes else "no"
        return [("available", None, None, event.teacher, None, None, None, None, None, detail)]

    def _closed(self, event: Closed) -> list[Row]:
        kind, point = self._goal(event.pursued)
        detail = (
            f'{{"before": {_number(event.before)}, "after": {_number(event.after)}, '
            f'"movements": {_number(event.movements)}}}'
        )
        return [("closed", event.episode, None, event.mode, kind, point, None, None, None, detail)]

    def _evaluated(self, event: Evaluated) -> list[Row]:
        detail = to_json({"movements": event.movements, "errors": dict(event.errors)})
        return [("evaluated", None, None, None, None, None, None, None, None, detail)]

    def _session(self, event: Session) -> list[Row]:
        detail = to_json(dict(event.facts))
        return [("session", None, None, None, None, None, None, None, None, detail)]

    def _goal(self, goal: Goal | None) -> tuple[str | None, bytes | None]:
        return (
            (None, None) if goal is None else (goal.kind, self._goal_kinds[goal.kind](goal.point))
        )

    def _context(self, context: Any) -> bytes | None:
        return None if context is None else self._present_context(context)


def _number(value: float | None) -> str:
    """A number as `to_json` writes it, which takes as long as the rest of a row."""
    if value is None:
        return "null"
    ordinary = (type(value) is float and math.isfinite(value)) or type(value) is int
    return repr(value) if ordinary else to_json(value)


def _trajectory(trajectory: Trajectory) -> str:
    return to_json(
        {
            "times": trajectory.times.tolist(),
            "positions": trajectory.positions.tolist(),
            "joints": trajectory.joints,
            "unit": trajectory.unit,
        }
    )
