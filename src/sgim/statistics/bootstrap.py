"""Intervals by resampling the runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.spaces import FloatArray
from sgim.statistics.summaries import interquartile_mean, performance_profile

RESAMPLES = 2000
LEVEL = 0.95

_NUMBERS_AT_ONCE = 4_000_000
"""Numbers gathered at once, so that long curves of many runs fit into memory."""


@dataclass(frozen=True)
class Estimate:
    """A value with its interval; arrays of one shape, a number's or a curve's.

    Attributes:
        value: The value.
        low: Lower end of the interval; NaN where fewer than two runs give none.
        high: Upper end.
    """

    value: FloatArray
    low: FloatArray
    high: FloatArray

    def as_json(self) -> dict[str, Any]:
        """``value``, ``low`` and ``high`` as numbers or lists; None for what is not finite."""
        return {name: _finite(getattr(self, name)) for name in ("value", "low", "high")}


def bootstrap_interval(
    strata: Sequence[FloatArray],
    statistic: Callable[[Sequence[FloatArray]], FloatArray],
    rng: np.random.Generator,
    *,
    resamples: int = RESAMPLES,
    level: float = LEVEL,
) -> FloatArray:
    """The stratified percentile bootstrap interval of a statistic.

    Runs are drawn with replacement within each stratum: a world, a learner, or whatever else is
    fixed by the design (Efron 1979; strata as in Agarwal et al. 2021). With few runs percentile
    intervals are too narrow: ten runs or more are advised.

    Args:
        strata: Runs along the first axis, each of shape ``(n_s, …)``. Runs that belong together,
            as two learners' on one seed, are one run with two numbers: ``(n, 2)``.
        statistic: Given all strata resampled, shapes ``(r, n_s, …)``, gives ``(r, …)``.
        rng: Draws the resamples.
        resamples: How many.
        level: Share of the resampled statistics that the interval holds.

    Returns:
        Lower and upper end, shape ``(2, …)``; NaN if a stratum has fewer than two runs, because
        one run says nothing of how runs scatter.
    """
    if min(len(stratum) for stratum in strata) < 2:
        shape = statistic([stratum[None] for stratum in strata]).shape[1:]
        return np.full((2, *shape), np.nan)
    drawn = [rng.integers(0, len(s), (resamples, len(s))) for s in strata]
    at_once = max(1, _NUMBERS_AT_ONCE // sum(stratum.size for stratum in strata))
    parts = []
    for first in range(0, resamples, at_once):
        rows = slice(first, first + at_once)
        parts.append(statistic([s[d[rows]] for s, d in zip(strata, drawn, strict=True)]))
    tails = [(1 - level) / 2, (1 + level) / 2]
    return np.asarray(np.quantile(np.concatenate(parts), tails, axis=0))


def interquartile_estimate(
    runs: FloatArray,
    rng: np.random.Generator,
    *,
    resamples: int = RESAMPLES,
    level: float = LEVEL,
) -> Estimate:
    """The interquartile mean over runs, with its bootstrap interval: pointwise for curves.

    Args:
        runs: Shape ``(n, …)``: one number a run, or one curve a run.
        rng: Draws the resamples.
        resamples: How many.
        level: Of the interval, at each point by itself.
    """
    low, high = bootstrap_interval(
        [runs],
        lambda strata: interquartile_mean(strata[0], axis=1),
        rng,
        resamples=resamples,
        level=level,
    )
    return Estimate(interquartile_mean(runs), np.asarray(low), np.asarray(high))


def profile_estimate(
    runs: FloatArray,
    thresholds: FloatArray,
    rng: np.random.Generator,
    *,
    resamples: int = RESAMPLES,
    level: float = LEVEL,
) -> Estimate:
    """The performance profile of a learner's errors, with its pointwise bootstrap interval.

    Args:
        runs: One error a run, shape ``(n,)``.
        thresholds: Shape ``(m,)``.
        rng: Draws the resamples.
        resamples: How many.
        level: Of the interval, at each threshold by itself.

    Returns:
        The share of runs at or under each threshold, shape ``(m,)``; as in Agarwal et al. 2021.
    """
    low, high = bootstrap_interval(
        [runs],
        lambda strata: performance_profile(strata[0], thresholds, axis=1),
        rng,
        resamples=resamples,
        level=level,
    )
    return Estimate(performance_profile(runs, thresholds), np.asarray(low), np.asarray(high))


def contrast_estimates(
    one: FloatArray, other: FloatArray, rng: np.random.Generator, *, paired: bool
) -> tuple[Estimate, Estimate]:
    """Difference and ratio of two interquartile means, with their bootstrap intervals.

    Args:
        one: One number a run, shape ``(n,)``.
        other: Shape ``(m,)``; with ``m == n`` if paired.
        rng: Draws the resamples.
        paired: Whether they belong together two by two; pairs are resampled together.

    Returns:
        ``one - other``, and ``one / other``, which is NaN where the other is 0.
    """

    def both(strata: Sequence[FloatArray]) -> FloatArray:
        first, second = (strata[0][..., 0], strata[0][..., 1]) if paired else strata
        a, b = interquartile_mean(first, axis=-1), interquartile_mean(second, axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.stack([a - b, np.where(b > 0, a / b, np.nan)], axis=-1)

    strata = [np.stack([one, other], axis=1)] if paired else [one, other]
    values, (low, high) = both(strata), bootstrap_interval(strata, both, rng)
    difference, ratio = (
        Estimate(*(np.asarray(part[i]) for part in (values, low, high))) for i in range(2)
    )
    return difference, ratio


def _finite(values: FloatArray) -> Any:
    if values.ndim:
        return [_finite(value) for value in values]
    return float(values) if np.isfinite(values) else None
