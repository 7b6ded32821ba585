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

import numpy as np
from numpy.typing import ArrayLike

from sgim.memory.trees import Answer, FloatArray, IndexArray, Tree, in_lines

Neighbours = tuple[FloatArray, IndexArray]

_LARGEST = 1e150  # Of a coordinate's magnitude: squares of differences must not overflow.
_FEW = 64  # Coordinates for which plain numbers are faster than arrays.
_MANY = 6  # Points asked for at once, from which on they are better looked for together.
_FEW_NEWEST, _MANY_NEWEST = 256, 2048  # Points that many askers together look at one by one.
_BLOCK = 1 << 15  # Distances computed at once, so that they stay in a cache.
_MERGE_RATIO = 6  # Raising it leaves fewer trees to ask, and merges more; 4 to 6 is best at 10^6.
# Trees round, and underflow, in their own way: asking for this much more loses no point.
_SLACK, _TINY = 1 + 1e-9, 1e-160


def _at_least_one(name: str, value: int) -> int:
    if operator.index(value) < 1:
        raise ValueError(f"{name} is {value}, expected at least 1")
    return operator.index(value)


def _squared_distances(columns: FloatArray, point: FloatArray) -> FloatArray:
    """Squared distances to ``point`` of the points in ``columns``, shape (d, ...).

    ``point`` has shape (d,), or one that spreads to that of ``columns``.

    The sum adds one coordinate at a time, in order, whatever the shape: a point's distance is
    the same to the last bit wherever the point is stored.
    """
    differences = columns - (point[:, None] if point.ndim == 1 else point)
    differences *= differences
    total: FloatArray = differences[0]
    for squares in differences[1:]:
        total += squares
    return total


