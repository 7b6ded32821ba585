"""How smooth a map from policies to outcomes is, and how noisy: fitted to what is remembered.

The model is a Gaussian process (Rasmussen and Williams, "Gaussian Processes for Machine Learning",
MIT Press, 2006) with a squared-exponential covariance of one length, a mean that is constant in
each neighbourhood, and noise. Its constants make the outcomes of a few neighbourhoods likely.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sgim.spaces import FloatArray

_LENGTHS = 2.0 ** np.arange(-4.0, 5.0)  # Over the median distance between policies.
_NOISES = np.array([0.0, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1])
_NOISELESS = 3  # The first of them are as good as none.
_ROUNDING = 1e-8
_TINY = 1e-300
_DECISIVE = 2.0  # Of a difference of logarithms of likelihoods.


@dataclass(frozen=True)
class Smoothness:
    """The constants of a Gaussian process over policies.

    Attributes:
        length: Distance between policies over which outcomes change, in the unit box.
        noise: Variance of the noise over that of the signal.
        variance: Variance of the signal, in the unit box, for each coordinate; shape ``(d,)``.
        noisy: Whether most neighbourhoods are explained better with noise than without.
        resolved: Whether a map shows: the noise is less than the most that was considered.
    """

    length: float
    noise: float
    variance: FloatArray
    noisy: bool
    resolved: bool

    def covariance(self, squares: FloatArray) -> FloatArray:
        """The signal's correlation over squared distances between policies."""
        correlation: FloatArray = np.exp(squares * (-0.5 / self.length**2))
        return correlation


def squared_distances(points: FloatArray) -> FloatArray:
    """Squared distances among points, shape ``(..., n, dimension)``, as ``(..., n, n)``."""
    products = points @ np.swapaxes(points, -1, -2)
    norms = np.diagonal(products, axis1=-2, axis2=-1)
    squares: FloatArray = norms[..., :, None] + norms[..., None, :] - 2 * products
    return np.maximum(squares, 0.0)


def fitted(neighbourhoods: Sequence[tuple[FloatArray, FloatArray]]) -> Smoothness | None:
    """The constants under which the outcomes of some neighbourhoods are likeliest.

    The likelihoods multiply as if neighbourhoods were independent (Vecchia 1988); length and
    noise are the best on a grid. Whether there is noise is put to the vote, each neighbourhood
    being fitted alone: where outcomes jump, the few that straddle a jump would decide otherwise.

    Args:
        neighbourhoods: Policies, shape ``(n, dimension)``, and outcomes, shape ``(n, d)``, in
            the unit box.

    Returns:
        The constants; None if there is nothing to fit them to.
    """
    parts = [
        (squared_distances(policies), outcomes - outcomes.mean(axis=0))
        for policies, outcomes in neighbourhoods
    ]
    parts = [(squares, outcomes) for squares, outcomes in parts if squares.any()]
    if not parts:
        return None
    typical = float(np.sqrt(np.median(np.concatenate([s[s > 0] for s, _ in parts]))))
    lengths = typical * _LENGTHS
    count = sum(len(outcomes) - 1 for _, outcomes in parts)
    coordinates = parts[0][1].shape[1]
    logs = np.zeros((len(lengths), len(_NOISES)))
    sums = np.zeros((len(lengths), len(_NOISES), coordinates))
    alone = np.zeros((len(parts), len(lengths), len(_NOISES), coordinates))
    for i, length in enumerate(lengths):
        for part, (squares, outcomes) in enumerate(parts):
            log, total = _profile(np.exp(squares * (-0.5 / length**2)), outcomes)
            logs[i] += log
            sums[i] += total
            free = len(outcomes) - 1
            alone[part, i] = -0.5 * (log[:, None] + free * np.log(total / free + _TINY))
    together = -0.5 * (coordinates * logs + count * np.log(sums / count + _TINY).sum(axis=2))
    best = np.unravel_index(int(np.argmax(together)), together.shape)
    best_of_all = alone.max(axis=(1, 2))
    best_without = alone[:, :, :_NOISELESS].max(axis=(1, 2))
    gains = (best_of_all - best_without).sum(axis=1)
    return Smoothness(
        float(lengths[best[0]]),
        float(_NOISES[best[1]]),
        sums[best] / count,
        bool(np.median(gains) > _DECISIVE),
        bool(best[1] < len(_NOISES) - 1),
    )


def _profile(correlation: FloatArray, outcomes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """For every noise, the log-determinant, shape ``(noises,)``, and weighted sums of squares.

    The latter have shape ``(noises, d)``. A constant mean is projected out.
    """
    mean = correlation.mean(axis=0)
    centred = correlation - mean - mean[:, None] + mean.mean()
    values, vectors = np.linalg.eigh(centred)
    values = np.maximum(values[1:], 0.0) + _ROUNDING  # the least belongs to the constant
    squares = (vectors[:, 1:].T @ outcomes) ** 2
    spectra = values + _NOISES[:, None]
    return np.log(spectra).sum(axis=1), (1 / spectra) @ squares
