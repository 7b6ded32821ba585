"""How smooth a map from policies to outcomes is, how noisy, and what it may be used for.

The model is a Gaussian process (C. E. Rasmussen and C. K. I. Williams, "Gaussian Processes for
Machine Learning", MIT Press, 2006) with a squared-exponential covariance, a constant mean in each
neighbourhood, and noise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from sgim.spaces import FloatArray

ENOUGH = 256
"""Trials to know noise by: with fewer, a few jumps of outcomes may look like it."""

_EVEN = 0.6  # Where noise is less even than this, the model takes a few jumps for much noise.
_DECISIVE = 1.0  # Of a difference of logarithms of likelihoods.
_MAPPED = (0.8, 0.6)  # Of the differences that a map in use explains, with fewer trials and enough.
_CLEAR = 0.01  # But noise of at most this share of the signal is not what jumps look like: then
_MAPPED_CLEARLY = 0.4  # less will do.
_DROWNED = 0.2  # Noise over the signal that hides the map.
LEAST_NOISE = 1e-8  # What rounding needs.
_MEAN = 10.0  # Variance of a neighbourhood's mean over that of the signal.


@dataclass(frozen=True)
class Smoothness:
    """The constants of a Gaussian process over policies.

    Attributes:
        metric: What policies are multiplied by before distances are taken, shape ``(n, n)``.
        length: Distance, by the metric, over which outcomes change.
        noise: Variance of the noise over that of the signal.
        variance: Variance of the signal for each coordinate, shape ``(d,)``.
        evidence: How much likelier, as a logarithm, noise is than none, in the median
            neighbourhood.
        explained: Share of the differences between a neighbourhood's outcomes that is foreseen
            when each is left out, noise not counted where it is known; the median neighbourhood's.
        even: How even the misses are when each is left out, over what the model makes of them: the
            median of their squares over the mean, 1 if they are normally distributed, little if a
            few are much larger than the others.
        trials: From how many trials it was learned.
        produced: Share of all policies tried by then that produced such an outcome: a map knows
            nothing of those that did not.
    """

    metric: FloatArray
    length: float
    noise: float
    variance: FloatArray
    evidence: float
    explained: float
    even: float
    trials: int
    produced: float = 1.0

    @property
    def enough(self) -> bool:
        """Whether it was learned from trials enough to know noise."""
        return self.trials >= ENOUGH

    @property
    def modesty(self) -> float:
        """How many times farther off than it seems what is expected may be.

        A metric has a direction for each coordinate of a policy, and few trials can be fitted by
        many.
        """
        return 1.0 + len(self.metric) / self.trials

    @property
    def noisy(self) -> bool:
        """Whether there is decidedly noise."""
        return self.enough and self.evidence > _DECISIVE

    @property
    def deviation(self) -> float:
        """Standard deviation of the noise: how far from what is expected outcomes lie by it."""
        return math.sqrt(self.noise * float(self.variance.sum()))

    @property
    def noiseless(self) -> bool:
        """Whether there is decidedly none."""
        return self.evidence < -_DECISIVE

    @property
    def mapped(self) -> bool:
        """Whether it foresees enough for its map to be used."""
        clear = self.produced == 1 and self.evidence > _DECISIVE and self.noise <= _CLEAR
        least = _MAPPED_CLEARLY if clear and not self.enough else _MAPPED[self.enough]
        return self.explained > least and not self.drowned

    @property
    def trusted(self) -> bool:
        """Whether its map can be used where there is noise: that must be as even as it takes it."""
        return self.mapped and not self.uneven

    @property
    def uneven(self) -> bool:
        """Whether it misses most trials by little and a few by much: noise here and not there.

        Where there decidedly is noise but little anywhere, as where it is in proportion to small
        outcomes, the map is as good as it need be. Else outcomes may jump.
        """
        little = self.noisy and self.noise <= _CLEAR
        return self.enough and self.even < _EVEN and not little

    @property
    def may_jump(self) -> bool:
        """Whether what looks like noise may be jumps: there is decidedly some, and not little."""
        return self.evidence > _DECISIVE and self.noise > _CLEAR

    @property
    def drowned(self) -> bool:
        """Whether there is so much noise that no map can show."""
        return self.noise > _DROWNED

    @property
    def guides(self) -> bool:
        """Whether its map can say what to try: what it misses must not look like jumps."""
        return not self.drowned and not self.may_jump and self.even >= _EVEN

    def correlation(self, squares: FloatArray) -> FloatArray:
        """Of the signal, over squared distances by the metric."""
        correlation: FloatArray = np.exp(squares * (-0.5 / self.length**2))
        return correlation

    def covariance(self, squares: FloatArray) -> FloatArray:
        """Of the signal and the mean, over the signal's variance."""
        return self.correlation(squares) + _MEAN

    @property
    def alone(self) -> float:
        """The covariance of a policy with itself."""
        return 1.0 + _MEAN

    def slopes(self, apart: FloatArray, weights: FloatArray, dimension: int) -> FloatArray:
        """How much outcomes change along each coordinate of a policy.

        Args:
            apart: Where trials lie from the policy, by the metric, shape ``(k, n)``.
            weights: Of the trials' covariances in what is expected, shape ``(k, d)``.
            dimension: Of policies; what follows in a row are contexts.

        Returns:
            Shape ``(dimension, d)``.
        """
        correlation = self.correlation(np.einsum("ij,ij->i", apart, apart))
        slopes = self.metric[:dimension] @ (apart.T @ (weights * correlation[:, None]))
        slopes /= self.length**2
        return slopes

    def way(self, slopes: FloatArray, lacking: FloatArray) -> FloatArray | None:
        """The least change of a policy, by the metric, that should change its outcome by as much.

        Args:
            slopes: As `slopes` gives them, shape ``(dimension, d)``.
            lacking: The change of the outcome, shape ``(d,)``.

        Returns:
            Shape ``(dimension,)``; None if nothing is known of the way.
        """
        metric = self.metric[: len(slopes)]
        least = np.linalg.solve(metric @ metric.T, slopes)
        gram = slopes.T @ least
        damping = 1e-6 * float(np.trace(gram))
        if not damping > 0:
            return None
        way: FloatArray = least @ np.linalg.solve(gram + damping * np.eye(len(gram)), lacking)
        return way

    def inverses(self, points: FloatArray) -> FloatArray:
        """Inverse covariances of outcomes at some points by the metric, shape ``(..., k, n)``."""
        covariances = self.covariance(squared_distances(points))
        diagonal = np.arange(points.shape[-2])
        covariances[..., diagonal, diagonal] += max(self.noise, LEAST_NOISE)
        return np.asarray(np.linalg.inv(covariances), dtype=np.float64)


def squared_distances(points: FloatArray) -> FloatArray:
    """Squared distances among points, shape ``(..., k, n)``, as ``(..., k, k)``."""
    products = points @ np.swapaxes(points, -1, -2)
    norms = np.diagonal(products, axis1=-2, axis2=-1)
    squares: FloatArray = norms[..., :, None] + norms[..., None, :] - 2 * products
    return np.maximum(squares, 0.0)