def _squares_between(columns: FloatArray, points: FloatArray) -> FloatArray:
    """As `_squared_distances` of columns of shape (d, m or 1, n) to each of m points: (m, n)."""
    total: FloatArray = columns[0] - points[:, :1]
    total *= total
    for column, coordinates in zip(columns[1:], points.T[1:], strict=True):
        difference = column - coordinates[:, None]
        difference *= difference
        total += difference
    return total


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
        self._trees: list[Tree] = []  # Over consecutive ranges of indices.
        self._newest: Tree | None = None  # Over most of the newest, where many asked for one each.
        self._storage: FloatArray = np.zeros((64, dimension))
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
        if len(checked) < _MANY or not k:
            found = [self.query(point, k) for point in checked] if k else []
            shape = len(checked), k
            return (
                np.array([one for one, _ in found], dtype=np.float64).reshape(shape),
                np.array([one for _, one in found], dtype=np.intp).reshape(shape),
            )
        if k == 1:
            trees = self._more_trees()
        else:
            self._settle()
            trees = self._trees
        answers = [tree.nearest(checked, k) for tree in trees]
        distances, indices = self._together(checked, trees, answers, k)
        # A tree whose answer ends within reach may hide points as near as the k-th.
        reach = distances[:, -1] * _SLACK + _TINY
        for _, horizon in answers:
            for i in np.flatnonzero(horizon <= reach).tolist():
                distances[i], indices[i] = self.query(checked[i], k)
        return distances, indices

    def _together(
        self, points: FloatArray, trees: Sequence[Tree], answers: list[Answer], k: int
    ) -> Neighbours:
        """The k nearest to each of many points, among what trees propose and the newest."""
        parts = [tree.members(rows, k) for tree, (rows, _) in zip(trees, answers, strict=True)]
        parts = parts or [np.empty((len(points), 0), dtype=np.intp)]
        found = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        squares = self._squares(found, points)
        first = trees[-1].stop if trees else 0
        if first < self._count:
            bounds = np.full(len(points), math.inf)
            if squares.shape[1] >= k:
                bounds = np.partition(squares, k - 1, axis=1)[:, k - 1]
            near, apart = self._newest_within(points, bounds, first)
            found = np.concatenate((found, near), axis=1)
            squares = np.concatenate((squares, apart), axis=1)
        distances = np.sqrt(squares)
        order = distances.argsort(axis=1, kind="stable")  # fast, as trees answer in order
        lines = np.arange(len(points))[:, None] * distances.shape[1]
        sorted_ = distances.take(order[:, : k + 1] + lines)
        # Of equally distant ones the oldest; that there are any is rare.
        tied = np.flatnonzero((sorted_[:, 1:] == sorted_[:, :-1]).any(axis=1))
        if len(tied):
            order[tied] = np.lexsort((found[tied], distances[tied]), axis=1)
        return sorted_[:, :k], found.take(order[:, :k] + lines)

    def _squares(self, found: IndexArray, points: FloatArray) -> FloatArray:
        """Squared distances of found points, shape (m, w), to each of m; infinite for none."""
        columns = np.moveaxis(self._storage.take(found, axis=0), -1, 0)
        squares = _squares_between(columns, points)
        squares[found < 0] = math.inf
        return squares

    def _newest_within(
        self, points: FloatArray, bounds: FloatArray, first: int
    ) -> tuple[IndexArray, FloatArray]:
        """The newest within these squared distances of each: indices and squares, in lines.

        Only those from number ``first`` on are looked at.
        """
        newest = self._newest_from(first)[:, None]
        step = max(1, _BLOCK // max(1, newest.shape[2]))
        counts, places, apart = [], [], []
        for start in range(0, len(points), step):
            some = slice(start, start + step)
            squares = _squares_between(newest, points[some])
            near = squares <= bounds[some, None] * _SLACK
            counts.append(near.sum(axis=1))
            places.append(near.nonzero()[1])
            apart.append(squares[near])
        numbers = np.concatenate(counts)
        found = np.concatenate(places) + first
        return in_lines(found, numbers, -1), in_lines(np.concatenate(apart), numbers, math.inf)

    def gaps(self, points: ArrayLike) -> FloatArray:
        """How far each of m points, shape (m, d), is from the nearest: shape (m,).

        Faster than to find which one that is; infinite while there is none.
        """
        checked = self._check(points, 2)
        squares = np.full(len(checked), math.inf)
        trees = self._more_trees() if len(checked) >= _MANY else self._trees
        first = trees[-1].stop if trees else 0
        if first < self._count:
            newest = self._newest_from(first)
            if len(checked) < _MANY:
                squares[:] = [_squared_distances(newest, point).min() for point in checked]
            else:
                squares[:] = _squares_between(newest[:, None], checked).min(axis=1)
        for tree in trees:
            rows, _ = tree.nearest(checked, 1)  # the two nearest: trees round in their own way
            for candidates in tree.firsts(rows).T:
                apart = _squared_distances(self._storage.take(candidates, axis=0).T, checked.T)
                np.minimum(squares, apart, out=squares)
        gaps: FloatArray = np.sqrt(squares)
        return gaps

    def _newest_from(self, first: int) -> FloatArray:
        """The points from number ``first`` on, none of them in a tree: shape (d, n)."""
        return self._buffer[:, first - self._in_trees : self._count - self._in_trees]

    def _more_trees(self) -> list[Tree]:
        """Trees over all points but the very newest: one over most of the newest among them."""
        newest = self._newest
        if newest is None or newest.start < self._in_trees:
            newest = self._newest = None
        if self._count - (self._in_trees if newest is None else newest.stop) >= _FEW_NEWEST:
            points = self._storage[self._in_trees : self._count]
            newest = self._newest = Tree(points, self._in_trees)
        return self._trees if newest is None else [*self._trees, newest]

    def _settle(self) -> None:
        """Move the newest points into trees if many who ask would look at too many of them."""
        worth = min(max(_FEW_NEWEST, self._in_trees // 4), _MANY_NEWEST)
        if self._count - self._in_trees >= worth:
            self._merge()

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

    def _select(self, point: FloatArray, answers: list[Answer], k: int) -> Neighbours:
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
        self._trees.append(Tree(self._storage[start:stop], start))
        self._in_trees = stop

    def _reserve(self, count: int) -> None:
        while count > len(self._storage):
            self._storage = np.concatenate((self._storage, np.zeros_like(self._storage)))

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
