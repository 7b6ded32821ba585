"""How smooth a map from policies to outcomes is, and how noisy: learned from what is remembered.

The model is a Gaussian process (C. E. Rasmussen and C. K. I. Williams, "Gaussian Processes for
Machine Learning", MIT Press, 2006) with a squared-exponential covariance, a constant mean in each
neighbourhood, and noise. Its constants make the outcomes of a few neighbourhoods likely, as if
those were independent (A. V. Vecchia, "Estimation and model identification for continuous spatial
processes", Journal of the Royal Statistical Society B 50(2), 1988).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sgim.spaces import FloatArray

ENOUGH = 256
"""Trials to know noise by: with fewer, a few jumps of outcomes may look like it."""

Neighbourhood = tuple[FloatArray, FloatArray]
"""Policies, shape ``(k, n)``, and outcomes, shape ``(k, d)``."""

_LENGTHS = 2.0 ** np.arange(-3.0, 4.0)  # Over the median distance between policies.
_NOISES = np.append(0.0, 10.0 ** np.arange(-8.0, 0.0, 0.5))  # Over the signal.
_EVEN = 0.6  # Where noise is less even than this, the model takes a few jumps for much noise.
_NORMAL = 0.4549  # Median of the squares of normally distributed numbers, over their mean.
_NONE, _SOME = 1e-5, 1e-3  # Up to the one there is no noise, from the other on there is some.
_ROUNDS = 2  # Of learning the metric.
_ALIKE = 0.5  # The share of the metric in which all directions count alike.
_DECISIVE = 1.0  # Of a difference of logarithms of likelihoods.
_MAPPED = (0.8, 0.6)  # Of the differences that a map in use explains, with fewer trials and enough.
_CLEAR = 0.01  # But noise of at most this share of the signal is not what jumps look like: then
_MAPPED_CLEARLY = 0.4  # less will do.
_DROWNED = 0.2  # Noise over the signal that hides the map.
_LEAST_NOISE = 1e-8  # What rounding needs.
_MEAN = 10.0  # Variance of a neighbourhood's mean over that of the signal.
_TINY = 1e-300


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
        """Whether it misses most trials by little and a few by much: noise here and not there."""
        return self.enough and self.even < _EVEN

    @property
    def drowned(self) -> bool:
        """Whether there is so much noise that no map can show."""
        return self.noise > _DROWNED

    @property
    def guides(self) -> bool:
        """Whether its map can say what to try: what it misses must not look like jumps."""
        jumps = self.even < _EVEN or (self.evidence > _DECISIVE and self.noise > _CLEAR)
        return not self.drowned and not jumps

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
        covariances[..., diagonal, diagonal] += max(self.noise, _LEAST_NOISE)
        return np.asarray(np.linalg.inv(covariances), dtype=np.float64)


def squared_distances(points: FloatArray) -> FloatArray:
    """Squared distances among points, shape ``(..., k, n)``, as ``(..., k, k)``."""
    products = points @ np.swapaxes(points, -1, -2)
    norms = np.diagonal(products, axis1=-2, axis2=-1)
    squares: FloatArray = norms[..., :, None] + norms[..., None, :] - 2 * products
    return np.maximum(squares, 0.0)


def learned(
    policies: FloatArray, outcomes: FloatArray, *, samples: int = 12, near: int = 48
) -> Smoothness | None:
    """Learn how smooth the map is that some trials show.

    In the end the metric counts a direction half for itself, half by how much outcomes change
    along it: the mean outer product of the map's gradients (A. Radhakrishnan et al., "Mechanism for
    feature learning in neural networks and backpropagation-free machine learning models", Science
    383, 2024). That is not done where there is decidedly no noise.

    Args:
        policies: In the unit box, shape ``(m, n)``; contexts may follow in the same rows.
        outcomes: In the unit box, shape ``(m, d)``.
        samples: How many neighbourhoods to look at, spread evenly over the trials.
        near: How many trials are in each.

    Returns:
        What was learned; None if there is nothing to learn it from.
    """
    metric = np.eye(policies.shape[1])
    explained = 1.0
    for turn in range(_ROUNDS + 1):
        found, fit = _fit(policies @ metric, outcomes, metric, samples, near)
        if fit is None or fit.noiseless:
            return fit
        if not fit.enough:  # A metric learned from few explains just those.
            explained = min(explained, fit.explained)
            fit = replace(fit, explained=explained)
        if turn < _ROUNDS:
            metric = _sharpened(found, fit)
    return fit


def _fit(
    points: FloatArray, outcomes: FloatArray, metric: FloatArray, samples: int, near: int
) -> tuple[list[Neighbourhood], Smoothness | None]:
    """Sample neighbourhoods by the metric, and fit constants to them."""
    found = []
    norms = np.einsum("ij,ij->i", points, points)
    near = min(near, len(points))
    for row in range(0, len(points), -(-len(points) // samples)):
        chosen = np.argpartition(norms - 2 * (points @ points[row]), near - 1)[:near]
        # The trial that was looked around comes first.
        chosen = np.append(row, chosen[chosen != row])[:near]
        if np.ptp(points[chosen], axis=0).any():
            found.append((points[chosen] - points[row], outcomes[chosen]))
    return found, _fitted(found, metric, len(points)) if found else None


def _fitted(found: Sequence[Neighbourhood], metric: FloatArray, trials: int) -> Smoothness:
    parts = [(squared_distances(p), y - y.mean(axis=0)) for p, y in found]
    typical = float(np.sqrt(np.median(np.concatenate([s[s > 0] for s, _ in parts]))))
    lengths = typical * _LENGTHS
    count = sum(len(y) - 1 for _, y in parts)
    coordinates = parts[0][1].shape[1]
    logs = np.zeros((len(lengths), len(_NOISES)))
    sums = np.zeros((*logs.shape, coordinates))
    alone = np.zeros((len(parts), *sums.shape))
    for i, length in enumerate(lengths):
        for part, (squares, y) in enumerate(parts):
            values, loads = _spectrum(np.exp(squares * (-0.5 / length**2)), y)
            log, total = _profile(values, loads)
            logs[i] += log
            sums[i] += total
            # Alone, noise is weighed against the differences within the neighbourhood.
            log, total = _profile(values / values.mean(), loads)
            free = len(values)
            alone[part, i] = -0.5 * (log[:, None] + free * np.log(total / free + _TINY))
    together = -0.5 * (coordinates * logs + count * np.log(sums / count + _TINY).sum(axis=2))
    best = np.unravel_index(int(np.argmax(together)), together.shape)
    # Each neighbourhood is heard alone, or the few that straddle a jump would decide for all.
    noises = alone.max(axis=1)
    with_noise = noises[:, _NOISES > 0.99 * _SOME].max(axis=1).sum(axis=1)
    without = noises[:, _NOISES < 1.01 * _NONE].max(axis=1).sum(axis=1)
    fit = Smoothness(
        metric,
        float(lengths[best[0]]),
        float(_NOISES[best[1]]),
        sums[best] / count,
        float(np.median(with_noise - without)),
        0.0,
        1.0,
        trials,
    )
    missed = [_left_out(fit, p, y) for p, y in found]
    shares = [_explained(fit, y, misses) for (_, y), (misses, _) in zip(found, missed, strict=True)]
    squares = np.concatenate(
        [
            np.ravel(misses**2 / np.maximum(fit.variance * unknown, _TINY))
            for misses, unknown in missed
        ]
    )
    even = float(np.median(squares) / max(_NORMAL * float(squares.mean()), _TINY))
    return replace(fit, explained=float(np.median(shares)), even=even)


def _spectrum(correlation: FloatArray, outcomes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Variances of the signal along independent directions, and the squares of outcomes there.

    A constant mean is projected out: shapes are ``(k - 1,)`` and ``(k - 1, d)``.
    """
    mean = correlation.mean(axis=0)
    values, vectors = np.linalg.eigh(correlation - mean - mean[:, None] + mean.mean())
    # The least belongs to the constant.
    return np.maximum(values[1:], 0.0) + _LEAST_NOISE, (vectors[:, 1:].T @ outcomes) ** 2


