"""Episodic memory: every trial, and the nearest ones to a goal or to a policy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.memory.columns import Column
from sgim.memory.neighbours import NearestNeighbours
from sgim.records import Trial
from sgim.spaces import BoolArray, Box, FloatArray, Space
from sgim.task import Task

IntArray = NDArray[np.int64]

_NINTH = 9
_AMID = 0.44  # (1 - 0.44)⁸ = 0.01: how seldom eight even places all lie in the rest of a ball.


class PointColumn:
    """The points of one space, in order: rows of numbers for a box, objects for other spaces."""

    __slots__ = ("_box", "_objects", "_scaled", "_vectors", "space")

    def __init__(self, space: Space) -> None:
        self.space = space
        self._box = space if isinstance(space, Box) else None
        self._vectors = Column(space.dimension or 0, np.float64) if self._box else None
        self._scaled: Column[np.float64] | None = None  # made when scaled points are asked for
        self._objects: list[Any] = []

    def append(self, point: Any) -> None:
        """Add a checked point."""
        (self._objects if self._vectors is None else self._vectors).append(point)

    def extend(self, points: Sequence[Any]) -> None:
        """Add checked points."""
        if self._vectors is None:
            self._objects.extend(points)
        else:
            self._vectors.extend(np.array(points))

    def __len__(self) -> int:
        return len(self._objects if self._vectors is None else self._vectors)

    def __getitem__(self, row: int) -> Any:
        if self._vectors is not None:
            return self._vectors.rows[row].copy()
        return self._objects[row]

    def points(self, rows: IntArray) -> list[Any]:
        """The points of several rows."""
        if self._vectors is not None:
            return list(self._vectors.rows[rows])
        return [self._objects[row] for row in rows.tolist()]

    def encoded(self, rows: IntArray | slice) -> FloatArray:
        """Points of these rows scaled to the unit box, shape ``(..., dimension)``."""
        if self._box is not None and self._vectors is not None:
            if self._scaled is None:
                self._scaled = Column(self._box.dimension, np.float64)
            if (known := len(self._scaled)) < len(self._vectors):
                self._scaled.extend(self._box.encode(self._vectors.rows[known:]))
            points = self._scaled.rows
            return points[rows].copy() if isinstance(rows, slice) else points.take(rows, axis=0)
        chosen = (
            self._objects[rows] if isinstance(rows, slice) else [self._objects[i] for i in rows]
        )
        return np.array([self.space.encode(p) for p in chosen]).reshape(
            len(chosen), self.space.dimension or 0
        )


class KindMemory:
    """The trials that produced one kind of outcome.

    Row ``i`` is the i-th such trial. The key of a row is its outcome scaled to the unit box,
    followed by its context scaled likewise: contexts and outcomes are scaled apart, and
    distances are Euclidean over both. Kinds whose space cannot encode its points have outcomes
    but no keys and no neighbours.

    Args:
        outcome_space: The kind's space.
        context_space: The task's context space, or None.
        policies: The memory's column of policies, for neighbours in policy space.

    Attributes:
        deterministic: Whether it is known that a policy always has the outcome that it had.
    """

    def __init__(
        self, outcome_space: Space, context_space: Space | None, policies: PointColumn
    ) -> None:
        self.space = outcome_space
        self.context_space = context_space
        self.policy_space = policies.space
        self.dimension = outcome_space.dimension
        self.outcomes = PointColumn(outcome_space)
        self.trials = Column(0, np.int64)
        context_dimension = (context_space.dimension or 0) if context_space else 0
        self.keys = Column((self.dimension or 0) + context_dimension, np.float64)
        self._index = NearestNeighbours(max(1, self.keys.width))
        self.deterministic = False
        self._policies = policies
        self._policy_index: NearestNeighbours | None = None

    def __len__(self) -> int:
        return len(self.trials)

    def append(self, trial: int, outcome: Any, context: Any) -> None:
        """Add the trial of this number, its outcome of this kind, and its key if it has one."""
        self.trials.append(trial)
        self.outcomes.append(outcome)
        if self.dimension is not None:
            self.keys.append(self.key(outcome, context))

    def extend(
        self, trials: Sequence[int], outcomes: Sequence[Any], contexts: Sequence[Any]
    ) -> None:
        """As `append` for several trials, one or more."""
        self.trials.extend(np.array(trials))
        self.outcomes.extend(outcomes)
        if self.dimension is not None:
            self.keys.extend(self.keys_of(outcomes, contexts))

    def key(self, point: Any, context: Any) -> FloatArray:
        """The key of an outcome or goal of this kind in this context."""
        vector = self.space.encode(point)
        if self.context_space is None:
            return vector
        return np.concatenate((vector, self.context_space.encode(context)))

    def keys_of(self, points: Sequence[Any], contexts: Sequence[Any]) -> FloatArray:
        """As `key` for several points, one or more, each in its context: ``(n, key dimension)``."""
        keys = _encoded(self.space, points)
        if self.context_space is None:
            return keys
        return np.concatenate((keys, _encoded(self.context_space, contexts)), axis=1)

    def nearest(self, key: FloatArray, k: int) -> tuple[FloatArray, IntArray]:
        """The k rows with the nearest keys.

        Returns:
            Distances and rows, nearest first, ties by age; both of length ``min(k, n)``.
        """
        self._index_new()
        return self._index.query(key, k)

    def nearest_batch(self, keys: FloatArray, k: int) -> tuple[FloatArray, IntArray]:
        """As `nearest` for keys of shape ``(m, d)``; both results have shape ``(m, min(k, n))``."""
        self._index_new()
        return self._index.query_batch(keys, k)

    def gaps(self, keys: FloatArray) -> FloatArray:
        """How far each of some keys, shape ``(m, d)``, is from the nearest row's; else infinite."""
        self._index_new()
        return self._index.gaps(keys)

    def surrounded(self, keys: FloatArray) -> BoolArray:
        """Which of some keys, shape ``(m, d)``, are among the rows and not beyond them.

        Amid rows the ball to the nearest one is small beside that to the ninth; from beyond them
        they are nearly as far. The border is at 0.44 of its volume: amid rows that lie evenly one
        place in a hundred is taken for one beyond, whatever the dimension. None are among fewer
        than nine rows, and few where rows repeat each other exactly.
        """
        if len(self) < _NINTH:
            return np.zeros(len(keys), dtype=np.bool_)
        distances, _ = self.nearest_batch(keys, _NINTH)
        inside: BoolArray = distances[:, 0] <= _AMID ** (1 / keys.shape[1]) * distances[:, -1]
        return inside

    def nearest_policies(self, policy: FloatArray, k: int) -> tuple[FloatArray, IntArray]:
        """The k rows whose policies, scaled to the unit box, are nearest to ``policy``."""
        index = self._policy_index
        if index is None:
            index = self._policy_index = NearestNeighbours(self._policies.space.dimension or 0)
        if len(index) < len(self):
            index.extend(self.encoded_policies(slice(len(index), len(self))))
        return index.query(policy, k)

    @property
    def ever_failed(self) -> bool:
        """Whether some trial did not produce this kind."""
        return len(self._policies) > len(self)

    def chance_of_failing(self, policies: FloatArray, k: int) -> FloatArray:
        """The chance that policies do not produce this kind, by what the most alike trials did.

        It is Laplace's rule of succession, (failures + 1)/(trials + 2): over the k most alike of
        all trials, or over all of them if none ever failed.

        Args:
            policies: Scaled to the unit box, shape ``(m, n)``.
            k: How many trials to look at.

        Returns:
            Chances, shape ``(m,)``.
        """
        everything = self._policies.encoded(slice(None))
        if len(everything) == len(self):
            return np.full(len(policies), 1 / (len(self) + 2))
        failed = np.ones(len(everything), dtype=bool)
        failed[self.trials.rows] = False
        norms, k = np.einsum("ij,ij->i", everything, everything), min(k, len(everything))
        failures = []
        for policy in policies:
            apart = norms - 2 * (everything @ policy)  # but for a constant
            failures.append(failed[np.argpartition(apart, k - 1)[:k]].sum())
        chances: FloatArray = (np.array(failures) + 1) / (k + 2)
        return chances

    def encoded_policies(self, rows: IntArray | slice) -> FloatArray:
        """The policies of these rows scaled to the unit box, shape ``(..., policy dimension)``."""
        trials = self.trials.rows
        return self._policies.encoded(
            trials[rows] if isinstance(rows, slice) else trials.take(rows)
        )

    def _index_new(self) -> None:
        known = len(self._index)
        if known < len(self.keys):
            self._index.extend(self.keys.rows[known:])


