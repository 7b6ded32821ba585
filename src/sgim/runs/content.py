"""What was aimed at, produced and shown in a run: read from its journal when asked for."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.events import Closed, Told
from sgim.runs.journal import Journal
from sgim.spaces import FloatArray
from sgim.task import Task


def outcomes_of(path: str | Path, task: Task) -> dict[str, tuple[list[int], list[Any]]]:
    """For each kind, which of the movements told produced it, and what.

    Raises:
        JournalError: If the journal cannot be read.
    """
    found: dict[str, tuple[list[int], list[Any]]] = {k: ([], []) for k in task.outcome_spaces}
    with Journal.open(path, task, append=False) as journal:
        for number, event in enumerate(journal.events(only=("told",))):
            assert isinstance(event, Told)
            for kind, point in event.outcome.items():
                found[kind][0].append(number)
                found[kind][1].append(point)
    return found


def goals_of(path: str | Path, task: Task, kind: str) -> tuple[NDArray[np.int64], FloatArray]:
    """The goals of a kind, of a task where it is a box, that episodes were begun for.

    Returns:
        Rows of the run's `Openings`, shape ``(n,)``, and the goals, shape ``(n, d)``.

    Raises:
        JournalError: If the journal cannot be read.
    """
    with Journal.open(path, task, append=False) as journal:
        opened = journal.columns("opened", "kind", "point")
    rows = [i for i, (its, _) in enumerate(opened) if its == kind]
    return np.array(rows, dtype=np.int64), _points(opened[i][1] for i in rows)


def shown_in(path: str | Path, task: Task) -> FloatArray:
    """The policies, of a task where they are vectors, that demonstrations were mapped to.

    Returns:
        In the order of the answers, shape ``(n, parameters)``.

    Raises:
        JournalError: If the journal cannot be read.
    """
    with Journal.open(path, task, append=False) as journal:
        policies = [policy for (policy,) in journal.columns("answered", "policy")]
    return _points(policy for policy in policies if policy is not None)


def shown_outcomes_of(path: str | Path, task: Task, kind: str) -> FloatArray:
    """What demonstrations had produced of a kind that is a box, in order, shape ``(n, d)``.

    Raises:
        JournalError: If the journal cannot be read.
    """
    with Journal.open(path, task, append=False) as journal:
        answered = journal.columns("answered", "kind", "point")
    return _points(point for its, point in answered if its == kind)


def progress_of(path: str | Path, task: Task) -> dict[str, tuple[FloatArray, FloatArray]]:
    """For each mode, when its episodes with a goal ended, and what they gained per movement.

    Returns:
        Mode → movements made in episodes closed by then, and gain of competence per movement,
        both of shape ``(n,)``.

    Raises:
        JournalError: If the journal cannot be read.
    """
    found: dict[str, list[tuple[float, float]]] = {}
    made = 0
    with Journal.open(path, task, append=False) as journal:
        for event in journal.events(only=("closed",)):
            assert isinstance(event, Closed)
            made += event.movements
            if event.before is not None and event.after is not None and event.movements:
                gain = (event.after - event.before) / event.movements
                found.setdefault(event.mode, []).append((float(made), gain))
    return {mode: (np.array(pairs)[:, 0], np.array(pairs)[:, 1]) for mode, pairs in found.items()}


def _points(packed: Iterable[bytes]) -> FloatArray:
    """Points as boxes pack them, one a row."""
    points = [np.frombuffer(point, "<f8") for point in packed]
    return np.array(points, dtype=np.float64).reshape(len(points), -1 if points else 0)