def _profile(values: FloatArray, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
    """For every noise, the log-determinant, shape ``(noises,)``, and weighted sums of squares.

    The latter have shape ``(noises, d)``.
    """
    spectra = values + _NOISES[:, None]
    return np.log(spectra).sum(axis=1), (1 / spectra) @ loads


def _left_out(
    fit: Smoothness, points: FloatArray, outcomes: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """What is missed of each trial when it is left out, and how uncertain that was to be.

    Returns:
        Misses, shape ``(k, d)``, and variances over those of the signal, shape ``(k, 1)``.
    """
    inverse = fit.inverses(points)
    unknown = 1 / np.diagonal(inverse)[:, None]
    return (inverse @ (outcomes - outcomes.mean(axis=0))) * unknown, unknown


def _explained(fit: Smoothness, outcomes: FloatArray, misses: FloatArray) -> float:
    missed = float((misses**2).sum())
    differences = float(((outcomes - outcomes.mean(axis=0)) ** 2).sum())
    noise = len(outcomes) * fit.noise * float(fit.variance.sum()) if fit.noisy else 0.0
    return 1.0 - max(missed - noise, 0.0) / max(differences - noise, missed - noise, _TINY)


def _sharpened(found: Sequence[Neighbourhood], fit: Smoothness) -> FloatArray:
    """A metric that weighs directions by how much outcomes change along them."""
    products = np.zeros_like(fit.metric)
    for points, outcomes in found:
        weights = fit.inverses(points) @ (outcomes - outcomes.mean(axis=0))
        correlation = fit.correlation(np.einsum("ij,ij->i", points, points))
        slopes = fit.metric @ (points.T @ (weights * correlation[:, None]))
        products += slopes @ slopes.T
    n = len(products)
    products *= (1 - _ALIKE) * n / max(float(np.trace(products)), _TINY)
    values, vectors = np.linalg.eigh(products + _ALIKE * np.eye(n))
    metric: FloatArray = (vectors * np.sqrt(values)) @ vectors.T
    return metric
