"""A space of named arrays with as many rows as there happen to be: features, points, sounds."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.errors import SpaceError, unknown

_MOST_SAMPLED_ROWS = 8


class Arrays:
    """Points are mappings name → array; each name has a type and a number of columns.

    Args:
        fields: Name → (NumPy type, columns), such as ``{"colours": ("float32", 3)}``.
        together: Groups of fields that have one row for the same thing each, and so as many rows.

    Raises:
        SpaceError: If there is no field, one is not of a number type with columns, or a group
            names one that is not there.
    """

    dimension = None

    def __init__(
        self, fields: Mapping[str, tuple[str, int]], together: Sequence[Sequence[str]] = ()
    ) -> None:
        self.fields: dict[str, tuple[str, int]] = {}
        for name, (kind, columns) in fields.items():
            dtype = np.dtype(kind)
            if dtype.kind not in "iuf" or columns < 1:
                raise SpaceError(f"field {name!r} is {(kind, columns)}, expected a number type and "
                                 "1 or more columns")  # fmt: skip
            self.fields[name] = (dtype.name, int(columns))
        if not self.fields:
            raise SpaceError("a space of arrays needs one or more fields: {name: (type, columns)}")
        self.together = [list(group) for group in together]
        for name in (name for group in self.together for name in group):
            if name not in self.fields:
                raise unknown("field", name, self.fields)

    def check(self, value: Any, what: str = "value") -> dict[str, NDArray[Any]]:
        """Return ``value`` as read-only arrays of the fields' types.

        Raises:
            SpaceError: If a field is missing or not known, an array has another type or shape, or
                a number is not finite; or if fields that go together differ in rows.
        """
        if not isinstance(value, Mapping) or set(value) != set(self.fields):
            came = sorted(value) if isinstance(value, Mapping) else type(value).__name__
            raise SpaceError(f"{what} is {came}, expected arrays {', '.join(self.fields)}")
        checked = {}
        for name, (kind, columns) in self.fields.items():
            array = np.asarray(value[name])
            if array.ndim != 2 or array.shape[1] != columns or array.dtype != kind:
                raise SpaceError(
                    f"{what} has {name!r} of shape {array.shape}, {array.dtype}; expected "
                    f"(rows, {columns}), {kind}"
                )
            if not np.isfinite(array).all():
                raise SpaceError(f"{what} has a number in {name!r} that is not finite")
            if array.flags.writeable:
                array = array.copy()
                array.flags.writeable = False
            checked[name] = array
        for group in self.together:
            if len({len(checked[name]) for name in group}) > 1:
                counts = ", ".join(f"{len(checked[name])} in {name!r}" for name in group)
                raise SpaceError(f"{what} has {counts}; expected as many rows in each")
        return checked

    def contains(self, point: Any) -> bool:
        """Always: there are no bounds."""
        return True

    def sample(self, rng: np.random.Generator) -> dict[str, NDArray[Any]]:
        """Draw arrays of a few rows of small numbers."""
        drawn: dict[str, NDArray[Any]] = {}
        for name, (kind, columns) in self.fields.items():
            like = next((g[0] for g in self.together if name in g and g[0] in drawn), None)
            rows = (
                int(rng.integers(1, _MOST_SAMPLED_ROWS + 1)) if like is None else len(drawn[like])
            )
            drawn[name] = rng.integers(0, 100, (rows, columns)).astype(kind)
        return drawn

    def encode(self, point: Any) -> Any:
        """Arrays have no place in a unit box.

        Raises:
            SpaceError: Always.
        """
        raise SpaceError("arrays of any number of rows cannot be encoded as a vector")

    def pack(self, point: Mapping[str, NDArray[Any]]) -> bytes:
        """Numbers of rows, then the arrays in the order of the fields, little-endian."""
        arrays = [
            np.ascontiguousarray(point[name], np.dtype(kind).newbyteorder("<"))
            for name, (kind, _) in self.fields.items()
        ]
        rows = struct.pack(f"<{len(arrays)}I", *(len(array) for array in arrays))
        return rows + b"".join(array.tobytes() for array in arrays)

    def unpack(self, data: bytes) -> dict[str, NDArray[Any]]:
        """The arrays that were packed, read-only."""
        counts = struct.unpack_from(f"<{len(self.fields)}I", data)
        start, point = 4 * len(counts), {}
        for (name, (kind, columns)), rows in zip(self.fields.items(), counts, strict=True):
            dtype = np.dtype(kind).newbyteorder("<")
            array = np.frombuffer(data, dtype, rows * columns, start)
            start += array.nbytes
            array = array.reshape(rows, columns).astype(kind)
            array.flags.writeable = False
            point[name] = array
        return point

    def describe(self) -> dict[str, Any]:
        """The fields, and which go together."""
        fields = {name: list(field) for name, field in self.fields.items()}
        return {"space": "arrays", "fields": fields, "together": self.together}

    def __repr__(self) -> str:
        return f"Arrays({self.fields})"
