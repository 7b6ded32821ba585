"""What many runs come to: the interquartile mean, the area under a curve, a profile."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from sgim.errors import SgimError
from sgim.spaces import FloatArray


def interquartile_mean(values: ArrayLike, axis: int = 0) -> FloatArray:
    """The mean of the middle half of the values.

    It is less at the mercy of outliers than the mean, and uses more of the runs than the median
    (Agarwal et al., *Deep reinforcement learning at the edge of the statistical precipice*,
    NeurIPS 2021). Where the number of values is no multiple of four, the two values at the
    quartiles count in part; otherwise it is `scipy.stats.trim_mean` with a quarter cut.

    Args:
        values: Values along one axis, one or more.
        axis: That axis.

    Returns:
        The values' shape without that axis.

    Raises:
        SgimError: If there is no value.
    """
    ordered = np.moveaxis(np.sort(np.asarray(values, dtype=np.float64), axis=axis), axis, -1)
    n = ordered.shape[-1]
    if n == 0:
        raise SgimError("the interquartile mean of no values is not defined; pass one or more")
    edges = np.clip(np.arange(n + 1) / n, 0.25, 0.75)
    return np.asarray(ordered @ (2 * np.diff(edges)))


def area_under_curve(positions: ArrayLike, values: ArrayLike) -> FloatArray:
    """The mean height of curves, by the trapezoidal rule: the area over the width.

    Args:
        positions: Where the curves were measured, increasing, shape ``(n,)``.
        values: Their heights there, shape ``(…, n)``.

    Returns:
        In the unit of the heights, shape ``(…)``; of a single position, the height there.

    Raises:
        SgimError: If the positions do not increase, or are not as many as the heights.
    """
    x, y = np.asarray(positions, dtype=np.float64), np.asarray(values, dtype=np.float64)
    if x.ndim != 1 or y.ndim < 1 or len(x) != y.shape[-1] or len(x) == 0:
        raise SgimError(
            f"curves have shape {y.shape} and positions {x.shape}; expected (…, n) and (n,)"
        )
    if len(x) == 1:
        return np.asarray(y[..., 0])
    steps = np.diff(x)
    if not (steps > 0).all():
        raise SgimError(f"positions {x} do not increase; sort them, each once")
    return np.asarray((y[..., 1:] + y[..., :-1]) / 2 @ steps / steps.sum())


def performance_profile(values: ArrayLike, thresholds: ArrayLike, axis: int = 0) -> FloatArray:
    """The share of runs whose error is at most each threshold.

    The score distribution of Agarwal et al. (2021), for errors: the higher, the better. Of two
    learners, one is better throughout if its profile is nowhere below the other's.

    Args:
        values: Errors of the runs along one axis.
        thresholds: Shape ``(m,)``.
        axis: That axis.

    Returns:
        The values' shape without that axis, with the thresholds' behind it: ``(…, m)``.
    """
    below = np.asarray(values)[..., None] <= np.asarray(thresholds)
    return np.asarray(below.mean(axis=axis if axis >= 0 else axis - 1))
