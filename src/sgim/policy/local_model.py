"""Answering by a local model of what policies do, where outcomes are noisy."""

from __future__ import annotations

import math

import numpy as np

from sgim.memory.memory import IntArray, KindMemory
from sgim.policy.answering import Answer, KernelMean, Nearest
from sgim.policy.smoothness import Smoothness, learned
from sgim.spaces import Box, FloatArray

_FIRST, _GROWTH = 16, 2  # The map is learned again whenever there are so many times more trials.
_SHARES = (0.25, 0.5, 1.0)  # Of a step, to choose among.


class LocalModel:
    """Smooths over like policies, and goes a step further where that is expected to help.

    Of the remembered trials whose outcomes are nearest to the goal, the one is taken whose policy
    is expected to come nearest, in the mean square. What to expect of a policy follows from the
    trials with the nearest *policies*, by a Gaussian process (see `Smoothness`): the outcomes of
    those trials were not selected for being near the goal, so that luck averages out. From there
    Gauss-Newton steps are taken towards the goal, no farther than those policies are, while they
    are expected to come nearer in the mean square. How far the model can be trusted is measured by
    leaving out each of those trials in turn.

    Where there is decidedly no noise, or policies or outcomes are not vectors, it answers as
    `Nearest` does; where there decidedly is and no map shows, as `KernelMean` does.

    Args:
        near_outcomes: How many of the nearest outcomes to choose among.
        near_policies: How many of the nearest policies to smooth over.
        among: Like policies are sought among so many of the nearest outcomes.
        steps: How many steps to take at most.
    """

    def __init__(
        self,
        near_outcomes: int = 8,
        near_policies: int = 80,
        *,
        among: int = 1000,
        steps: int = 3,
    ) -> None:
        self.near_outcomes = near_outcomes
        self.near_policies = near_policies
        self.among = among
        self.steps = steps
        self._learned: dict[KindMemory, tuple[int, Smoothness | None]] = {}

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """The policy expected to come nearest to each goal."""
        smoothness = self.smoothness(memory)
        if smoothness is not None and smoothness.mapped and not smoothness.noiseless:
            return [self._answer(memory, key, smoothness) for key in keys]
        noisy = smoothness is not None and smoothness.noisy
        return (KernelMean() if noisy else Nearest()).answers(memory, keys)

    def smoothness(self, memory: KindMemory) -> Smoothness | None:
        """What is known of the map from policies to outcomes; None if that is not enough.

        It is learned from the first trials, so many that the number depends on how many there are
        and not on when this was asked.
        """
        boxes = isinstance(memory.policy_space, Box) and isinstance(memory.space, Box)
        if len(memory) < _FIRST or not boxes:
            return None
        count = _FIRST * _GROWTH ** int(math.log(len(memory) / _FIRST, _GROWTH))
        known = self._learned.get(memory)
        if known is None or known[0] != count:
            outcomes, inputs = _taken(memory, slice(0, count))
            known = self._learned[memory] = count, learned(inputs, outcomes)
        return known[1]

    def _answer(self, memory: KindMemory, key: FloatArray, smoothness: Smoothness) -> Answer:
        _, rows = memory.nearest(key, self.among)
        outcomes, inputs = _taken(memory, rows)
        goal, context = key[: outcomes.shape[1]], key[outcomes.shape[1] :]
        dimension = inputs.shape[1] - len(context)
        centres = inputs[: self.near_outcomes].copy()
        centres[:, dimension:] = context
        around = _Around(inputs, outcomes, centres, smoothness, self.near_policies)
        best, expected, square = around.best(goal)
        start = centres[best, :dimension]
        policy, further = start, None
        for _ in range(self.steps):
            stepped = around.step(best, policy - start, goal, expected)
            if stepped is None or stepped[2] >= square:
                break
            further, expected, square = stepped
            policy = start + further
        return Answer(int(rows[best]), None if further is None else policy, expected)


