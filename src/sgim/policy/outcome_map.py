"""A map from policies to outcomes over all trials, kept up to date trial by trial."""

from __future__ import annotations

import numpy as np

from sgim.policy.smoothness import Smoothness
from sgim.spaces import FloatArray

_SHARES = np.array([[0.25], [0.5], [1.0]])  # Of a step, to choose among.
_FARTHEST = 2.0  # Lengths of the map that a step has at most.
_LEAST_NOISE = 1e-4  # Over the signal: what rounding needs while the inverse grows.


class OutcomeMap:
    """The Gaussian process of a `Smoothness` over all trials of a kind, not only like ones.

    The inverse of the trials' covariance grows by a row and a column with each trial, which takes
    operations as the square of their number, and not as the cube. What is foretold depends on
    the trials and their order alone, to the last bit: not on when they were added.

    Args:
        smoothness: Of the map; learned from the first trials.
        inputs: Policies, followed by contexts, of those first trials; shape ``(t, n)``.
        outcomes: Their outcomes, shape ``(t, d)``.
        room: How many trials it can hold.
    """

    def __init__(
        self, smoothness: Smoothness, inputs: FloatArray, outcomes: FloatArray, room: int
    ) -> None:
        self.smoothness = smoothness
        self.count = n = len(inputs)
        self.mean: FloatArray = outcomes.mean(axis=0)
        self._alone = smoothness.alone + max(smoothness.noise, _LEAST_NOISE)
        self._points = np.zeros((room, inputs.shape[1]))
        self._outcomes = np.zeros((room, outcomes.shape[1]))
        self._weights = np.zeros((room, outcomes.shape[1]))
        self._inverse = np.zeros((room, room))
        self._points[:n] = inputs @ smoothness.metric
        self._outcomes[:n] = outcomes - self.mean
        covariances = self._covariances(self._points[:n])
        covariances[np.arange(n), np.arange(n)] = self._alone
        self._inverse[:n, :n] = np.linalg.inv(covariances)
        self._weights[:n] = self._inverse[:n, :n] @ self._outcomes[:n]

    def extend(self, inputs: FloatArray, outcomes: FloatArray) -> None:
        """Add trials, one after another: inputs of shape ``(m, n)``, outcomes ``(m, d)``."""
        for one, outcome in zip(inputs, outcomes - self.mean, strict=True):
            n, point = self.count, one @ self.smoothness.metric
            (covariances,) = self._covariances(point[None])
            inverse, weights = self._inverse[:n, :n], self._weights[:n]
            known = inverse @ covariances
            left = max(self._alone - float(covariances @ known), _LEAST_NOISE)
            missed = (outcome - covariances @ weights) / left
            inverse += np.outer(known, known / left)
            self._inverse[n, :n] = self._inverse[:n, n] = -known / left
            self._inverse[n, n] = 1 / left
            weights -= np.outer(known, missed)
            self._points[n], self._outcomes[n], self._weights[n] = point, outcome, missed
            self.count = n + 1

    def expected(self, inputs: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The outcomes expected of policies in contexts, and how uncertain they are.

        Args:
            inputs: Policies, followed by contexts, shape ``(m, n)``.

        Returns:
            Outcomes, shape ``(m, d)``, and variances over that of the signal, shape ``(m,)``; noise
            is not in them.
        """
        n = self.count
        covariances = self._covariances(inputs @ self.smoothness.metric)
        known = np.einsum("ij,ij->i", covariances @ self._inverse[:n, :n], covariances)
        outcomes = self.mean + covariances @ self._weights[:n]
        return outcomes, np.maximum(self.smoothness.alone - known, 0.0)

    def nearing(
        self, goal: FloatArray, context: FloatArray, policies: FloatArray, steps: int = 3
    ) -> tuple[FloatArray, FloatArray]:
        """The policy expected to come nearest to a goal, in the mean square.

        The best of some policies, and from there Gauss-Newton steps while they are expected to
        help. A step is trusted the less, the more of the differences between outcomes the map
        does not foresee when each trial is left out.

        Args:
            goal: The goal, shape ``(d,)``.
            context: The context, empty where there is none.
            policies: To start from, shape ``(m, dimension)``.
            steps: How many steps to take at most.

        Returns:
            The policy, within the unit box, and the outcome expected of it.
        """
        policy, outcome, miss = self._nearest(goal, context, policies, None)
        for _ in range(steps):
            way = self._way(policy, context, goal - outcome)
            if way is None:
                break
            tried = np.minimum(np.maximum(policy + _SHARES * way, 0.0), 1.0)
            further, there, left = self._nearest(goal, context, tried, outcome)
            if not left < miss:
                break
            policy, outcome, miss = further, there, left
        return policy, outcome

    def _nearest(
        self,
        goal: FloatArray,
        context: FloatArray,
        policies: FloatArray,
        origin: FloatArray | None,
    ) -> tuple[FloatArray, FloatArray, float]:
        """The best of policies, its outcome, and its expected squared distance from the goal."""
        outcomes, unknown = self.expected(with_context(policies, context))
        smoothness = self.smoothness
        variance = float(smoothness.variance.sum()) * smoothness.modesty**2
        misses = ((outcomes - goal) ** 2).sum(axis=1) + unknown * variance
        if origin is not None:
            misses += self._doubt() * ((outcomes - origin) ** 2).sum(axis=1)
        best = int(np.argmin(misses))
        return policies[best], outcomes[best], float(misses[best])

    def _way(
        self, policy: FloatArray, context: FloatArray, lacking: FloatArray
    ) -> FloatArray | None:
        """The least change of a policy, by the metric, that should make up for what is lacking."""
        smoothness, n = self.smoothness, self.count
        apart = self._points[:n] - np.append(policy, context) @ smoothness.metric
        slopes = smoothness.slopes(apart, self._weights[:n], len(policy))
        way = smoothness.way(slopes, lacking)
        if way is None:
            return None
        length = float(np.linalg.norm(way @ smoothness.metric[: len(policy)]))
        way *= min(1.0, _FARTHEST * smoothness.length / max(length, 1e-300))
        return way

    def _doubt(self) -> float:
        """How much of the differences between outcomes is not foreseen, over how much is."""
        n = self.count
        precisions = np.diagonal(self._inverse)[:n, None]
        missed = float(((self._weights[:n] / precisions) ** 2).sum())
        centred = self._outcomes[:n] - self._outcomes[:n].mean(axis=0)
        return missed / max(float((centred**2).sum()) - missed, 1e-300)

    def _covariances(self, points: FloatArray) -> FloatArray:
        """Covariances of points by the metric, shape ``(m, n)``, with the trials: ``(m, t)``."""
        known = self._points[: self.count]
        norms = np.einsum("ij,ij->i", known, known)
        squares = np.einsum("ij,ij->i", points, points)[:, None] + norms - 2 * points @ known.T
        return self.smoothness.covariance(np.maximum(squares, 0.0))


def with_context(policies: FloatArray, context: FloatArray) -> FloatArray:
    """Policies, shape ``(m, dimension)``, each followed by the same context."""
    if not len(context):
        return policies
    return np.column_stack((policies, np.broadcast_to(context, (len(policies), len(context)))))
