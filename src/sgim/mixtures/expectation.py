"""Fitting a mixture to points at once: k-means, then expectation and maximisation (EM)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sgim.mixtures.mixture import (
    GaussianMixture,
    covariances_from,
    features_of,
    normalised,
)
from sgim.spaces import FloatArray

EMPTY = 1e-12
"""Share of the points below which a component is empty: it keeps its mean and covariance."""


def fit(
    data: FloatArray,
    components: int,
    rng: np.random.Generator,
    *,
    floor: float = 1e-5,
    sweeps: int = 100,
    tolerance: float = 1e-3,
) -> GaussianMixture:
    """Fit a mixture by classical EM (Dempster, Laird and Rubin 1977), from k-means.

    Args:
        data: The points, shape ``(n, d)``, n ≥ 1. With fewer points than components, there are
            as many components as points.
        components: How many Gaussians.
        rng: For the first centres.
        floor: Variance added in every direction, so that no covariance is singular.
        sweeps: Most repetitions of EM.
        tolerance: Gain of the mean log likelihood below which EM ends.
    """
    components = min(components, len(data))
    labels = k_means(data, components, rng)
    shares = np.zeros((len(data), components))
    shares[np.arange(len(data)), labels] = 1.0
    features = features_of(data)
    overall = data.mean(axis=0)
    spread = np.cov(data, rowvar=False, bias=True).reshape(data.shape[1], -1)
    start = GaussianMixture(
        np.ones(components),
        np.tile(overall, (components, 1)),
        np.tile(spread + floor * np.eye(data.shape[1]), (components, 1, 1)),
    )
    mixture, before = maximised(start, features, shares, floor), -np.inf
    for _ in range(sweeps):
        shares, logs = normalised(mixture.log_parts(data, features))
        now = float(logs.mean())
        if now - before < tolerance:
            break
        mixture, before = maximised(mixture, features, shares, floor), now
    return mixture


def maximised(
    mixture: GaussianMixture, features: FloatArray, shares: FloatArray, floor: float
) -> GaussianMixture:
    """The mixture that fits best, given the components' shares in each point.

    Args:
        mixture: The one before; components without points keep its means and covariances.
        features: Of the points (see `features_of`).
        shares: Shape ``(n, k)``.
        floor: Variance added in every direction.
    """
    d = mixture.dimension
    masses = shares.sum(axis=0)
    full = masses > EMPTY * len(features)
    averages = (shares.T @ features) / np.where(full, masses, 1.0)[:, None]
    means = np.where(full[:, None], averages[:, :d], mixture.means)
    covariances = covariances_from(averages[:, d:], averages[:, :d])
    covariances[:, np.arange(d), np.arange(d)] += floor
    covariances = np.where(full[:, None, None], covariances, mixture.covariances)
    return GaussianMixture(masses, means, covariances)


def k_means(
    data: FloatArray, components: int, rng: np.random.Generator, rounds: int = 10
) -> NDArray[np.intp]:
    """Labels of Lloyd's k-means, whose first centres are drawn far apart (Arthur, 2007).

    Args:
        data: The points, shape ``(n, d)``.
        components: How many centres, at most n.
        rng: For the first centres.
        rounds: Most rounds.
    """
    squares = (data * data).sum(axis=1)
    chosen = [int(rng.integers(len(data)))]
    nearest = np.full(len(data), np.inf)
    for _ in range(components - 1):
        nearest = np.minimum(nearest, ((data - data[chosen[-1]]) ** 2).sum(axis=1))
        cumulated = nearest.cumsum()
        if cumulated[-1] > 0:
            wanted = rng.random() * cumulated[-1]
            chosen.append(min(int(cumulated.searchsorted(wanted, "right")), len(data) - 1))
        else:  # every point lies on a centre
            chosen.append(int(rng.integers(len(data))))
    centres = data[chosen]
    labels = np.zeros(len(data), dtype=np.intp)
    for turn in range(rounds):
        distances = squares[:, None] - 2 * (data @ centres.T) + (centres * centres).sum(axis=1)
        found = distances.argmin(axis=1)
        if turn and np.array_equal(found, labels):
            break
        labels = found
        counts = np.bincount(labels, minlength=components)
        members = (labels[:, None] == np.arange(components)).astype(np.float64)
        sums = members.T @ data
        centres = np.where(counts[:, None] > 0, sums / np.maximum(counts, 1)[:, None], centres)
    return labels
