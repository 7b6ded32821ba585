"""What a local search knows around a goal: remembered trials, and those of its episode."""

from __future__ import annotations

import numpy as np

from sgim.memory.memory import IntArray, KindMemory
from sgim.spaces import FloatArray


class NearTrials:
    """What an episode's search knows: trials near the goal, the episode's own among them.

    Args:
        memory: The trials that produced the goal's kind.
        goal: The goal's key.
        rows: Remembered trials, nearest first, shape ``(room,)``.
        costs: How far what they produced is from the goal, shape ``(room,)``.
        count: How many of the places are taken.

    Attributes:
        own: Place → policy in the unit box and key, of the episode's own trials.
        best: Place of the best one; −1 if there is none.
        cost: What it costs.
        proposed: The policy proposed last, in the unit box.
        told: What came of those proposed since: policy, key and cost of each.
    """

    __slots__ = (
        "best",
        "cost",
        "costs",
        "count",
        "goal",
        "memory",
        "own",
        "proposed",
        "rows",
        "told",
    )

    def __init__(
        self,
        memory: KindMemory,
        goal: FloatArray,
        rows: IntArray,
        costs: FloatArray,
        count: int,
    ) -> None:
        self.memory = memory
        self.goal = goal
        self.rows = rows
        self.costs = costs
        self.count = count
        self.best = 0 if count else -1
        self.cost = float(costs[0]) if count else 1.0
        self.own: dict[int, tuple[FloatArray, FloatArray]] = {}
        self.proposed = goal[:0]
        self.told: list[tuple[FloatArray, FloatArray, float]] = []

    def aim(self, goal: FloatArray) -> None:
        """Measure what is known against another goal, or the same in another context."""
        self.goal = goal
        if not self.count:
            return
        keys = self.memory.keys.rows.take(self.rows[: self.count], axis=0)
        for at, (_, key) in self.own.items():
            keys[at] = key
        offsets = keys - goal
        self.costs[: self.count] = np.sqrt(np.einsum("ij,ij->i", offsets, offsets))
        self.best = int(self.costs[: self.count].argmin())
        self.cost = float(self.costs[self.best])

    def take_in(self) -> None:
        """Add the trials that were told since the last proposal."""
        for policy, key, cost in self.told:
            n = self.count
            if n == len(self.rows):  # the farthest from the goal makes room
                n = int(self.costs.argmax())
            else:
                self.count = n + 1
            self.own[n] = policy, key
            self.costs[n] = cost
            if self.best < 0 or cost < self.cost:
                self.best, self.cost = n, cost
        self.told.clear()
