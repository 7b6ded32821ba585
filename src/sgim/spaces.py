"""Spaces: what a policy, an outcome, a goal or a context can be.

A space is anything that satisfies `Space`. Vectors in a box and labels come with the library;
a picture, a graph or a program needs a class of the same five methods. The learner's levels
only ever see points through their space, so a point may be any Python object. What a space can
`encode` as a vector scaled to the unit box, the vector-based parts (memory, region trees, local
search) can work with; a space whose ``dimension`` is None is opaque to them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sgim.arrays import Arrays
from sgim.errors import SpaceError, unknown

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

_LITTLE_ENDIAN = np.dtype("<f8")
_LARGEST = 1e100  # Of a coordinate's magnitude: squares of scaled differences must not overflow.


@runtime_checkable
class Space(Protocol):
    """What every space can do."""

    @property
    def dimension(self) -> int | None:
        """Length of an encoded point; None when points cannot be encoded."""
        ...

    def check(self, value: Any, what: str = "value") -> Any:
        """Return ``value`` as a point of this space; raise `SpaceError` naming ``what``."""
        ...

    def contains(self, point: Any) -> bool:
        """Whether a checked point lies within the space's bounds."""
        ...

    def sample(self, rng: np.random.Generator) -> Any:
        """Draw a point."""
        ...

    def encode(self, point: Any) -> FloatArray:
        """Vector of shape ``(dimension,)``; points within the bounds map into the unit box."""
        ...

    def pack(self, point: Any) -> bytes:
        """The point as bytes, for the journal."""
        ...

    def unpack(self, data: bytes) -> Any:
        """The point that ``pack`` made these bytes of, exactly."""
        ...

    def describe(self) -> dict[str, Any]:
        """A JSON-compatible description; two spaces are the same if theirs are equal."""
        ...


