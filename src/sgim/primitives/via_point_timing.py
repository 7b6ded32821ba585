"""When a movement passes its via points, and how sharply each of them attracts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sgim.errors import SpaceError
from sgim.primitives.recordings import with_sum
from sgim.spaces import FloatArray

# Between two via points all weights must stay far above the smallest number.
_LARGEST_EXPONENT = 500.0


class Timing(Protocol):
    """From timing parameters, in s, to the instants of via points."""

    @property
    def points(self) -> int:
        """Number of via points."""
        ...

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        ...

    @property
    def shortest(self) -> float:
        """Least value of each parameter, in s."""
        ...

    @property
    def longest(self) -> float:
        """Greatest value of each parameter, in s."""
        ...

    def schedule(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """When the via points are passed, and σ of eq. 4.1.

        Args:
            parameters: Shape ``(n, parameters)``, in s.

        Returns:
            Instants in s, increasing from 0 to the movement's end, shape ``(n, points)``; and σ
            in s⁻², shape ``(n,)``.
        """
        ...

    def starts(self, duration: float) -> Iterator[FloatArray]:
        """Parameters from which to begin a fit to a recording of this duration."""
        ...

    def with_duration(self, parameters: FloatArray, duration: float) -> FloatArray:
        """The parameters, changed as little as it takes for the movement to last this long."""
        ...


@dataclass(frozen=True)
class Intervals:
    """Each via point but the first comes an interval of its own after the one before it.

    The timing of the thesis's eq. 4.1: t₀ = 0 < t₁ < …, and one σ for all.

    Attributes:
        points: Number of via points, 2 or more.
        shortest: Least interval, in s.
        longest: Greatest interval, in s.
        sharpness: σ, in s⁻²; the smaller, the smoother.

    Raises:
        SpaceError: If a number is not positive or out of order, or the weights would vanish
            between two via points.
    """

    points: int
    shortest: float
    longest: float
    sharpness: float

    def __post_init__(self) -> None:
        _check(self.points, self.shortest, self.longest)
        if not 0 < self.sharpness * (self.longest / 2) ** 2 <= _LARGEST_EXPONENT:
            raise SpaceError(
                f"sharpness is {self.sharpness:g} s⁻², expected a positive number of at most "
                f"{_LARGEST_EXPONENT / (self.longest / 2) ** 2:g} s⁻² for intervals of up to "
                f"{self.longest:g} s"
            )

    @property
    def names(self) -> tuple[str, ...]:
        """The names ``interval_1``, ``interval_2`` and so on."""
        return tuple(f"interval_{i}" for i in range(1, self.points))

    def schedule(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Cumulative sums of the intervals; see `Timing.schedule`."""
        instants = np.zeros((len(parameters), self.points))
        np.cumsum(parameters, axis=1, out=instants[:, 1:])
        return instants, np.full(len(parameters), self.sharpness)

    def starts(self, duration: float) -> Iterator[FloatArray]:
        """Equal intervals, then longer ones in one place of the movement after another."""
        count = self.points - 1
        yield np.full(count, duration / count)
        if count > 1:
            for place in np.linspace(0, count - 1, 4):
                shares = 1 + 2 * np.exp(-((np.arange(count) - place) ** 2))
                yield self.with_duration(shares * (duration / shares.sum()), duration)

    def with_duration(self, parameters: FloatArray, duration: float) -> FloatArray:
        """Intervals between the shortest and the longest that add up to the duration."""
        beyond = np.clip(parameters, self.shortest, self.longest) - self.shortest
        end = max(0.0, duration - self.shortest * len(parameters))
        return self.shortest + with_sum(beyond, end, self.longest - self.shortest)


@dataclass(frozen=True)
class EvenlySpaced:
    """Via points at equal intervals; the movement's duration is the one parameter, if any.

    The timing of the thesis's eq. 3.6: u₁ to u₄ at 0, δ/3, 2δ/3 and δ.

    Attributes:
        points: Number of via points, 2 or more.
        shortest: Least duration δ, in s.
        longest: Greatest duration, in s; if it is the shortest, there is no parameter.
        width: Standard deviation of the weights as a share of the duration: σ = 1/(2 (width·δ)²).

    Raises:
        SpaceError: If a number is not positive or out of order, or the weights would vanish
            between two via points.
    """

    points: int
    shortest: float
    longest: float
    width: float = 1 / 6

    def __post_init__(self) -> None:
        _check(self.points, self.shortest, self.longest, fixed=self.shortest == self.longest)
        least = 0.5 / (self.points - 1) / np.sqrt(2 * _LARGEST_EXPONENT)
        if not least <= self.width < np.inf:
            raise SpaceError(
                f"width is {self.width:g} of the duration, expected {least:g} or more for "
                f"{self.points} via points"
            )

    @property
    def names(self) -> tuple[str, ...]:
        """The name ``duration``; none if it is fixed."""
        return ("duration",) if self.shortest < self.longest else ()

    def schedule(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Equal parts of the duration; see `Timing.schedule`."""
        free = self.shortest < self.longest
        durations = parameters[:, 0] if free else np.full(len(parameters), self.shortest)
        instants = durations[:, None] * (np.arange(self.points) / (self.points - 1))
        return instants, 0.5 / (self.width * durations) ** 2

    def starts(self, duration: float) -> Iterator[FloatArray]:
        """The duration itself, if it is a parameter."""
        yield self.with_duration(np.empty(0), duration)

    def with_duration(self, parameters: FloatArray, duration: float) -> FloatArray:
        """The duration itself, if it is a parameter."""
        return np.clip([duration] * len(self.names), self.shortest, self.longest)


def _check(points: int, shortest: float, longest: float, fixed: bool = False) -> None:
    if points < 2:
        raise SpaceError(f"points is {points}, expected 2 or more via points")
    if not 0 < shortest < longest < np.inf and not (fixed and 0 < shortest < np.inf):
        raise SpaceError(
            f"times are between shortest={shortest:g} and longest={longest:g} s, "
            "expected 0 < shortest < longest"
        )
