"""What a learned map says around some policies."""

from __future__ import annotations

import numpy as np

from sgim.memory.memory import IntArray, KindMemory
from sgim.policy.smoothness import Smoothness
from sgim.spaces import FloatArray

_SHARES = (0.25, 0.5, 1.0)  # Of a step, to choose among.


class Around:
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
        self.uncertainties = 1 / precisions[:, :, 0]
        self.left_out = self.weights / precisions
        missed = (self.left_out**2).sum(axis=(1, 2))
        foreseen = (smoothness.variance / precisions).sum(axis=(1, 2))
        # Where the model is surer than it should be, that is made up for.
        surprise = np.maximum(missed / foreseen, 1.0) * smoothness.modesty**2
        self.variances = surprise * smoothness.variance.sum()
        # How much of the differences between outcomes it does not foresee, over how much it does.
        differences = (centred**2).sum(axis=(1, 2))
        self.doubts = missed / np.maximum(differences - missed, 1e-300)

    def expected(self) -> tuple[FloatArray, FloatArray]:
        """The outcomes expected at the centres, and how uncertain they are.

        Returns:
            Outcomes, shape ``(m, d)``, and variances over that of the signal, shape ``(m,)``; noise
            is not in them.
        """
        squares = np.einsum("bij,bij->bi", self.points, self.points)
        covariances = self.smoothness.covariance(squares)
        outcomes = self.means + (covariances[:, None] @ self.weights)[:, 0]
        known = (covariances[:, None] @ self.inverses @ covariances[:, :, None])[:, 0, 0]
        return outcomes, np.maximum(self.smoothness.alone - known, 0.0)

    def may_produce(self, count: int) -> FloatArray:
        """Outcomes that the first centre may produce, each as likely as another: ``(count, d)``.

        They are as far from what is expected as each of the nearest trials is from what is expected
        of it when it is left out, made larger or smaller as the centre is less or more certain.
        """
        expected, uncertain = self.expected()
        near = np.einsum("ij,ij->i", self.points[0], self.points[0]).argsort(kind="stable")[:count]
        ratios = (uncertain[0] + self.smoothness.noise) / self.uncertainties[0, near]
        misses = self.left_out[0, near] * np.sqrt(ratios)[:, None] * self.smoothness.modesty
        outcomes: FloatArray = expected[0] + misses
        return outcomes

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
        slopes = self.smoothness.slopes(apart, weights, len(offset))
        way = self.smoothness.way(slopes, goal - expected)
        if way is None:
            return None
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


def taken(memory: KindMemory, rows: IntArray | slice) -> tuple[FloatArray, FloatArray]:
    """Outcomes of rows, and their policies followed by their contexts; all in the unit box."""
    dimension = memory.dimension or 0
    keys = memory.keys.rows[rows]
    policies = memory.encoded_policies(rows)
    if keys.shape[1] == dimension:
        return keys, policies
    return keys[:, :dimension], np.column_stack((policies, keys[:, dimension:]))
