"""Measures of interest: what a region's recent episodes say about learning there.

A measure turns the records of a region and mode, oldest first, into an interest ≥ 0 or about 0,
before it is divided by the mode's cost.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

from sgim.outcome.interest import EpisodeReport


class Record(NamedTuple):
    """One attempted goal: its place, the progress made, and the competence after."""

    place: tuple[float, ...]
    progress: float
    competence: float


class InterestMeasure(Protocol):
    """Turns episodes into progress, and recent records into interest."""

    def progress(self, report: EpisodeReport) -> float:
        """Progress of one episode."""
        ...

    def interest(self, records: Sequence[Record]) -> float:
        """Interest of a region from its records of one mode, oldest first."""
        ...


class MeanProgress:
    """Mean of the last δ progress values (thesis eq. 4.2 and 4.3).

    Progress is tanh(x/2) with x = α_p · (competence gained) / (size · movements), where size is
    a number for each goal kind.

    Args:
        sizes: Goal kind → size |A_i|.
        scale: α_p.
        window: δ.
    """

    def __init__(
        self, sizes: Mapping[str, float], *, scale: float = 1000.0, window: int = 10
    ) -> None:
        self.sizes = dict(sizes)
        self.scale = scale
        self.window = window

    def progress(self, report: EpisodeReport) -> float:
        """Eq. 4.2, positive when the competence grew."""
        size = self.sizes[report.pursued.kind]
        gain = (report.after - report.before) / (size * report.movements)
        return math.tanh(self.scale * gain / 2)

    def interest(self, records: Sequence[Record]) -> float:
        """Eq. 4.3 without the cost."""
        recent = records[-self.window :]
        return math.fsum(r.progress for r in recent) / len(recent) if recent else 0.0


class CompetenceChange:
    """Absolute change of competence over a sliding window (thesis eq. 2.2 and 3.4).

    With fewer records than the window is long, the halves are equal and as long as can be, and
    an odd oldest record is left out.

    Args:
        window: ζ, even.
        whole: Whether to divide by the window's length however few records there are, so that
            interest grows with them; else by the length of both halves.
    """

    def __init__(self, *, window: int = 20, whole: bool = False) -> None:
        if window < 2 or window % 2:
            raise ValueError(f"window is {window}, expected an even number of 2 or more")
        self.window = window
        self.whole = whole

    def progress(self, report: EpisodeReport) -> float:
        """Competence gained in the episode."""
        return report.after - report.before

    def interest(self, records: Sequence[Record]) -> float:
        """Eq. 3.4."""
        half = min(len(records), self.window) // 2
        if half == 0:
            return 0.0
        older = math.fsum(r.competence for r in records[-2 * half : -half])
        newer = math.fsum(r.competence for r in records[-half:])
        return abs(older - newer) / (self.window if self.whole else 2 * half)