class Box:
    """Vectors of real numbers between bounds.

    Args:
        low: Lower bounds, shape ``(d,)``, or one number for all.
        high: Upper bounds, shape ``(d,)``, or one number for all; above ``low`` everywhere.
        names: Names of the ``d`` coordinates; they also fix ``d`` when both bounds are numbers.
        unit: Unit of the coordinates: one for all, or one each.

    Raises:
        SpaceError: If bounds are not finite, not in order, or disagree in length with the names.
    """

    def __init__(
        self,
        low: ArrayLike,
        high: ArrayLike,
        names: Sequence[str] | None = None,
        unit: str | Sequence[str] | None = None,
    ) -> None:
        lows = np.atleast_1d(np.asarray(low, dtype=np.float64))
        highs = np.atleast_1d(np.asarray(high, dtype=np.float64))
        d = max(len(lows), len(highs), len(names) if names is not None else 1)
        try:
            self.low = np.broadcast_to(lows, (d,)).copy()
            self.high = np.broadcast_to(highs, (d,)).copy()
        except ValueError:
            raise SpaceError(
                f"box bounds have shapes {lows.shape} and {highs.shape}"
                + (f" for {d} names" if names is not None else "")
                + "; expected one number or one per coordinate"
            ) from None
        if not (np.isfinite(self.low).all() and np.isfinite(self.high).all()):
            raise SpaceError(f"box bounds must be finite, got low={low!r}, high={high!r}")
        if not (self.low < self.high).all():
            i = int(np.argmin(self.low < self.high))
            raise SpaceError(
                f"box needs low < high in every coordinate, but coordinate {i} has "
                f"low={self.low[i]:g} and high={self.high[i]:g}"
            )
        if names is not None and len(names) != d:
            raise SpaceError(f"box has {d} coordinates but {len(names)} names: {list(names)}")
        self.names = tuple(names) if names is not None else tuple(f"x{i}" for i in range(d))
        units = (unit,) * d if isinstance(unit, str) or unit is None else tuple(unit)
        if len(units) != d:
            raise SpaceError(f"box has {d} coordinates but {len(units)} units: {list(units)}")
        self.units = units
        self.range = self.high - self.low
        # The width that leads from low to high or, where rounding would pass it, just short of it.
        self._width = self.range.copy()
        while (beyond := self.low + self._width > self.high).any():
            self._width[beyond] = np.nextafter(self._width[beyond], 0.0)
        self._lows, self._ranges = self.low.tolist(), self.range.tolist()
        self._shape = (d,)
        self.low.flags.writeable = self.high.flags.writeable = self.range.flags.writeable = False

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return self._shape[0]

    def check(self, value: Any, what: str = "value") -> FloatArray:
        """Return ``value`` as a finite float64 vector of shape ``(d,)``; bounds may be passed.

        Magnitudes above 1e100, such as a simulation that diverged gives, are refused like
        infinity.
        """
        try:
            point = np.array(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise SpaceError(
                f"{what} is {type(value).__name__} {value!r:.60}, expected {self._expected()}"
            ) from None
        if point.shape != self._shape:
            if point.shape == () and self._shape == (1,):  # a plain number means the one there is
                return self.check(point.reshape(1), what)
            raise SpaceError(f"{what} has shape {point.shape}, expected {self._expected()}")
        # The norm bounds every coordinate, and is NaN or infinite if one is.
        if not math.hypot(*point.tolist()) <= _LARGEST:
            fine = np.abs(point) <= _LARGEST
            if not fine.all():
                i = int(np.argmin(fine))
                raise SpaceError(
                    f"{what} has {point[i]} at {self.names[i]!r}; every coordinate must be "
                    f"finite, and at most {_LARGEST:g} in magnitude"
                )
        return point

    def check_all(self, values: Sequence[Any], what: str = "value") -> list[FloatArray]:
        """As `check` for each of several values, all at once."""
        try:
            points = np.array(values, dtype=np.float64)
        except (TypeError, ValueError):  # what is malformed is named one by one, below
            points = np.empty(0)
        if points.shape[1:] == self._shape and _all(np.abs(points) <= _LARGEST):
            return list(points)
        return [self.check(value, what) for value in values]

    def _expected(self) -> str:
        parts = [
            n if u is None else f"{n} {u}" for n, u in zip(self.names, self.units, strict=True)
        ]
        shown = parts if len(parts) <= 4 else [*parts[:2], "…", parts[-1]]
        return f"{self._shape}: ({', '.join(shown)})"

    def contains(self, point: FloatArray) -> bool:
        """Whether the point lies within the bounds, borders included.

        Of an array of points, shape ``(..., d)``, whether all do.
        """
        return _all(point >= self.low) and _all(point <= self.high)

    def clip(self, point: FloatArray) -> FloatArray:
        """The nearest point within the bounds."""
        return np.clip(point, self.low, self.high)

    def sample(self, rng: np.random.Generator) -> FloatArray:
        """Draw uniformly between the bounds."""
        return self.low + self._width * rng.random(self._shape[0])

    def sample_all(self, rngs: Sequence[np.random.Generator]) -> FloatArray:
        """As `sample` for each of several generators, one or more: ``(n, d)``."""
        d = self._shape[0]
        drawn: FloatArray = self.low + self._width * np.array([rng.random(d) for rng in rngs])
        return drawn

    def encode(self, point: FloatArray) -> FloatArray:
        """Scale to the unit box; also for arrays of shape ``(..., d)``."""
        scaled: FloatArray = (point - self.low) / self.range
        return scaled

    def encoded(self, point: FloatArray) -> list[float]:
        """As `encode`, in plain numbers: faster for one point of few coordinates."""
        numbers = zip(point.tolist(), self._lows, self._ranges)  # noqa: B905 - a hot path
        return [(x - low) / width for x, low, width in numbers]

    def decode(self, vector: FloatArray) -> FloatArray:
        """The point that encodes to ``vector``, but for rounding; also for shape ``(..., d)``.

        Vectors in the unit box give points within the bounds.
        """
        point: FloatArray = self.low + vector * self._width
        return point

    def pack(self, point: FloatArray) -> bytes:
        """Little-endian float64 bytes."""
        return point.astype(_LITTLE_ENDIAN, copy=False).tobytes()

    def unpack(self, data: bytes) -> FloatArray:
        """The vector that was packed."""
        return np.frombuffer(data, _LITTLE_ENDIAN).astype(np.float64)

    def describe(self) -> dict[str, Any]:
        """Bounds, names and units."""
        return {
            "space": "box",
            "low": self.low.tolist(),
            "high": self.high.tolist(),
            "names": list(self.names),
            "units": list(self.units),
        }

    def __repr__(self) -> str:
        return f"Box({self.low.tolist()}, {self.high.tolist()}, names={list(self.names)})"


def _all(truths: NDArray[np.bool_]) -> bool:
    """Whether all are true; ``truths.all()`` takes three times as long for a few."""
    return bool(truths.item(truths.argmin()))


class Choices:
    """A finite set of labels, all equally far apart.

    Args:
        labels: The labels, each different.

    Raises:
        SpaceError: If there is no label, or one comes twice.
    """

    def __init__(self, labels: Sequence[str]) -> None:
        self.labels = tuple(labels)
        if not self.labels or len(set(self.labels)) != len(self.labels):
            raise SpaceError(f"choices need one or more different labels, got {list(labels)!r}")
        self._index = {label: i for i, label in enumerate(self.labels)}

    @property
    def dimension(self) -> int:
        """Number of labels."""
        return len(self.labels)

    def check(self, value: Any, what: str = "value") -> str:
        """Return ``value`` if it is one of the labels."""
        if not isinstance(value, str) or value not in self._index:
            raise SpaceError(f"{what}: {unknown('label', value, self.labels)}")
        return value

    def contains(self, point: str) -> bool:
        """Whether ``point`` is one of the labels."""
        return point in self._index

    def sample(self, rng: np.random.Generator) -> str:
        """Draw a label, all alike."""
        return self.labels[int(rng.integers(len(self.labels)))]

    def encode(self, point: str) -> FloatArray:
        """One-hot vector scaled so that two different labels are at distance 1."""
        vector = np.zeros(len(self.labels))
        vector[self._index[point]] = np.sqrt(0.5)
        return vector

    def pack(self, point: str) -> bytes:
        """The label in UTF-8."""
        return point.encode()

    def unpack(self, data: bytes) -> str:
        """The label that was packed."""
        return data.decode()

    def describe(self) -> dict[str, Any]:
        """The labels."""
        return {"space": "choices", "labels": list(self.labels)}

    def __repr__(self) -> str:
        return f"Choices({list(self.labels)})"


def space_from_description(description: Mapping[str, Any]) -> Space:
    """Make a `Box`, `Choices` or `Arrays` again from what its ``describe`` gave.

    Raises:
        SpaceError: If the description is of a space that is not part of the library.
    """
    kind = description.get("space")
    if kind == "box":
        return Box(
            description["low"], description["high"], description["names"], description["units"]
        )
    if kind == "choices":
        return Choices(description["labels"])
    if kind == "arrays":
        fields = {
            name: (dtype, columns) for name, (dtype, columns) in description["fields"].items()
        }
        return Arrays(fields, description["together"])
    raise SpaceError(
        f"a space described as {kind!r} cannot be rebuilt from a journal alone; "
        "pass the task that has it"
    )
