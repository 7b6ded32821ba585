"""A mixture over some coordinates, given the others.

The rounding of every function here is the same however many points it is asked for at once, so
that a resumed run, which asks for them one by one, decides as the first one did.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sgim.mixtures.mixture import GaussianMixture, inverted, normalised
from sgim.spaces import FloatArray

_LARGEST = 1e300  # Of a squared distance: with all infinite, no component would be nearest.


class Conditional:
    """The distribution of the last coordinates given the first ones.

    Args:
        mixture: Over all coordinates.
        given: How many coordinates are given, the first ones.
    """

    def __init__(self, mixture: GaussianMixture, given: int) -> None:
        g = given
        self.weights = mixture.weights
        self.means_given, self.means = mixture.means[:, :g].copy(), mixture.means[:, g:].copy()
        factors = mixture.factors[:, :g, :g]
        # The factor of the given coordinates is the upper corner of the whole one; the lower
        # corner is the factor of the others' covariance, once the given ones are known.
        self.whitening = inverted(factors)
        self.gains = mixture.factors[:, g:, :g] @ self.whitening
        self.factors = np.ascontiguousarray(mixture.factors[:, g:, g:])
        with np.errstate(divide="ignore"):
            self._logs = np.log(mixture.weights)
        self._logs = self._logs - np.log(np.diagonal(factors, axis1=1, axis2=2)).sum(axis=1)

    def shares(self, points: FloatArray) -> FloatArray:
        """The components' probabilities given each point, shape ``(n, k)``."""
        # One coordinate after the other, for all points and components at once.
        offsets = points.T[:, :, None] - self.means_given.T[:, None, :]
        squares: FloatArray = np.zeros(offsets.shape[1:])
        with np.errstate(over="ignore"):
            for row, weights in enumerate(self.whitening.transpose(1, 2, 0)):
                whitened = offsets[0] * weights[0]
                for offset, weight in zip(offsets[1 : row + 1], weights[1 : row + 1], strict=True):
                    whitened += offset * weight
                whitened *= whitened
                squares += whitened
        return normalised(self._logs - 0.5 * np.minimum(squares, _LARGEST))[0]

    def chosen(self, points: FloatArray, picks: FloatArray) -> NDArray[np.intp]:
        """A component for each point, by its cumulated share at ``picks`` in [0, 1)."""
        cumulated = self.shares(points).cumsum(axis=1)
        below = cumulated <= picks[:, None] * cumulated[:, -1:]
        components: NDArray[np.intp] = np.minimum(below.sum(axis=1), len(self.weights) - 1)
        return components

    def likeliest(self, points: FloatArray) -> NDArray[np.intp]:
        """The component with the largest share at each point."""
        components: NDArray[np.intp] = self.shares(points).argmax(axis=1)
        return components

    def centres(self, points: FloatArray, components: NDArray[np.intp]) -> FloatArray:
        """The mean of one component given each point."""
        offsets = points - self.means_given[components]
        return self.means[components] + rowwise(self.gains[components], offsets)

    def draw(self, points: FloatArray, picks: FloatArray, normals: FloatArray) -> FloatArray:
        """Draw the last coordinates given each point.

        Args:
            points: The first coordinates, shape ``(n, given)``.
            picks: Uniform numbers in [0, 1), shape ``(n,)``, by which components are chosen.
            normals: Standard normal numbers, shape ``(n, d − given)``.
        """
        components = self.chosen(points, picks)
        return self.centres(points, components) + rowwise(self.factors[components], normals)


def rowwise(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Products of matrices and vectors, each row summed by itself."""
    products: FloatArray = (matrices * vectors[..., None, :]).sum(axis=-1)
    return products
