"""The journals of runs as tidy tables: a row a trial, a row an episode, a row an evaluation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from sgim.events import Closed, Ended, Evaluated, Observed, Opened, Told
from sgim.runs.journal import Journal
from sgim.runs.rows import RecordedPlan
from sgim.spaces import Box, Choices, Space
from sgim.task import Task

Sort = Literal["text", "integer", "number"]

RUN_COLUMNS: Mapping[str, Sort] = {
    **dict.fromkeys(("run", "experiment", "learner", "configuration"), "text"),
    "seed": "integer",
}
"""The first columns of every table: of which run a row is."""


@dataclass(frozen=True)
class Column:
    """A column of a table; values may be missing.

    Attributes:
        sort: What its values are.
        unit: Their unit, if it is known.
        values: The values.
    """

    sort: Sort
    unit: str | None = None
    values: list[Any] = field(default_factory=list)


Table = dict[str, Column]


def tables(journal: Journal, name: str) -> dict[str, Table]:
    """The tables ``trials``, ``episodes`` and ``evaluations`` of one run.

    Points take a column for each coordinate, ``KIND.NAME``; labels one, ``KIND``; points of other
    spaces one for each number of their encoding, ``KIND.0`` and so on.

    Args:
        journal: Its journal.
        name: What to call the run.
    """
    header = journal.header
    recipe = header.get("recipe") or {}
    run = {
        "run": name,
        "experiment": header.get("experiment"),
        "learner": header.get("learner") or recipe.get("learner"),
        "configuration": (recipe.get("configuration") or {}).get("name"),
        "seed": recipe.get("seed"),
    }
    rows = _Rows(journal.task)
    for event in journal.events():
        rows.take(event)
    found = {"trials": rows.trials, "episodes": rows.episodes, "evaluations": rows.evaluations}
    return {
        title: {
            **{
                key: Column(sort, None, [run[key]] * _length(t))
                for key, sort in RUN_COLUMNS.items()
            },
            **t,
        }
        for title, t in found.items()
    }


def _length(table: Table) -> int:
    return len(next(iter(table.values())).values)


class _Rows:
    """Rows of the tables of one run, from its events in order."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._contexts = {} if task.context_space is None else {"context": task.context_space}
        self.trials: Table = {
            **_columns("integer", "trial", "plan", "episode"),
            **_columns("text", "mode", "goal_kind", "ended"),
            "seconds": Column("number", "s"),
            **_of_spaces({"policy": task.policy_space} | self._contexts),
            **_of_spaces(task.outcome_spaces, "outcome."),
        }
        self.episodes: Table = {
            **_columns("integer", "episode", "trials_before"),
            **_columns("text", "mode", "cause", "goal_kind"),
            **_of_spaces(task.goal_spaces, "goal."),
            **_of_spaces(self._contexts),
            **_columns("text", "credited", "pursued_kind"),
            **_of_spaces(task.goal_spaces, "pursued."),
            **_columns("number", "competence_before", "competence_after"),
            **_columns("integer", "trials"),
        }
        self.evaluations: Table = {
            **_columns("integer", "trials"),
            **_columns("text", "kind"),
            **_columns("number", "error"),
        }
        self._plans: dict[int, RecordedPlan] = {}
        self._opened: dict[int, Opened] = {}
        self._rows: dict[int, int] = {}
        self._count = 0

    def take(self, event: object) -> None:
        """Add what an event says."""
        match event:
            case Opened():
                self._opened[event.episode] = event
                self._rows[event.episode] = _length(self.episodes)
                self._open(event)
            case RecordedPlan():
                self._plans[event.id] = event
            case Told():
                self._end(event.plan, "told", event.seconds, event.outcome)
            case Ended():
                self._end(event.plan, event.how, event.seconds, {})
            case Observed(trial):
                spots = {"policy": trial.policy, "context": trial.context}
                _append(self.trials, {"ended": "observed"}, self._places(spots, trial.outcome))
            case Closed():
                self._close(event)
            case Evaluated():
                for kind, error in event.errors.items():
                    row = {"trials": event.movements, "kind": kind, "error": float(error)}
                    _append(self.evaluations, row, {})

    def _open(self, event: Opened) -> None:
        goal = event.goal
        row = {
            "episode": event.episode,
            "trials_before": self._count,
            "mode": event.mode,
            "cause": event.cause,
            "goal_kind": None if goal is None else goal.kind,
        }
        places = {} if goal is None else self._goal("goal.", goal.kind, goal.point)
        if event.context is not None:
            places |= _place("context", self._contexts["context"], event.context)
        _append(self.episodes, row, places)

    def _close(self, event: Closed) -> None:
        at, goal = self._rows[event.episode], event.pursued
        row: dict[str, Any] = {
            "credited": event.mode,
            "pursued_kind": None if goal is None else goal.kind,
            "competence_before": event.before,
            "competence_after": event.after,
            "trials": event.movements,
        }
        places = {} if goal is None else self._goal("pursued.", goal.kind, goal.point)
        for key, value in (row | places).items():
            self.episodes[key].values[at] = value

    def _end(
        self, number: int, how: str, seconds: float | None, outcome: Mapping[str, Any]
    ) -> None:
        plan = self._plans.pop(number, None)
        if plan is None or plan.policy is None:  # a request is no trial
            return
        opened = self._opened[plan.episode]
        moved = how in ("told", "failed")
        row = {
            "trial": self._count if moved else None,
            "plan": number,
            "episode": plan.episode,
            "mode": opened.mode,
            "goal_kind": None if opened.goal is None else opened.goal.kind,
            "ended": how,
            "seconds": seconds,
        }
        self._count += moved
        spots = {"policy": plan.policy, "context": plan.context}
        _append(self.trials, row, self._places(spots, outcome))

    def _places(self, spots: Mapping[str, Any], outcome: Mapping[str, Any]) -> dict[str, Any]:
        places = _place("policy", self._task.policy_space, spots["policy"])
        if spots["context"] is not None:
            places |= _place("context", self._contexts["context"], spots["context"])
        for kind, point in outcome.items():
            places |= _place(f"outcome.{kind}", self._task.outcome_spaces[kind], point)
        return places

    def _goal(self, prefix: str, kind: str, point: Any) -> dict[str, Any]:
        return _place(f"{prefix}{kind}", self._task.goal_spaces[kind], point)


