"""Exact nearest neighbours among points that are only ever added.

The newest points are searched by brute force; the older ones lie in a few k-d trees of falling
size, merged as a counter carries: the logarithmic method of J. L. Bentley and J. B. Saxe,
"Decomposable searching problems I: static-to-dynamic transformation", Journal of Algorithms
1(4), 1980. Trees only propose candidates: every distance is computed again by one function and
candidates are ranked by (distance, index), so answers do not depend on the layout.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]
Neighbours = tuple[FloatArray, IndexArray]
_Answer = tuple[IndexArray, Any]  # What one tree proposes: rows, and where it stopped.

_LARGEST = 1e150  # Of a coordinate's magnitude: squares of differences must not overflow.
_FEW = 64  # Coordinates for which plain numbers are faster than arrays.
_WORTH_A_TREE = 64  # Points asked for at once, for which a tree over the newest pays.
_MERGE_RATIO = 6  # Raising it leaves fewer trees to ask, and merges more; 4 to 6 is best at 10^6.
# Trees round, and underflow, in their own way: asking for this much more loses no point.
_SLACK, _TINY = 1 + 1e-9, 1e-160


def _at_least_one(name: str, value: int) -> int:
    if operator.index(value) < 1:
        raise ValueError(f"{name} is {value}, expected at least 1")
    return operator.index(value)


def _squared_distances(columns: FloatArray, point: FloatArray) -> FloatArray:
    """Squared distances to ``point`` of the points in ``columns``, shape (d, n).

    ``point`` may also have a column for each of them.

    The sum adds one coordinate at a time, in order, whatever n is: a point's distance is the
    same to the last bit wherever the point is stored.
    """
    differences = columns - (point[:, None] if point.ndim == 1 else point)
    differences *= differences
    total: FloatArray = differences[0]
    for squares in differences[1:]:
        total += squares
    return total


def _rowwise_distances(points: FloatArray, others: FloatArray) -> FloatArray:
    """Distance of each row to the row of ``others``, to the last bit as by the function above."""
    total = np.zeros(len(points))
    for column in range(points.shape[1]):
        difference = points[:, column] - others[:, column]
        total += difference * difference
    distances: FloatArray = np.sqrt(total)
    return distances


def _bound_on_smallest(values: FloatArray, k: int) -> float:
    """An upper bound, nearly tight, on the k-th smallest value; infinity if there is none."""
    if not 0 < k <= len(values):
        return math.inf
    # If k groups have a minimum <= b, k values are <= b; minima cost less than selection.
    if (group := len(values) // (8 * k)) > 1:
        groups = values[: len(values) // group * group].reshape(group, -1)
        values = np.minimum.reduce(groups, axis=0)
    else:
        values = values.copy()
    values.partition(k - 1)
    return float(values[k - 1])


def _sorted(squares: FloatArray, indices: IndexArray, k: int) -> Neighbours:
    """The k nearest, given squared distances of points whose indices ascend."""
    distances = np.sqrt(squares)  # Unequal squares can have equal roots.
    order = distances.argsort(kind="stable")[:k]  # Stable: of equally distant ones the oldest.
    return distances[order], indices[order]


def _group_equal(points: FloatArray) -> tuple[IndexArray, IndexArray]:
    """An order of the rows that puts equal ones together, ascending, and each group's start."""
    # Sorting hashes is faster than sorting rows; a collision may split a group, costing time.
    hashes = np.zeros(len(points), dtype=np.uint64)
    for column in (points + 0.0).view(np.uint64).T:  # Adding makes -0.0 hash as its equal 0.0.
        hashes = (hashes ^ (hashes >> np.uint64(32)) ^ column) * np.uint64(0x9E3779B97F4A7C15)
    order = hashes.argsort(kind="stable")
    rows = points[order]
    return order, np.flatnonzero(np.append(True, (rows[1:] != rows[:-1]).any(axis=1)))


class _Tree:
    """A k-d tree of the distinct among consecutive points: equal ones need no looking at."""

    def __init__(self, points: FloatArray, start: int) -> None:
        self.start, self.size = start, len(points)
        order, self._starts = _group_equal(points)
        self.distinct = len(self._starts)
        if self.distinct < self.size:
            self._members = order + start
            self._sizes = np.diff(self._starts, append=self.size)
            points = points[order[self._starts]]
        # Midpoint splits build about 1.6 times as fast as medians and answer no slower.
        self._tree: Any = cKDTree(points, leafsize=16, balanced_tree=False)

    def nearest(self, points: FloatArray, k: int) -> _Answer:
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


