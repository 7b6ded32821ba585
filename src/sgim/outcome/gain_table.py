"""What is known of every region and mode, a row a region: what is lacking, and shares gained."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sgim.spaces import FloatArray


class GainTable:
    """Rows of numbers from which the gain expected in regions follows.

    The weights are worked out when they are asked for, for all rows that have changed since.

    Args:
        costs: Cost of each mode, by which gains are divided.
        dimension: Most coordinates of a goal.
        confidence: How many attempts a prior is worth, above 0.
        sharpness: How much a mode is preferred to others that gain less in the same region.

    Attributes:
        kind: Number of each region's kind of goal.
        low: Its lower corner in the coordinates of goals, the rest being 0.
        high: Its upper corner.
        lack: What is lacking there.
    """

    def __init__(
        self, costs: FloatArray, dimension: int, confidence: float, sharpness: float
    ) -> None:
        self.costs = costs
        self.confidence = confidence
        self.sharpness = sharpness
        self.kind: NDArray[np.int64] = np.zeros(64, dtype=np.int64)
        self.low = np.zeros((64, dimension))
        self.high = np.zeros((64, dimension))
        self.lack = np.ones(64)
        self._volume = np.ones(64)
        # Of the attempts that count, by mode: sum of the shares, how many, and what is expected
        # of a mode that was not tried here.
        self._sums = np.zeros((64, len(costs)))
        self._counts = np.zeros((64, len(costs)))
        self._priors = np.zeros((64, len(costs)))
        self._shares = np.zeros((64, len(costs)))
        self._weights = np.zeros((64, len(costs)))
        self._totals = np.zeros(64)
        self._changed: set[int] = set()

    def enter(self, row: int, kind: int, low: FloatArray, high: FloatArray) -> None:
        """Note which goals a region has; there is one row more than before, or as many."""
        if row == len(self.lack):
            for name, table in vars(self).items():
                if isinstance(table, np.ndarray) and name != "costs":
                    setattr(self, name, np.concatenate((table, np.zeros_like(table))))
        self.kind[row] = kind
        self.low[row, : len(low)] = low
        self.high[row, : len(high)] = high
        self._volume[row] = math.prod((high - low).tolist())

    def note(self, row: int, mode: int, shares: Sequence[float]) -> None:
        """Note the shares that a mode's attempts have gained in a region, those that count."""
        self._sums[row, mode] = sum(shares)
        self._counts[row, mode] = len(shares)
        self._changed.add(row)

    def expect(self, row: int, priors: FloatArray) -> None:
        """Note the share expected of each mode that was not tried in a region."""
        self._priors[row] = priors
        self._changed.add(row)

    def _settle(self) -> None:
        if not self._changed:
            return
        rows = sorted(self._changed)
        expected = self._sums[rows] + self.confidence * self._priors[rows]
        shares = expected / (self._counts[rows] + self.confidence)
        values = np.maximum(shares / self.costs, 0.0)
        best = np.maximum(values.max(axis=1), 1e-300)[:, None]
        weights = values * (values / best) ** (self.sharpness - 1)
        weights *= (self._volume[rows] * self.lack[rows])[:, None]
        self._shares[rows] = shares
        self._weights[rows] = weights
        self._totals[rows] = weights.sum(axis=1)
        self._changed.clear()

    @property
    def shares(self) -> FloatArray:
        """The share of what is lacking that a movement removes, by row and mode."""
        self._settle()
        return self._shares

    @property
    def weights(self) -> FloatArray:
        """How goals and modes are to be drawn: gain times volume, by row and mode."""
        self._settle()
        return self._weights

    @property
    def totals(self) -> FloatArray:
        """The sum of each row's weights."""
        self._settle()
        return self._totals
