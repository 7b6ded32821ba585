"""Ways of answering: which policy to give for a goal, of all that is remembered.

Where outcomes are noisy the nearest remembered outcome is a lucky one, and whoever remembers more
gets luckier. The ways differ in how much they trust it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np

from sgim.frozen import frozen
from sgim.memory.memory import IntArray, KindMemory
from sgim.spaces import FloatArray


@frozen
class Answer:
    """What a way of answering chose for a goal.

    Attributes:
        row: The remembered trial that it repeats, or starts from; a row of the kind's memory.
        policy: The policy in the unit box, shape ``(n,)``; None to repeat the remembered one.
        expected: The outcome it should produce, in the unit box, shape ``(d,)``; None for the
            outcome that was remembered.
        spread: Standard deviation of the outcome about ``expected``, in the unit box, shape
            ``(d,)``; None if this way does not tell.
    """

    row: int
    policy: FloatArray | None = None
    expected: FloatArray | None = None
    spread: FloatArray | None = None


class Answering(Protocol):
    """Chooses the policies to answer goals with.

    What is answered depends on what is remembered and on the goal alone, to the last bit: not on
    what was asked before, nor on what is asked for at the same time.
    """

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """One answer for each goal.

        Args:
            memory: What is remembered of the goals' kind, one trial or more.
            keys: The goals, each with its context (see `KindMemory`), shape ``(m, width)``.
        """
        ...


class Nearest:
    """The remembered policy whose outcome is nearest to the goal (thesis eq. 3.3).

    In a deterministic world what was remembered will come again, and nothing that was tried comes
    nearer.
    """

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """The nearest row for each goal, the oldest of equals."""
        _, rows = memory.nearest_batch(keys, 1)
        return [Answer(int(row)) for row in rows[:, 0]]


Costs = Callable[[FloatArray, FloatArray, IntArray], Sequence[float]]
"""What each of some remembered trials costs, given a goal's key, their distances and rows."""


def _least_costly(
    memory: KindMemory, keys: FloatArray, near_outcomes: int, costs: Costs
) -> list[Answer]:
    """Of the rows with outcomes nearest to each goal, the one that costs least, near ones first.

    Where policies cannot be compared, the nearest.
    """
    if memory.policy_space.dimension is None:
        return Nearest().answers(memory, keys)
    answers = []
    for key in keys:
        distances, rows = memory.nearest(key, near_outcomes)
        answers.append(Answer(int(rows[int(np.argmin(costs(key, distances, rows)))])))
    return answers


class Reliable:
    """The remembered policy that is most reliable (thesis section 3.2.4.1, algorithm 3.2.5).

    Of the remembered trials whose outcomes are nearest to the goal, the one with the least
    distance + α · variance, the variance being that of the outcomes of like policies.

    Args:
        near_outcomes: How many of the nearest outcomes to consider (h_max of eq. 3.9).
        outcome_radius: Farthest of them from the goal, in the unit box (distM).
        policy_radius: Farthest of like policies, in the unit box (distN).
        variance_weight: The α.
    """

    def __init__(
        self,
        near_outcomes: int = 10,
        *,
        outcome_radius: float = 0.3,
        policy_radius: float = 0.5,
        variance_weight: float = 0.5,
    ) -> None:
        self.near_outcomes = near_outcomes
        self.outcome_radius = outcome_radius
        self.policy_radius = policy_radius
        self.variance_weight = variance_weight

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """The most reliable row for each goal; the nearest where policies are opaque."""

        def costs(key: FloatArray, distances: FloatArray, rows: IntArray) -> list[float]:
            near = max(1, int((distances < self.outcome_radius).sum()))
            radius, weight = self.policy_radius, self.variance_weight
            found = localities(memory, distances[:near], rows[:near], radius, weight)
            return [cost for cost, _ in found]

        return _least_costly(memory, keys, self.near_outcomes, costs)


def localities(
    memory: KindMemory,
    distances: FloatArray,
    rows: IntArray,
    policy_radius: float,
    variance_weight: float,
) -> list[tuple[float, IntArray]]:
    """The reliability of some remembered trials, the less the better, and the trials around each.

    Args:
        memory: What is remembered of a kind.
        distances: How far the trials' outcomes are from the goal, shape ``(h,)``.
        rows: Their rows, shape ``(h,)``.
        policy_radius: Farthest of like policies, in the unit box.
        variance_weight: The α in distance + α · variance.

    Returns:
        For each of the trials, its reliability and the rows of at most n + 1 with like policies,
        itself among them.
    """
    found = []
    centres = memory.encoded_policies(rows)
    for distance, centre in zip(distances, centres, strict=True):
        apart, around = memory.nearest_policies(centre, len(centre) + 1)
        around = around[apart < policy_radius]
        scatter = float(memory.keys.rows[around].var(axis=0).sum())
        found.append((float(distance) + variance_weight * scatter, around))
    return found


class KernelMean:
    """The remembered policy whose like policies came nearest to the goal, in the mean.

    Of the remembered trials whose outcomes are nearest to the goal, the one for which the mean
    squared distance from the goal is least: the mean over the trials with the nearest policies,
    weighted by a Gaussian kernel as wide as half of them reach (Nadaraya 1964, Watson 1964). So
    both a mean that is off and a scatter about it count.

    Args:
        near_outcomes: How many of the nearest outcomes to consider.
        near_policies: Over how many of the nearest policies to take the mean.
        own: How much the distance of the trial's own outcome counts beside the root of that mean.
    """

    def __init__(
        self, near_outcomes: int = 10, near_policies: int = 10, *, own: float = 0.0
    ) -> None:
        self.near_outcomes = near_outcomes
        self.near_policies = near_policies
        self.own = own

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """The row with the best of neighbourhoods; the nearest where policies are opaque."""

        def costs(key: FloatArray, distances: FloatArray, rows: IntArray) -> list[float]:
            squares = [
                self._mean_square(memory, key, centre) for centre in memory.encoded_policies(rows)
            ]
            return squares if not self.own else list(np.sqrt(squares) + self.own * distances)

        return _least_costly(memory, keys, self.near_outcomes, costs)

    def _mean_square(self, memory: KindMemory, key: FloatArray, centre: FloatArray) -> float:
        apart, around = memory.nearest_policies(centre, self.near_policies)
        width = max(float(apart[len(apart) // 2]), 1e-100)
        weights = np.exp(-0.5 * (apart / width) ** 2)
        squares = ((memory.keys.rows[around] - key) ** 2).sum(axis=1)
        return float(weights @ squares / weights.sum())