class NearestNeighbours:
    """Exact Euclidean nearest neighbours over points numbered 0, 1, 2 in order of insertion.

    Queries return two arrays: distances, in the unit of the coordinates, and indices. Both are
    sorted by (distance, index): of equally distant points the one added first comes first.

    Args:
        dimension: Number of coordinates d of a point, at least 1.
        buffer_size: How many of the newest points to search by brute force before they go
            into a tree, at least 1. It changes the speed and never an answer.

    Raises:
        ValueError: If an argument is below 1. By the methods: if points have the wrong shape or
            a coordinate that is not finite or exceeds 1e150 in magnitude, if k is below 1, or
            if a radius is negative or NaN.
    """

    def __init__(self, dimension: int, *, buffer_size: int | None = None) -> None:
        self.dimension = _at_least_one("dimension", dimension)
        if buffer_size is None:  # About where brute force costs as much as one more tree.
            buffer_size = max(1024, 16384 // dimension)
        self._count = self._in_trees = 0
        self._trees: list[_Tree] = []  # Over consecutive ranges of indices.
        self._storage: FloatArray = np.empty((64, dimension))
        # The newest points again, a row per coordinate: contiguous for brute force.
        self._buffer: FloatArray = np.empty((dimension, _at_least_one("buffer_size", buffer_size)))

    def __len__(self) -> int:
        return self._count

    @property
    def points(self) -> FloatArray:
        """All points, shape (n, d), in order of insertion; a read-only view."""
        view = self._storage[: self._count]
        view.flags.writeable = False
        return view

    def add(self, point: ArrayLike) -> None:
        """Add one point, shape (d,)."""
        checked = self._check(point, 1)
        self._reserve(self._count + 1)
        self._storage[self._count] = checked
        self._buffer[:, self._count - self._in_trees] = checked
        self._count += 1
        if self._count - self._in_trees == self._buffer.shape[1]:
            self._merge()

    def extend(self, points: ArrayLike) -> None:
        """Add points, shape (n, d): all or, on an error, none. Answers are as after `add`."""
        checked = self._check(points, 2)
        start, count = self._count, self._count + len(checked)
        self._reserve(count)
        self._storage[start:count] = checked
        self._count = count
        if count - self._in_trees >= self._buffer.shape[1]:
            self._merge()
        else:
            self._buffer[:, start - self._in_trees : count - self._in_trees] = checked.T

    def query(self, point: ArrayLike, k: int) -> Neighbours:
        """Find the k nearest to a point, shape (d,): two arrays of shape (min(k, n),)."""
        checked, k = self._check(point, 1), min(_at_least_one("k", k), self._count)
        return self._select(checked, [tree.nearest(checked, k) for tree in self._trees], k)

    def query_batch(self, points: ArrayLike, k: int) -> Neighbours:
        """Find the k nearest to each of m points, shape (m, d): arrays of shape (m, min(k, n)).

        Row i is to the last bit what `query` returns for ``points[i]``.
        """
        checked, k = self._check(points, 2), min(_at_least_one("k", k), self._count)
        distances = np.empty((len(checked), k))
        indices = np.empty((len(checked), k), dtype=np.intp)
        answers = [tree.nearest(checked, k) for tree in self._trees]
        left: Sequence[int] = range(len(checked))
        if k == 1 and len(checked) >= _WORTH_A_TREE:
            left = self._nearest_together(checked, answers, distances, indices)
        for i in left:
            answer = [(rows[i], horizon[i]) for rows, horizon in answers]
            distances[i], indices[i] = self._select(checked[i], answer, k)
        return distances, indices

    def _nearest_together(
        self,
        points: FloatArray,
        answers: list[_Answer],
        distances: FloatArray,
        indices: IndexArray,
    ) -> Sequence[int]:
        """Fill in the one nearest to each of many points; return the rows left, for ties."""
        trees, answers = [*self._trees], [*answers]
        if self._count > self._in_trees:
            newest = _Tree(self._storage[self._in_trees : self._count], self._in_trees)
            trees.append(newest)
            answers.append(newest.nearest(points, 1))
        parts = [tree.firsts(rows[:, 0]) for tree, (rows, _) in zip(trees, answers, strict=True)]
        found = np.array(parts)
        apart = np.array([_rowwise_distances(self._storage[part], points) for part in parts])
        order = np.lexsort((found, apart), axis=0)[0]
        every = np.arange(len(points))
        distances[:, 0], indices[:, 0] = apart[order, every], found[order, every]
        reach = distances[:, 0] * _SLACK + _TINY
        doubtful = np.any([horizon <= reach for _, horizon in answers], axis=0)
        return [int(i) for i in np.flatnonzero(doubtful)]

    def gaps(self, points: ArrayLike) -> FloatArray:
        """How far each of m points, shape (m, d), is from the nearest: shape (m,).

        Faster than to find which one that is; infinite while there is none.
        """
        checked = self._check(points, 2)
        newest = self._buffer[:, : self._count - self._in_trees]
        squares = np.full(len(checked), math.inf)
        if newest.shape[1]:
            squares[:] = [_squared_distances(newest, point).min() for point in checked]
        for tree in self._trees:
            rows, _ = tree.nearest(checked, 1)  # the two nearest: trees round in their own way
            for candidates in tree.firsts(rows).T:
                apart = _squared_distances(self._storage.take(candidates, axis=0).T, checked.T)
                np.minimum(squares, apart, out=squares)
        gaps: FloatArray = np.sqrt(squares)
        return gaps

    def within(self, point: ArrayLike, radius: float) -> Neighbours:
        """Find all at most ``radius`` from a point, shape (d,): distances and indices, sorted."""
        checked, radius = self._check(point, 1), float(radius)
        if not radius >= 0:
            raise ValueError(f"radius is {radius}, expected at least 0")
        reach = radius * _SLACK + _TINY
        parts = [tree.within(checked, reach, self._count) for tree in self._trees]
        distances, indices = self._rank(checked, parts, self._count, reach)
        found = distances.searchsorted(radius, side="right")
        return distances[:found], indices[:found]

    def _select(self, point: FloatArray, answers: list[_Answer], k: int) -> Neighbours:
        """The k nearest, given what each tree answered."""
        if not answers:
            return self._rank(point, [], k, math.inf)
        parts = [self._trees[i].indices(rows, k) for i, (rows, _) in enumerate(answers)]
        nearest = self._rank(point, parts, k, math.inf)
        # A tree whose answer ends within reach may hide points as near as the k-th.
        reach = float(nearest[0][-1]) * _SLACK + _TINY
        cut = [i for i, (_, horizon) in enumerate(answers) if horizon <= reach]
        for i in cut:
            parts[i] = self._trees[i].within(point, reach, k)
        return self._rank(point, parts, k, reach) if cut else nearest

    def _rank(self, point: FloatArray, parts: list[IndexArray], k: int, reach: float) -> Neighbours:
        """The k nearest, or those within ``reach`` if fewer, of the newest and of ``parts``."""
        newest = self._count - self._in_trees
        squares = _squared_distances(self._buffer[:, :newest], point)
        if not parts:
            limit = reach * reach if reach < math.inf else _bound_on_smallest(squares, k)
            near = (squares <= limit * _SLACK).nonzero()[0]
            return _sorted(squares[near], near + self._in_trees, k)
        older = np.concatenate(parts)
        older.sort()
        apart = _squared_distances(self._storage.take(older, axis=0).T, point)
        if reach < math.inf:
            limit = reach * reach
        else:  # The few from trees bound the k-th nearest well, unless they are fewer than k.
            few = apart if len(apart) >= k else np.concatenate((apart, squares))
            limit = _bound_on_smallest(few, k)
        near, kept = (squares <= limit * _SLACK).nonzero()[0], apart <= limit * _SLACK
        squares = np.concatenate((apart[kept], squares[near]))
        return _sorted(squares, np.concatenate((older[kept], near + self._in_trees)), k)

    def _merge(self) -> None:
        """Move the newest points into a tree, with the trees too small to stay beside it."""
        start, stop = self._in_trees, self._count
        while self._trees and self._trees[-1].size < _MERGE_RATIO * (stop - start):
            start = self._trees.pop().start
        self._trees.append(_Tree(self._storage[start:stop], start))
        self._in_trees = stop

    def _reserve(self, count: int) -> None:
        while count > len(self._storage):
            self._storage = np.concatenate((self._storage, np.empty_like(self._storage)))

    def _check(self, points: ArrayLike, ndim: int) -> FloatArray:
        checked = np.asarray(points, dtype=np.float64)
        if checked.ndim != ndim or checked.shape[-1] != self.dimension:
            what = "point has" if ndim == 1 else "points have"
            expected = f"({self.dimension},)" if ndim == 1 else f"(n, {self.dimension})"
            raise ValueError(f"{what} shape {checked.shape}, expected {expected}")
        # A norm bounds every coordinate, and is NaN or infinite if one is.
        if checked.size > _FEW or not math.hypot(*checked.ravel().tolist()) <= _LARGEST:
            bad = checked[~(np.abs(checked) <= _LARGEST)]
            if bad.size:
                raise ValueError(f"coordinate is {bad[0]}, expected finite, at most {_LARGEST:g}")
        return checked