class _Around:
    """What is expected near some policies, given the trials with the nearest policies to each.

    Args:
        inputs: Policies, followed by contexts, of trials; shape ``(t, n)``.
        outcomes: Their outcomes, shape ``(t, d)``.
        centres: Policies to look around, in the present context, shape ``(m, n)``.
        smoothness: Of the map from inputs to outcomes.
        near: How many of the trials to take for each.
    """

    def __init__(
        self,
        inputs: FloatArray,
        outcomes: FloatArray,
        centres: FloatArray,
        smoothness: Smoothness,
        near: int,
    ) -> None:
        self.centres, self.smoothness = centres, smoothness
        points, middles = inputs @ smoothness.metric, centres @ smoothness.metric
        norms = np.einsum("ij,ij->i", points, points)
        apart = norms - 2 * (middles @ points.T)  # but for a constant for each centre
        near = min(near, len(points))
        chosen = np.argpartition(apart, near - 1, axis=1)[:, :near]
        self.points = points[chosen] - middles[:, None]
        self.means = outcomes[chosen].mean(axis=1)
        centred = outcomes[chosen] - self.means[:, None]
        self.inverses = smoothness.inverses(self.points)
        self.weights = self.inverses @ centred
        precisions = np.diagonal(self.inverses, axis1=1, axis2=2)[:, :, None]
        missed = ((self.weights / precisions) ** 2).sum(axis=(1, 2))
        foreseen = (smoothness.variance / precisions).sum(axis=(1, 2))
        # Where the model is surer than it should be, that is made up for.
        self.variances = np.maximum(missed / foreseen, 1.0) * smoothness.variance.sum()
        # How much of the differences between outcomes it does not foresee, over how much it does.
        differences = (centred**2).sum(axis=(1, 2))
        self.doubts = missed / np.maximum(differences - missed, 1e-300)

    def best(self, goal: FloatArray) -> tuple[int, FloatArray, float]:
        """The centre expected to come nearest, its expected outcome and mean squared distance."""
        squares = np.einsum("bij,bij->bi", self.points, self.points)
        covariances = self.smoothness.covariance(squares)
        expected = self.means + (covariances[:, None] @ self.weights)[:, 0]
        known = (covariances[:, None] @ self.inverses @ covariances[:, :, None])[:, 0, 0]
        uncertain = np.maximum(self.smoothness.alone - known, 0.0) * self.variances
        misses = ((expected - goal) ** 2).sum(axis=1) + uncertain
        best = int(np.argmin(misses))
        return best, expected[best], float(misses[best])

    def step(
        self, centre: int, offset: FloatArray, goal: FloatArray, expected: FloatArray
    ) -> tuple[FloatArray, FloatArray, float] | None:
        """A Gauss-Newton step from where an outcome is expected, as far as that seems good.

        Args:
            centre: The centre's number.
            offset: Where to start from, from the centre; policies only.
            goal: The goal.
            expected: The outcome expected where it starts.

        Returns:
            The new offset, its expected outcome and the mean squared distance; None if nothing
            is known of the way.
        """
        points, weights = self.points[centre], self.weights[centre]
        metric = self.smoothness.metric[: len(offset)]
        here = offset @ metric
        apart = points - here
        correlation = self.smoothness.correlation(np.einsum("ij,ij->i", apart, apart))
        slopes = metric @ (apart.T @ (weights * correlation[:, None]))
        slopes /= self.smoothness.length**2
        # The least step by the metric.
        least = np.linalg.solve(metric @ metric.T, slopes)
        gram = slopes.T @ least
        damping = 1e-6 * float(np.trace(gram))
        if not damping > 0:
            return None
        way = least @ np.linalg.solve(gram + damping * np.eye(len(gram)), goal - expected)
        start = self.centres[centre, : len(offset)]
        reach = float(np.sqrt(np.einsum("ij,ij->i", points, points).max()))
        tried = []
        for share in _SHARES:
            further = np.clip(start + offset + share * way, 0.0, 1.0) - start
            further *= min(1.0, reach / max(float(np.linalg.norm(further @ metric)), 1e-300))
            apart = points - further @ metric
            covariance = self.smoothness.covariance(np.einsum("ij,ij->i", apart, apart))
            outcome = self.means[centre] + covariance @ weights
            unknown = self.smoothness.alone - covariance @ self.inverses[centre] @ covariance
            miss = float(((outcome - goal) ** 2).sum())
            miss += max(float(unknown), 0.0) * float(self.variances[centre])
            miss += float(self.doubts[centre]) * float(((outcome - expected) ** 2).sum())
            tried.append((miss, further, outcome))
        miss, further, outcome = min(tried, key=lambda found: found[0])
        return further, outcome, miss


def _taken(memory: KindMemory, rows: IntArray | slice) -> tuple[FloatArray, FloatArray]:
    """Outcomes of rows, and their policies followed by their contexts; all in the unit box."""
    dimension = memory.dimension or 0
    keys = memory.keys.rows[rows]
    policies = memory.encoded_policies(rows)
    if keys.shape[1] == dimension:
        return keys, policies
    return keys[:, :dimension], np.column_stack((policies, keys[:, dimension:]))
