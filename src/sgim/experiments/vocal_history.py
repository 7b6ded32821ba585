"""What was aimed at and what was heard in a vocal run, vocalisation by vocalisation."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sgim.environments.vocal.classes import CLASSES, classes, types
from sgim.environments.vocal.motor import MOTORS
from sgim.environments.vocal.perception import SOUND, Sounds
from sgim.errors import JournalError
from sgim.runs.journal import Journal
from sgim.runs.summary import RecordedRun, read_run
from sgim.spaces import FloatArray

_NO_MODE = -1


@dataclass(frozen=True)
class VocalHistory:
    """The vocalisations of a run in the order they were told.

    Attributes:
        sounds: What was heard, in single precision to keep many runs, shape ``(n, 6)``.
        goals: What was pursued, shape ``(n, 6)``; NaN where nothing was.
        names: Names of modes.
        modes: The mode of each vocalisation, a place in ``names``, shape ``(n,)``; -1 where its
            episode had not ended when the run was read.
    """

    sounds: Sounds
    goals: Sounds
    names: tuple[str, ...]
    modes: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.sounds)

    def part(self, start: int, end: int) -> VocalHistory:
        """The vocalisations from a number on, up to another."""
        if start == 0 and end >= len(self):
            return self
        rows = slice(start, end)
        return VocalHistory(self.sounds[rows], self.goals[rows], self.names, self.modes[rows])

    @cached_property
    def classes(self) -> NDArray[np.int64]:
        """The class of each, a place in `CLASSES`."""
        return classes(self.sounds)

    @cached_property
    def types(self) -> NDArray[np.int64]:
        """The type of each, a place in `TYPES`."""
        return types(self.sounds)

    @cached_property
    def competences(self) -> FloatArray:
        """e^(−distance from goal to sound) of each (section 5.2.3); NaN without a goal."""
        apart = self.sounds - self.goals.astype(np.float64)
        found: FloatArray = np.exp(-np.linalg.norm(apart, axis=1))
        return found

    def of_mode(self, first_word: str) -> NDArray[np.bool_]:
        """Which are of modes whose name begins with a word, such as ``emulate``."""
        wanted = [i for i, name in enumerate(self.names) if name.partition(" ")[0] == first_word]
        return np.isin(self.modes, wanted)

    def shares(self, windows: int) -> FloatArray:
        """Shares of the classes in windows of equal numbers of vocalisations.

        Returns:
            Shape ``(windows, 3)``.

        Raises:
            JournalError: If there are fewer vocalisations than windows.
        """
        if len(self) < windows:
            raise JournalError(
                f"the run has {len(self)} vocalisations, too few for {windows} windows"
            )
        edges = np.linspace(0, len(self), windows + 1).astype(int)
        counted = np.cumsum(np.eye(len(CLASSES))[self.classes], axis=0)
        total = np.concatenate([np.zeros((1, len(CLASSES))), counted])[edges]
        found: FloatArray = np.diff(total, axis=0) / np.diff(edges)[:, None]
        return found


@dataclass(frozen=True)
class VocalRun(RecordedRun):
    """What a journal says of a vocal run.

    Attributes:
        history: Its vocalisations.
    """

    history: VocalHistory

    @property
    def language(self) -> str | None:
        """Name of the language around the learner; None without a teacher."""
        teachers = self.recipe.get("teachers") or []
        return str(teachers[0]) if len(teachers) == 1 else None


def read_vocal_run(path: str | Path) -> VocalRun:
    """Read a vocal run with its vocalisations.

    Raises:
        JournalError: If it cannot be read, or is of another world.
    """
    return with_history(read_run(path))


def with_history(run: RecordedRun) -> VocalRun:
    """A run that was read already, with its vocalisations."""
    known = {field.name: getattr(run, field.name) for field in fields(RecordedRun)}
    return VocalRun(**known, history=read_history(run.path))


def read_history(path: str | Path) -> VocalHistory:
    """Read the vocalisations of a run.

    Raises:
        JournalError: If it cannot be read, or is of another world.
    """
    with Journal.open(path, append=False) as journal:
        _require_vocal(journal)
        told = journal.columns("told", "plan", "point")
        episodes = dict(journal.columns("planned", "plan", "episode"))
        closed = {e: rest for e, *rest in journal.columns("closed", "episode", "name", "point")}
    aimless = np.full(len(SOUND), np.nan).tobytes()
    ends = [closed.get(episodes[plan], (None, None)) for plan, _ in told]
    names = sorted({str(name) for name, _ in ends if name is not None})
    code: dict[str | None, int] = {name: i for i, name in enumerate(names)}
    return VocalHistory(
        _table([point for _, point in told], len(SOUND)).astype(np.float32),
        _table([point or aimless for _, point in ends], len(SOUND)).astype(np.float32),
        tuple(names),
        np.array([code.get(name, _NO_MODE) for name, _ in ends], dtype=np.int64),
    )


def read_policies(path: str | Path) -> FloatArray:
    """The policies of a run's vocalisations, in the order they were told, shape ``(n, 18)``.

    Raises:
        JournalError: If it cannot be read, or is of another world.
    """
    with Journal.open(path, append=False) as journal:
        _require_vocal(journal)
        policies = dict(journal.columns("planned", "plan", "policy"))
        told = [plan for (plan,) in journal.columns("told", "plan")]
    return _table([policies[plan] for plan in told], 2 * len(MOTORS))


def _table(rows: list[bytes], columns: int) -> FloatArray:
    return np.frombuffer(b"".join(rows), "<f8").reshape(-1, columns).astype(np.float64)


def _require_vocal(journal: Journal) -> None:
    if [*journal.task.outcome_spaces] != ["sound"]:
        raise JournalError(f"{journal.path} is not of a vocal tract: it has no sounds")
