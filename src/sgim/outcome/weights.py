"""Drawing from a table that changes a row at a time, without summing all of it each time."""

from __future__ import annotations

import numpy as np

from sgim.spaces import FloatArray

_BLOCK = 64


class BlockSums:
    """Sums and minima of a growing table's rows, block by block.

    A draw with probability proportional to value − minimum then looks at one number a block, and
    at one block.
    """

    def __init__(self) -> None:
        self._sums = np.zeros(0)
        self._minima = np.zeros(0)
        self._drawn_from: tuple[float, FloatArray, FloatArray] | None = None

    def refresh(self, table: FloatArray, row: int) -> None:
        """Take note that a row of the table, shape ``(rows, columns)``, is new or has changed."""
        block = row // _BLOCK
        if block == len(self._sums):
            self._sums = np.append(self._sums, 0.0)
            self._minima = np.append(self._minima, 0.0)
        values = table[block * _BLOCK : (block + 1) * _BLOCK]
        self._drawn_from = None
        self._sums[block] = values.sum()
        self._minima[block] = values.min()

    def draw(self, table: FloatArray, pick: float) -> tuple[int, int]:
        """Row and column of the value at the share ``pick``, in [0, 1), of all that is above least.

        All alike if no value is above the least.
        """
        rows, columns = table.shape
        if self._drawn_from is None:  # the same for all draws between two changes
            least = float(self._minima.min())
            counts = np.full(len(self._sums), float(_BLOCK * columns))
            counts[-1] = (rows - _BLOCK * (len(counts) - 1)) * columns
            weights = np.maximum(self._sums - least * counts, 0.0)
            self._drawn_from = least, weights, weights.cumsum()
        least, weights, cumulated = self._drawn_from
        wanted = pick * cumulated[-1]
        block = min(int(cumulated.searchsorted(wanted, "right")), len(weights) - 1)
        values = table[block * _BLOCK : (block + 1) * _BLOCK].ravel()
        inside = (values - least).cumsum()
        if inside[-1] > 0:
            wanted -= cumulated[block] - weights[block]
            place = min(int(inside.searchsorted(wanted, "right")), len(values) - 1)
            place += block * _BLOCK * columns
        else:
            place = min(int(pick * rows * columns), rows * columns - 1)
        return place // columns, place % columns