class Memory:
    """All trials of a learner, in the order they were told.

    Args:
        task: The task whose trials are remembered.
    """

    def __init__(self, task: Task) -> None:
        self.task = task
        self.policies = PointColumn(task.policy_space)
        self._contexts = PointColumn(task.context_space) if task.context_space else None
        self.kinds = {
            kind: KindMemory(space, task.context_space, self.policies)
            for kind, space in task.outcome_spaces.items()
        }
        self._length = 0

    def __len__(self) -> int:
        return self._length

    def declare_deterministic(self) -> None:
        """Know from now on that a policy always has the outcome that it had."""
        for memory in self.kinds.values():
            memory.deterministic = True

    def add(self, trial: Trial) -> int:
        """Remember a checked trial; returns its number."""
        number = self._length
        self.policies.append(trial.policy)
        if self._contexts is not None:
            self._contexts.append(trial.context)
        for kind, point in trial.outcome.items():
            self.kinds[kind].append(number, point, trial.context)
        self._length = number + 1
        return number

    def extend(self, trials: Sequence[Trial]) -> dict[str, list[int]]:
        """As `add` for several checked trials.

        Returns:
            Kind → which of the trials produced it, in order: they have the last rows of that
            kind's memory.
        """
        first = self._length
        self.policies.extend([trial.policy for trial in trials])
        if self._contexts is not None:
            self._contexts.extend([trial.context for trial in trials])
        producing: dict[str, list[int]] = {}
        for i, trial in enumerate(trials):
            for kind in trial.outcome:
                producing.setdefault(kind, []).append(i)
        for kind, members in producing.items():
            self.kinds[kind].extend(
                [first + i for i in members],
                [trials[i].outcome[kind] for i in members],
                [trials[i].context for i in members],
            )
        self._length = first + len(trials)
        return producing

    def key(self, kind: str, point: Any, context: Any) -> FloatArray:
        """The key of an outcome or goal of this kind in this context (see `KindMemory`)."""
        return self.kinds[kind].key(point, context)

    def keys(self, kind: str, points: Sequence[Any], contexts: Sequence[Any]) -> FloatArray:
        """The keys of one or more outcomes or goals of a kind, shape ``(n, key dimension)``."""
        return self.kinds[kind].keys_of(points, contexts)

    def trial(self, number: int) -> Trial:
        """The trial of this number, 0 ≤ number < len(self)."""
        outcome = {}
        for kind, memory in self.kinds.items():
            row = int(np.searchsorted(memory.trials.rows, number))
            if row < len(memory) and memory.trials.rows[row] == number:
                outcome[kind] = memory.outcomes[row]
        context = None if self._contexts is None else self._contexts[number]
        return Trial(self.policies[number], outcome, context)


def _encoded(space: Space, points: Sequence[Any]) -> FloatArray:
    if isinstance(space, Box):  # encodes arrays of points at once
        return space.encode(np.array(points))
    return np.array([space.encode(point) for point in points])
