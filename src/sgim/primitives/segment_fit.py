"""Fit accelerations held for durations to a recorded angle: free-knot least squares.

The angle is a spline of degree 2 whose knots are the ends of the segments. Least squares over
free knots has many local minima, so the knots start from the best segmentation of a fine
acceleration profile, and accelerations and durations are then refined together.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sgim.primitives.recordings import with_sum
from sgim.spaces import FloatArray

_STARTING_BINS = (80, 40, 20)
_SMOOTHNESS = 1e-3


def angle_basis(times: FloatArray, durations: FloatArray) -> FloatArray:
    """Angle at each time per unit of each acceleration, from rest.

    Args:
        times: Seconds from the start, shape ``(n,)``.
        durations: How long each acceleration is held, in s, shape ``(segments,)``.

    Returns:
        Shape ``(n, segments)``, in s²; times its product with the accelerations is the angle.
    """
    ends = np.cumsum(durations)
    since_start = np.maximum(times[:, None] - (ends - durations), 0.0)
    since_end = np.maximum(times[:, None] - ends, 0.0)
    basis: FloatArray = 0.5 * (since_start**2 - since_end**2)
    return basis


def starting_durations(
    times: FloatArray,
    angles: FloatArray,
    segments: int,
    max_acceleration: float,
    max_duration: float,
) -> Iterator[FloatArray]:
    """Durations to start from, most promising first; each of shape ``(segments,)``."""
    for bins in _STARTING_BINS:
        # Bins no longer than a segment may be, and one or more for each segment.
        enough = max(bins, segments)
        profile = _acceleration_profile(times, angles, enough, max_acceleration)
        width = float(times[-1]) / enough
        yield _segment(profile, segments, int(max_duration / width) + 1) * width
    yield np.full(segments, times[-1] / segments)


def refine(
    times: FloatArray,
    angles: FloatArray,
    durations: FloatArray,
    max_acceleration: float,
    max_duration: float,
) -> tuple[FloatArray, FloatArray]:
    """Improve durations, and find the accelerations that go with them.

    Args:
        times: Seconds from the start, shape ``(n,)``.
        angles: Angles in rad, shape ``(n,)``.
        durations: Where to start from, in s, shape ``(segments,)``.
        max_acceleration: Bound on accelerations, either way, in rad/s².
        max_duration: Bound on each duration, in s.

    Returns:
        Accelerations and durations within their bounds; the durations add up to ``times[-1]``.
    """
    # SciPy's optimisers take long to import, and most runs never fit a trajectory.
    from scipy.optimize import least_squares

    segments, end = len(durations), float(times[-1])
    # The sum of the durations is held by a stiff residual: one row more, no constraint.
    stiffness = 10 * np.sqrt(len(times))

    def residuals(parameters: FloatArray) -> FloatArray:
        accelerations, spans = parameters[:segments], parameters[segments:]
        gaps = angle_basis(times, spans) @ accelerations - angles
        return np.append(gaps, stiffness * (spans.sum() - end))

    def jacobian(parameters: FloatArray) -> FloatArray:
        accelerations, spans = parameters[:segments], parameters[segments:]
        rows = np.zeros((len(times) + 1, 2 * segments))
        rows[:-1, :segments] = angle_basis(times, spans)
        # A segment's end changes the speed after it; a duration shifts all later ends.
        jumps = accelerations - np.append(accelerations[1:], 0.0)
        by_end = np.maximum(times[:, None] - np.cumsum(spans), 0.0) * jumps
        rows[:-1, segments:] = np.cumsum(by_end[:, ::-1], axis=1)[:, ::-1]
        rows[-1, segments:] = stiffness
        return rows

    high = np.repeat([max_acceleration, max_duration], segments)
    low = np.repeat([-max_acceleration, 0.0], segments)
    margin = 1e-6 * (high - low)
    start = np.append(_accelerations(times, angles, durations, max_acceleration), durations)
    found = least_squares(
        residuals,
        np.clip(start, low + margin, high - margin),
        jacobian,
        bounds=(low, high),
        x_scale="jac",
        max_nfev=300,
        ftol=1e-14,
        xtol=1e-12,
        gtol=1e-15,
    )
    spans = with_sum(found.x[segments:], end, max_duration)
    return _accelerations(times, angles, spans, max_acceleration), spans


def _accelerations(
    times: FloatArray, angles: FloatArray, durations: FloatArray, bound: float
) -> FloatArray:
    """The best accelerations for given durations: bounded linear least squares."""
    from scipy.optimize import lsq_linear

    found = lsq_linear(angle_basis(times, durations), angles, bounds=(-bound, bound))
    return np.clip(found.x, -bound, bound)


def _acceleration_profile(
    times: FloatArray, angles: FloatArray, bins: int, bound: float
) -> FloatArray:
    """Accelerations over equal bins, slightly smoothed, shape ``(bins,)``."""
    from scipy.optimize import lsq_linear

    width = times[-1] / bins
    basis = angle_basis(times, np.full(bins, width))
    smoothing = _SMOOTHNESS * width**2 * np.sqrt(len(times)) * np.diff(np.eye(bins), axis=0)
    targets = np.append(angles, np.zeros(bins - 1))
    found = lsq_linear(np.vstack([basis, smoothing]), targets, bounds=(-bound, bound))
    profile: FloatArray = found.x
    return profile


def _segment(profile: FloatArray, segments: int, longest: int) -> FloatArray:
    """Numbers of bins of the best piecewise constant approximation, by dynamic programming."""
    bins = len(profile)
    sums = np.append(0.0, np.cumsum(profile))
    squares = np.append(0.0, np.cumsum(profile**2))
    index = np.arange(bins + 1)
    lengths = index - index[:, None]
    cost = np.full((bins + 1, bins + 1), np.inf)
    allowed = (lengths > 0) & (lengths <= longest)
    spread = (squares - squares[:, None]) - (sums - sums[:, None]) ** 2 / np.maximum(lengths, 1)
    cost[allowed] = spread[allowed]

    least = cost[0]
    origins = []
    for _ in range(segments - 1):
        through = least[:, None] + cost
        origins.append(through.argmin(axis=0))
        least = through.min(axis=0)
    ends = [bins]
    for origin in reversed(origins):
        ends.append(int(origin[ends[-1]]))
    return np.diff([0, *reversed(ends)]).astype(np.float64)
