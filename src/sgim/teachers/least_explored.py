"""A teacher who watches the learner, and shows what it has explored least (section 3.3.3)."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.errors import TeacherError, unknown
from sgim.records import Demonstration, Goal, Outcome
from sgim.spaces import Box
from sgim.task import Task
from sgim.teachers.demonstration_set import DemonstrationSet

Tile = tuple[int, ...]


class LeastExplored:
    """Shows a demonstration from a tile of the outcome space that the learner has explored least.

    Of the tiles that have a demonstration, those are considered where the fewest of the outcomes
    observed so far lie; one of them is drawn, then one of its demonstrations. The goal of a
    request is not looked at.

    Args:
        demonstrations: One or more, with an outcome of this kind each.
        task: The task they are for.
        kind: The kind of outcome whose space is tiled, which must be a `Box`.
        tile: Length of a tile's sides, in the outcome's units.

    Raises:
        UnknownNameError: If the task has no such kind of outcome.
        TeacherError: If the space cannot be tiled so, or a demonstration is unusable or lacks an
            outcome of this kind.
    """

    def __init__(
        self, demonstrations: Sequence[Demonstration], task: Task, *, kind: str, tile: float
    ) -> None:
        if kind not in task.outcome_spaces:
            raise unknown("outcome kind", kind, task.outcome_spaces)
        if not isinstance(task.outcome_spaces[kind], Box) or not 0 < tile < math.inf:
            raise TeacherError(
                f"outcomes {kind!r} cannot be tiled by {tile!r}: expected a Box, and tiles of a "
                "positive length"
            )
        self.demonstrations = DemonstrationSet(demonstrations, task).demonstrations
        self._kind = kind
        self._tile = tile
        self._shown: dict[Tile, list[Demonstration]] = {}
        for number, demonstration in enumerate(self.demonstrations):
            if kind not in demonstration.outcome:
                raise TeacherError(f"demonstration {number} has no outcome {kind!r}")
            self._shown.setdefault(self._tile_of(demonstration.outcome[kind]), []).append(
                demonstration
            )
        self._explored: Counter[Tile] = Counter()

    def observe(self, outcome: Outcome) -> None:
        """Count an outcome of the learner in its tile."""
        if self._kind in outcome:
            self._explored[self._tile_of(outcome[self._kind])] += 1

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration:
        """A demonstration from one of the tiles explored least."""
        fewest = min(self._explored[tile] for tile in self._shown)
        least = [tile for tile in self._shown if self._explored[tile] == fewest]
        choice = self._shown[least[int(rng.integers(len(least)))]]
        return choice[int(rng.integers(len(choice)))]

    def _tile_of(self, point: Any) -> Tile:
        return tuple(np.floor(np.ravel(point) / self._tile).astype(np.int64).tolist())
