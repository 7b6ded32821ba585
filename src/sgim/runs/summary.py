"""What a journal says of its run, read without making a learner, also while the run goes on."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.errors import JournalError
from sgim.runs.content import goals_of, outcomes_of, shown_in
from sgim.runs.journal import Journal
from sgim.runs.measured import MeasuredRun, measures
from sgim.runs.rows import DECLINED
from sgim.spaces import Choices, FloatArray
from sgim.task import Task

QUARTERS = 4


@dataclass(frozen=True)
class Openings:
    """The episodes of a run in the order they were opened, all columns of one length.

    Attributes:
        movements: Movements made before each was opened, shape ``(n,)``.
        modes: The mode decided for each.
        kinds: The kind of the goal chosen for each; None for modes without a goal.
        labels: The label chosen for each, None where the goal is none; empty in tasks without
            labels as goals.
    """

    movements: NDArray[np.int64]
    modes: list[str]
    kinds: list[str | None]
    labels: list[str | None] = field(default_factory=list)

    @classmethod
    def pooled(cls, several: Iterable[Openings]) -> Openings:
        """The episodes of several runs together, run by run."""
        parts = list(several)
        return cls(
            np.concatenate([part.movements for part in parts]),
            [mode for part in parts for mode in part.modes],
            [kind for part in parts for kind in part.kinds],
            [label for part in parts for label in part.labels],
        )

    def of_kind(self, kind: str) -> Openings:
        """Those whose goal is of one kind."""
        rows = [i for i, its in enumerate(self.kinds) if its == kind]
        modes, labels = [self.modes[i] for i in rows], [self.labels[i] for i in rows if self.labels]
        return Openings(self.movements[rows], modes, [kind] * len(rows), labels)

    def shares(self, edges: NDArray[np.float64]) -> list[dict[str, dict[str, float]]]:
        """Shares of modes and of goal kinds among the episodes opened in each window.

        Args:
            edges: Movements at which windows begin and end, increasing, shape ``(w + 1,)``; what
                was opened before the first or after the last edge counts in the outermost.

        Returns:
            For each window ``{"modes": {mode: share}, "kinds": {kind: share}}``, with every mode
            and kind of the run; both are empty where no episode was opened. Shares of kinds sum
            to less than 1 where some modes have no goal.
        """
        window = np.clip(np.searchsorted(edges, self.movements, "right") - 1, 0, len(edges) - 2)
        shares = []
        for w in range(len(edges) - 1):
            rows = np.flatnonzero(window == w).tolist()
            shares.append({"modes": _share(self.modes, rows), "kinds": _share(self.kinds, rows)})
        return shares


def _share(names: list[Any], rows: list[int]) -> dict[str, float]:
    if not rows:
        return {}
    counts = Counter(names[i] for i in rows)
    return {name: counts[name] / len(rows) for name in sorted({*names} - {None})}


@dataclass(frozen=True)
class RecordedRun(MeasuredRun):
    """What a journal says of its run, in full.

    Attributes:
        task: The task of the run.
        movements: Movements made so far, told or failed.
        openings: Its episodes.
        troubles: How a plan ended without an outcome, such as ``"failed"`` or ``"declined"`` (a
            request without an answer) → how often.
    """

    task: Task
    movements: int
    openings: Openings
    troubles: Mapping[str, int]

    @property
    def finished(self) -> bool:
        """Whether it has reached the number of movements it was last asked for."""
        return self.target is not None and self.reached(self.target)

    def reached(self, movements: int) -> bool:
        """Whether it has made so many movements, and is evaluated as far as is due by then."""
        every: int = self.header.get("evaluate_every", 1)
        due = movements // every * every
        evaluated = not self.evaluations or self.evaluations[-1].movements >= due
        return self.movements >= movements and evaluated

    @property
    def choices(self) -> list[dict[str, dict[str, float]]]:
        """Shares of modes and kinds in each quarter of the movements it was last asked for."""
        end = self.movements if self.target is None else self.target
        return self.openings.shares(np.linspace(0.0, max(end, 1), QUARTERS + 1))

    def produced(self, kind: str, movements: int | None = None) -> FloatArray:
        """The outcomes of a kind that is a box, in order: of so many first trials, or of all.

        Returns:
            Shape ``(n, d)``.
        """
        when, points = outcomes_of(self.path, self.task)[kind]
        kept = points if movements is None else points[: bisect_left(when, movements)]
        return np.array(kept, dtype=np.float64).reshape(len(kept), -1 if kept else 0)

    def aimed_at(self, kind: str) -> tuple[NDArray[np.int64], FloatArray]:
        """Its goals of a kind that is a box; see `sgim.runs.content.goals_of`."""
        return goals_of(self.path, self.task, kind)

    def shown(self) -> FloatArray:
        """What was demonstrated, as policies that are vectors; see `sgim.runs.content.shown_in`."""
        return shown_in(self.path, self.task)

    def summary(self) -> dict[str, Any]:
        """As JSON: what was run, how far it is, its errors and its choices.

        Returns:
            ``experiment``, ``learner``, ``configuration``, ``seed``; ``movements``; ``finished``;
            ``evaluations``: for each, ``movements`` and ``cost`` (goal kind → mean error, and
            ``total``); ``choices``: for each quarter of the run, the shares among the episodes
            opened of ``modes`` and of the ``kinds`` of their goals.
        """
        return {
            "experiment": self.experiment,
            "learner": self.learner,
            "configuration": self.configuration,
            "seed": self.seed,
            "movements": self.movements,
            "finished": self.finished,
            "evaluations": [
                {"movements": e.movements, "cost": dict(e.errors)} for e in self.evaluations
            ],
            "choices": self.choices,
        }


def read_run(path: str | Path, task: Task | None = None) -> RecordedRun:
    """Read what a journal says of its run; trials are counted, not decoded.

    Args:
        path: The journal.
        task: Its task; needed only if its spaces are not part of the library.

    Raises:
        JournalError: If it cannot be read.
    """
    with Journal.open(path, task, append=False) as journal:
        measured = measures(journal.events(only=("evaluated", "session")))
        # Trials are read last: while the run goes on, they are no fewer than what is read first
        # says.
        opened = journal.columns("opened", "seq", "name", "kind")
        moved = _movements(journal)
        seqs = np.array([row[0] for row in opened], dtype=np.int64)
        openings = Openings(
            np.searchsorted(moved, seqs),
            [row[1] for row in opened],
            [row[2] for row in opened],
            _labels(journal),
        )
        return RecordedRun(
            Path(path),
            journal.header,
            task=journal.task,
            movements=len(moved),
            openings=openings,
            troubles=_troubles(journal),
            **measured,
        )


def _labels(journal: Journal) -> list[str | None]:
    """The labels that were chosen as goals; empty where goals are none."""
    spaces = journal.task.goal_spaces
    labels = {kind for kind, space in spaces.items() if isinstance(space, Choices)}
    if not labels:
        return []
    rows = journal.columns("opened", "kind", "point")
    return [spaces[kind].unpack(point) if kind in labels else None for kind, point in rows]


def summarise(path: str | Path, task: Task | None = None) -> dict[str, Any]:
    """The `RecordedRun.summary` of a journal."""
    return read_run(path, task).summary()


def find_journals(paths: list[Path]) -> list[Path]:
    """These journals, and those in these directories, each once.

    Raises:
        JournalError: If a path does not exist, or a directory has no journal.
    """
    found: dict[Path, None] = {}
    for path in paths:
        if path.is_dir():
            inside = sorted(path.rglob("*.sgim"))
            if not inside:
                raise JournalError(f"there is no journal (*.sgim) in {path}; check the path")
            found.update(dict.fromkeys(inside))
        elif path.exists():
            found[path] = None
        else:
            raise JournalError(f"there is no journal {path}; check the path")
    return list(found)


def _troubles(journal: Journal) -> Counter[str]:
    found = Counter(str(how) for (how,) in journal.columns("ended", "name"))
    details = (detail for (detail,) in journal.columns("answered", "detail"))
    if declined := sum(detail == DECLINED for detail in details):
        found["declined"] = declined
    return found


def _movements(journal: Journal) -> NDArray[np.int64]:
    """Rows at which a movement was made: told, or failed."""
    rows = [seq for (seq,) in journal.columns("told", "seq")]
    ended = journal.columns("ended", "seq", "name", "plan")
    if failed := {plan: seq for seq, how, plan in ended if how == "failed"}:
        for plan, teacher in journal.columns("planned", "plan", "name"):
            if teacher is not None:
                failed.pop(plan, None)  # a request that failed was no movement
    return np.sort(np.array([*rows, *failed.values()], dtype=np.int64))
