"""How smooth the map is that some trials show: learned from a few of their neighbourhoods.

Its constants make the outcomes of the neighbourhoods likely, as if those were independent (A. V.
Vecchia, "Estimation and model identification for continuous spatial processes", Journal of the
Royal Statistical Society B 50(2), 1988).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sgim.policy.smoothness import LEAST_NOISE, Smoothness, squared_distances
from sgim.policy.tridiagonal import shifted, tridiagonal
from sgim.spaces import FloatArray

Neighbourhood = tuple[FloatArray, FloatArray]
"""Policies, shape ``(k, n)``, and outcomes, shape ``(k, d)``."""

_LENGTHS = 2.0 ** np.arange(-3.0, 4.0)  # Over the median distance between policies.
_NOISES = np.append(0.0, 10.0 ** np.arange(-8.0, 0.0, 0.5))  # Over the signal.
_NORMAL = 0.4549  # Median of the squares of normally distributed numbers, over their mean.
_NONE, _SOME = 1e-5, 1e-3  # Up to the one there is no noise, from the other on there is some.
_ROUNDS = 2  # Of learning the metric.
_ALIKE = 0.5  # The share of the metric in which all directions count alike.
_TINY = 1e-300


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
    varies = np.ptp(outcomes, axis=0) > 0
    if not varies.all():  # what never changes says nothing of noise
        found = learned(policies, outcomes[:, varies], samples=samples, near=near)
        if found is None:
            return None
        variance = np.zeros(len(varies))
        variance[varies] = found.variance
        return replace(found, variance=variance)
    return _learned(policies, outcomes, samples, near) if varies.size else None


def _learned(
    policies: FloatArray, outcomes: FloatArray, samples: int, near: int
) -> Smoothness | None:
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
    squared = np.array([squared_distances(p) for p, _ in found])
    outcomes = np.array([y - y.mean(axis=0) for _, y in found])
    lengths = float(np.sqrt(np.median(squared[squared > 0]))) * _LENGTHS
    correlations = np.exp(squared[:, None] * (-0.5 / lengths[:, None, None] ** 2))
    logs, sums, alone = _likelihoods(correlations, outcomes)
    count, coordinates = outcomes.shape[0] * (outcomes.shape[1] - 1), outcomes.shape[2]
    sums = sums.sum(axis=0)
    together = -0.5 * (
        coordinates * logs.sum(axis=0) + count * np.log(sums / count + _TINY).sum(axis=2)
    )
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


def _likelihoods(
    correlations: FloatArray, outcomes: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """How likely outcomes are in each neighbourhood, for each length and noise.

    A constant mean is projected out.

    Args:
        correlations: Of the signal, for each neighbourhood and length, shape ``(m, l, k, k)``.
        outcomes: Less their mean, shape ``(m, k, d)``.

    Returns:
        Log-determinants, shape ``(m, l, noises)``; weighted sums of squares, shape ``(m, l, noises,
        d)``; and for each neighbourhood alone, where noise is weighed against the differences
        within it, logarithms of likelihoods of that last shape.
    """
    means = correlations.mean(axis=-1, keepdims=True)
    centred = correlations - means - np.swapaxes(means, -1, -2)
    centred += means.mean(axis=-2, keepdims=True)
    free = outcomes.shape[1] - 1
    signal = np.trace(centred, axis1=-2, axis2=-1)[..., None] / free + LEAST_NOISE
    noises = np.stack(np.broadcast_arrays(_NOISES, _NOISES * signal), axis=-2) + LEAST_NOISE
    logs, sums = shifted(*tridiagonal(centred, outcomes[:, None]), noises)
    logs -= np.log(noises)  # What belongs to the constant.
    scaled = logs[:, :, 1] - free * np.log(signal)
    within = np.log(sums[:, :, 1] * (signal / free)[..., None] + _TINY)
    return logs[:, :, 0], sums[:, :, 0], -0.5 * (scaled[..., None] + free * within)


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
