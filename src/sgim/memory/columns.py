"""Columns that grow by doubling: one number or vector a row, or one object a row."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Scalar = TypeVar("Scalar", bound=np.generic)


class Column(Generic[Scalar]):
    """An array of rows that grows; appending costs amortised constant time.

    Args:
        width: Length of a row; 0 for a column of single numbers.
        dtype: Type of the numbers.
    """

    __slots__ = ("_data", "_length", "width")

    def __init__(self, width: int, dtype: type[Scalar]) -> None:
        self._data: NDArray[Scalar] = np.empty((64, width) if width else (64,), dtype=dtype)
        self._length = 0
        self.width = width

    def __len__(self) -> int:
        return self._length

    def append(self, row: Any) -> None:
        """Add one row."""
        n = self._length
        if n == len(self._data):
            self._grow(n + 1)
        self._data[n] = row
        self._length = n + 1

    def extend(self, rows: NDArray[Any]) -> None:
        """Add rows, shape ``(n, width)``."""
        n = self._length + len(rows)
        if n > len(self._data):
            self._grow(n)
        self._data[self._length : n] = rows
        self._length = n

    def _grow(self, needed: int) -> None:
        capacity = max(2 * len(self._data), needed)
        data = np.empty((capacity, *self._data.shape[1:]), dtype=self._data.dtype)
        data[: self._length] = self._data[: self._length]
        self._data = data

    @property
    def rows(self) -> NDArray[Scalar]:
        """The rows so far, as a view."""
        return self._data[: self._length]
