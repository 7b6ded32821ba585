"""A mixture of Gaussians: its densities, its marginals, and draws from it."""

from __future__ import annotations

import math
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from sgim.spaces import FloatArray

_REPAIR = 1e-9
"""Least eigenvalue, as a share of the largest, of a covariance that rounding has spoilt."""


class GaussianMixture:
    """A weighted sum of k Gaussians in d dimensions; it does not change.

    Covariances must be symmetric; where rounding, or data that vary in fewer than d directions,
    have made one singular, its least eigenvalues are raised until it is not.

    Args:
        weights: Shape ``(k,)``, none negative, one positive; scaled to sum 1.
        means: Shape ``(k, d)``.
        covariances: Shape ``(k, d, d)``.

    Raises:
        ValueError: If shapes disagree, a number is not finite, or no weight is positive.
    """

    def __init__(self, weights: FloatArray, means: FloatArray, covariances: FloatArray) -> None:
        k, d = means.shape
        if weights.shape != (k,) or covariances.shape != (k, d, d):
            raise ValueError(
                f"weights, means and covariances have shapes {weights.shape}, {means.shape} and "
                f"{covariances.shape}, expected (k,), (k, d) and (k, d, d)"
            )
        total = float(weights.sum())
        if not (np.isfinite(means).all() and np.isfinite(covariances).all() and 0 < total < np.inf):
            raise ValueError("a mixture needs finite means and covariances, and positive weights")
        self.weights: FloatArray = weights / total
        self.means = means
        self.covariances, self.factors = _factorised(covariances)

    @property
    def components(self) -> int:
        """The number of Gaussians, k."""
        return len(self.weights)

    @property
    def dimension(self) -> int:
        """The number of coordinates, d."""
        return int(self.means.shape[1])

    @cached_property
    def _terms(self) -> tuple[FloatArray, FloatArray]:
        """Constant and coefficients of the log densities, as functions of `features`."""
        d = self.dimension
        halves = inverted(self.factors)
        precisions = np.swapaxes(halves, 1, 2) @ halves
        linear = np.einsum("kij,kj->ki", precisions, self.means)
        rows, columns, doubled = _upper(d)
        quadratic = -0.5 * doubled * precisions[:, rows, columns]
        logs = np.log(np.diagonal(self.factors, axis1=1, axis2=2)).sum(axis=1)
        constant = -0.5 * (d * math.log(2 * math.pi) + (linear * self.means).sum(axis=1)) - logs
        with np.errstate(divide="ignore"):
            constant += np.log(self.weights)
        return constant, np.concatenate((linear, quadratic), axis=1).T.copy()

    def log_parts(self, data: FloatArray, features: FloatArray | None = None) -> FloatArray:
        """Logarithm of each component's weighted density at each point.

        Args:
            data: The points, shape ``(n, d)``.
            features: Their `features`, if known.

        Returns:
            Shape ``(n, k)``.
        """
        constant, coefficients = self._terms
        known = features_of(data) if features is None else features
        parts: FloatArray = known @ coefficients
        parts += constant
        return parts

    def shares(self, data: FloatArray, features: FloatArray | None = None) -> FloatArray:
        """The posterior probability of each component at each point, shape ``(n, k)``."""
        return normalised(self.log_parts(data, features))[0]

    def log_likelihood(self, data: FloatArray) -> float:
        """The mean logarithm of the density at the points, shape ``(n, d)``."""
        return float(normalised(self.log_parts(data))[1].mean())

    def marginal(self, columns: NDArray[np.intp] | list[int]) -> GaussianMixture:
        """The distribution of some coordinates, whatever the others are."""
        chosen = np.asarray(columns)
        covariances = self.covariances[:, chosen[:, None], chosen]
        return GaussianMixture(self.weights, self.means[:, chosen], covariances)

    def reweighted(self, weights: FloatArray) -> GaussianMixture:
        """The same Gaussians with other weights."""
        return GaussianMixture(weights, self.means, self.covariances)

    def sample(self, rng: np.random.Generator, n: int) -> FloatArray:
        """Draw n points, shape ``(n, d)``."""
        chosen = rng.choice(self.components, size=n, p=self.weights)
        normals = rng.standard_normal((n, self.dimension))
        points: FloatArray = self.means[chosen]
        points += np.einsum("nij,nj->ni", self.factors[chosen], normals)
        return points


@lru_cache(maxsize=64)
def _upper(d: int) -> tuple[NDArray[np.intp], NDArray[np.intp], FloatArray]:
    """Rows and columns of a symmetric matrix's upper triangle, and how often each is counted."""
    rows, columns = np.triu_indices(d)
    return rows, columns, np.where(rows == columns, 1.0, 2.0)


def features_of(data: FloatArray) -> FloatArray:
    """Coordinates and products of two coordinates, shape ``(n, d + d (d + 1) / 2)``.

    Log densities are linear in them, and their weighted sums are all that a fit needs.
    """
    n, d = data.shape
    features = np.empty((n, d + d * (d + 1) // 2))
    features[:, :d] = data
    start = d
    for i in range(d):
        np.multiply(data[:, i:], data[:, i : i + 1], out=features[:, start : start + d - i])
        start += d - i
    return features


def covariances_from(squares: FloatArray, means: FloatArray) -> FloatArray:
    """Covariances from the means of products of coordinates, in the order of `features_of`."""
    k, d = means.shape
    rows, columns, _ = _upper(d)
    centred = squares - means[:, rows] * means[:, columns]
    made = np.empty((k, d, d))
    made[:, rows, columns] = centred
    made[:, columns, rows] = centred
    return made


def products_of(means: FloatArray, covariances: FloatArray) -> FloatArray:
    """Mean products of coordinates of each Gaussian; undoes `covariances_from`."""
    rows, columns, _ = _upper(means.shape[1])
    return covariances[:, rows, columns] + means[:, rows] * means[:, columns]


def normalised(logs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Shares in each row that are proportional to the exponentials, and the rows' log sums."""
    greatest = logs.max(axis=1, keepdims=True)
    shares: FloatArray = np.exp(logs - greatest)
    totals = shares.sum(axis=1, keepdims=True)
    shares /= totals
    sums: FloatArray = (greatest + np.log(totals))[:, 0]
    return shares, sums


def inverted(factors: FloatArray) -> FloatArray:
    """Inverses of lower triangular matrices, shape ``(k, d, d)``, by forward substitution."""
    inverses = np.zeros_like(factors)
    for i in range(factors.shape[1]):
        diagonal = factors[:, i, i]
        if i:
            row = factors[:, None, i, :i] @ inverses[:, :i, :i]
            inverses[:, i, :i] = -row[:, 0] / diagonal[:, None]
        inverses[:, i, i] = 1.0 / diagonal
    return inverses


def _factorised(covariances: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Covariances, mended where singular, and their lower Cholesky factors."""
    factors: FloatArray
    try:
        factors = np.linalg.cholesky(covariances).astype(np.float64, copy=False)
        return covariances, factors
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh(covariances)
    # Eigenvalues below 0 show how large the rounding is.
    least = np.maximum(np.abs(values).max(axis=1, keepdims=True) * _REPAIR, -2 * values[:, :1])
    least = np.maximum(least, _REPAIR**2)
    while True:
        mended = (vectors * np.maximum(values, least)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
        mended = (mended + np.swapaxes(mended, 1, 2)) / 2
        try:
            factors = np.linalg.cholesky(mended).astype(np.float64, copy=False)
            return mended, factors
        except np.linalg.LinAlgError:
            least = least * 10.0
