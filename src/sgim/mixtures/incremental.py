"""Updating a mixture with new points, against what it was (Calinon 2009, section 2.8.2)."""

from __future__ import annotations

import numpy as np

from sgim.mixtures.expectation import EMPTY
from sgim.mixtures.mixture import (
    GaussianMixture,
    covariances_from,
    features_of,
    normalised,
    products_of,
)
from sgim.spaces import FloatArray


def updated(
    mixture: GaussianMixture,
    data: FloatArray,
    rate: float,
    *,
    floor: float = 1e-5,
    sweeps: int = 5,
    tolerance: float = 1e-3,
) -> GaussianMixture:
    """One incremental update by EM, the direct method.

    What was learned before is kept as the old components' masses, means and covariances alone;
    the new points' shares in the components are estimated again and again, against these.

    Args:
        mixture: What was learned before.
        data: The new points, shape ``(n, d)``.
        rate: Weight α of the new points, in [0, 1]; the old ones have 1 − α.
        floor: Variance added to the new points in every direction.
        sweeps: Most repetitions of EM.
        tolerance: Gain of the new points' mean log likelihood below which EM ends.
    """
    d = mixture.dimension
    features = features_of(data)
    old_mass = (1.0 - rate) * mixture.weights
    old = np.concatenate((mixture.means, products_of(mixture.means, mixture.covariances)), axis=1)
    old_sums = old_mass[:, None] * old
    made, before = mixture, -np.inf
    for _ in range(sweeps):
        shares, logs = normalised(made.log_parts(data, features))
        now = float(logs.mean())
        if now - before < tolerance:
            break
        before = now
        shares *= rate / len(data)
        new_mass = shares.sum(axis=0)
        masses = old_mass + new_mass
        full = masses > EMPTY
        safe = np.where(full, masses, 1.0)
        averages = (old_sums + shares.T @ features) / safe[:, None]
        means = np.where(full[:, None], averages[:, :d], mixture.means)
        covariances = covariances_from(averages[:, d:], averages[:, :d])
        covariances[:, np.arange(d), np.arange(d)] += (floor * new_mass / safe)[:, None]
        covariances = np.where(full[:, None, None], covariances, mixture.covariances)
        made = GaussianMixture(masses, means, covariances)
    return made


def split_starved(mixture: GaussianMixture, least: float) -> GaussianMixture:
    """Give each component whose weight is below ``least`` half of the heaviest one.

    The heaviest is cut in two along its longest axis, so that mean and covariance of the two
    together are those of the whole. Components that starve are thus used again.
    """
    weights = mixture.weights.copy()
    means, covariances = mixture.means.copy(), mixture.covariances.copy()
    for starved in np.flatnonzero(weights < least).tolist():
        heaviest = int(weights.argmax())
        if weights[heaviest] < 2 * least or heaviest == starved:
            break
        values, vectors = np.linalg.eigh(covariances[heaviest])
        # Half of the variance along the axis lies between the two, half within each.
        offset = vectors[:, -1] * np.sqrt(max(values[-1], 0.0) / 2)
        covariances[heaviest] -= np.outer(offset, offset)
        covariances[starved] = covariances[heaviest]
        means[starved] = means[heaviest] - offset
        means[heaviest] += offset
        weights[heaviest] /= 2
        weights[starved] = weights[heaviest]
    return GaussianMixture(weights, means, covariances)


def falling_rate(done: float, first: float, last: float) -> float:
    """A rate that falls logarithmically from ``first`` to ``last`` as ``done`` goes from 0 to 1."""
    return float(first * (last / first) ** min(max(done, 0.0), 1.0))
