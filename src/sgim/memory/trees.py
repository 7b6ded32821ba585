"""A k-d tree of consecutive points, which looks at equal ones once."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]
Answer = tuple[IndexArray, Any]
"""What one tree proposes: rows, and from what distance on there may be more."""


def _group_equal(points: FloatArray) -> tuple[IndexArray, IndexArray]:
    """An order of the rows that puts equal ones together, ascending, and each group's start."""
    # Sorting hashes is faster than sorting rows; a collision may split a group, costing time.
    hashes = np.zeros(len(points), dtype=np.uint64)
    for column in (points + 0.0).view(np.uint64).T:  # Adding makes -0.0 hash as its equal 0.0.
        hashes = (hashes ^ (hashes >> np.uint64(32)) ^ column) * np.uint64(0x9E3779B97F4A7C15)
    order = hashes.argsort(kind="stable")
    rows = points[order]
    return order, np.flatnonzero(np.append(True, (rows[1:] != rows[:-1]).any(axis=1)))


class Tree:
    """A k-d tree of the distinct among consecutive points: equal ones need no looking at."""

    def __init__(self, points: FloatArray, start: int) -> None:
        self.start, self.size = start, len(points)
        order, self._starts = _group_equal(points)
        self.distinct = len(self._starts)
        if self.distinct < self.size:
            self._members = order + start
            self._sizes = np.diff(self._starts, append=self.size)
            points = points[order[self._starts]]
        # Midpoint splits, of boxes that are not shrunk, build about 1.8 times as fast as medians
        # of shrunk ones and answer no slower.
        self._tree: Any = cKDTree(points, 16, compact_nodes=False, balanced_tree=False)

    @property
    def stop(self) -> int:
        """The number of the first point after those it has."""
        return self.start + self.size

    def nearest(self, points: FloatArray, k: int) -> Answer:
        """Rows of k + 1 nearest distinct points, and from what distance on there may be more."""
        distances, rows = self._tree.query(points, np.arange(1, min(k + 1, self.distinct) + 1))
        return rows, distances[..., -1] + (0 if k + 1 < self.distinct else math.inf)

    def within(self, point: FloatArray, radius: float, limit: int) -> IndexArray:
        """Indices of the points within ``radius``, the first ``limit`` of equal ones."""
        rows = self._tree.query_ball_point(point, radius)
        return self.indices(np.array(rows, dtype=np.intp), limit)

    def firsts(self, rows: IndexArray) -> IndexArray:
        """The first index among the equal points that each row stands for."""
        if self.distinct == self.size:
            return rows + self.start
        return self._members[self._starts[rows]]

    def indices(self, rows: IndexArray, limit: int) -> IndexArray:
        """Indices of the points that rows stand for, the first ``limit`` of equal ones."""
        if self.distinct == self.size:
            return rows + self.start
        starts, sizes = self._starts[rows], np.minimum(self._sizes[rows], limit)
        offsets = np.arange(sizes.sum())
        offsets += np.repeat(starts - sizes.cumsum() + sizes, sizes)
        return self._members[offsets]

    def members(self, rows: IndexArray, limit: int) -> IndexArray:
        """As `indices` for each line of rows, shape ``(m, r)``; −1 behind those of a line."""
        if self.distinct == self.size:
            return rows + self.start
        counts = np.minimum(self._sizes[rows], limit).sum(axis=1)
        return in_lines(self.indices(rows.ravel(), limit), counts, -1)


def in_lines(values: NDArray[Any], counts: NDArray[np.integer[Any]], fill: Any) -> NDArray[Any]:
    """Put so many of the values in each line of a matrix, and ``fill`` behind them."""
    lines = np.full((len(counts), int(counts.max(initial=0))), fill, dtype=values.dtype)
    lines[np.arange(lines.shape[1]) < counts[:, None]] = values
    return lines