def _columns(sort: Sort, *names: str) -> Table:
    return {name: Column(sort) for name in names}


def _of_spaces(spaces: Mapping[str, Space], prefix: str = "") -> Table:
    """Columns for the points of these spaces."""
    found: Table = {}
    for name, space in spaces.items():
        if isinstance(space, Choices):
            found[f"{prefix}{name}"] = Column("text")
            continue
        units: Sequence[str | None] = [None] * len(_names(space))
        if isinstance(space, Box):
            units = space.units
        for part, unit in zip(_names(space), units, strict=True):
            found[f"{prefix}{name}.{part}"] = Column("number", unit)
    return found


def _names(space: Space) -> Sequence[str]:
    if isinstance(space, Box):
        return space.names
    return [str(i) for i in range(space.dimension or 0)]


def _place(name: str, space: Space, point: Any) -> dict[str, Any]:
    """A point as values of its columns."""
    if isinstance(space, Choices):
        return {name: point}
    if not _names(space):
        return {}
    numbers = point if isinstance(space, Box) else space.encode(point)
    return {
        f"{name}.{part}": float(x)
        for part, x in zip(_names(space), np.asarray(numbers), strict=True)
    }


def _append(table: Table, row: Mapping[str, Any], places: Mapping[str, Any]) -> None:
    found: Iterable[tuple[str, Column]] = table.items()
    for key, column in found:
        column.values.append(row[key] if key in row else places.get(key))
