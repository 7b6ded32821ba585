"""What a run has cost: the time of the robot, and of the persons whom it asked."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sgim.runs.journal_file import open_file
from sgim.runs.journal_reading import read_columns
from sgim.spaces import FloatArray


@dataclass(frozen=True)
class Prices:
    """What things cost where a journal does not say.

    Attributes:
        robot_seconds: Of a movement.
        person_seconds: Of a request that was answered, also by a no.
    """

    robot_seconds: float = 1.0
    person_seconds: float = 10.0


@dataclass(frozen=True)
class Spending:
    """What was spent before each evaluation of a run, in order.

    Attributes:
        movements: Movements whose time is not recorded, shape ``(evaluations,)``.
        requests: Answered requests whose time is not recorded.
        seconds: Time that is recorded, of robot and persons together.
        asked: Answered requests in all, recorded or not.
    """

    movements: NDArray[np.int64]
    requests: NDArray[np.int64]
    seconds: FloatArray
    asked: NDArray[np.int64]

    @property
    def recorded(self) -> bool:
        """Whether some of the time is recorded."""
        return bool(self.seconds.any())

    def cost(self, prices: Prices) -> FloatArray:
        """Seconds before each evaluation: as recorded, or else by these prices."""
        return np.asarray(
            self.seconds
            + prices.robot_seconds * self.movements
            + prices.person_seconds * self.requests
        )


def read_spending(path: str | Path) -> Spending:
    """Read what a run had spent when it was evaluated; its task need not be known.

    A movement that failed costs as one that was told. What ended in another way, or was asked
    and never answered, costs only what is recorded.

    Raises:
        JournalError: If it cannot be read.
    """
    path = Path(path)
    with closing(open_file(path, append=False, durable=False)) as db:
        told = read_columns(db, path, "told", ("seq", "seconds"))
        answered = read_columns(db, path, "answered", ("seq", "seconds"))
        ended = read_columns(db, path, "ended", ("seq", "seconds", "plan", "name"))
        planned = read_columns(db, path, "planned", ("plan", "name")) if ended else []
        evaluated = read_columns(db, path, "evaluated", ("seq",))
    requests = {plan for plan, teacher in planned if teacher is not None}
    told += [(seq, s) for seq, s, plan, how in ended if how == "failed" and plan not in requests]
    moved = {seq for seq, _ in told}
    others = [(seq, s) for seq, s, *_ in ended if s is not None and seq not in moved]
    ends = np.array([seq for (seq,) in evaluated], dtype=np.int64)
    return Spending(
        movements=_before(ends, [seq for seq, s in told if s is None]),
        requests=_before(ends, [seq for seq, s in answered if s is None]),
        seconds=_seconds_before(ends, [*told, *answered, *others]),
        asked=_before(ends, [seq for seq, _ in answered]),
    )


def _before(ends: NDArray[np.int64], seqs: list[int]) -> NDArray[np.int64]:
    return np.searchsorted(np.sort(np.array(seqs, dtype=np.int64)), ends).astype(np.int64)


def _seconds_before(ends: NDArray[np.int64], spent: list[tuple[int, float | None]]) -> FloatArray:
    known = sorted((seq, seconds) for seq, seconds in spent if seconds is not None)
    total = np.concatenate([[0.0], np.cumsum([seconds for _, seconds in known])])
    return np.asarray(total[_before(ends, [seq for seq, _ in known])])
