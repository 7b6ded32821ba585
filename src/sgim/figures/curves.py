"""Learning curves of several runs: a middle and a band, over movements or over cost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sgim.runs.summary import RecordedRun
from sgim.spaces import FloatArray
from sgim.statistics import interquartile_estimate
from sgim.streams import Streams

Band = Literal["interval", "quartiles"]

BANDS: dict[Band, str] = {
    "interval": "interquartile mean of the runs, with its 95 % bootstrap interval",
    "quartiles": "median of the runs, with their quartiles",
}


@dataclass(frozen=True)
class Curve:
    """A learner's curve; arrays of one length.

    Attributes:
        x: Movements, or seconds.
        low: Lower edge of the band; NaN where there is none.
        middle: The line.
        high: Upper edge.
    """

    x: FloatArray
    low: FloatArray
    middle: FloatArray
    high: FloatArray


def curve(
    runs: Sequence[RecordedRun],
    kind: str,
    band: Band,
    costs: Sequence[FloatArray] | None = None,
) -> Curve:
    """The errors of runs of one learner, wherever half of the runs or more were evaluated.

    Args:
        runs: The runs.
        kind: Kind of goal, or ``total``.
        band: What line and band are, a key of `BANDS`.
        costs: What each run had cost at each of its evaluations, for a curve over cost: an
            evaluation is where the runs' mean cost was by then.
    """
    x, errors = _errors(runs, kind)
    if costs is not None:
        x = _mean_costs(runs, x, costs)
    low, middle, high = np.full((3, len(x)), np.nan)
    missing = np.isnan(errors)
    patterns, which = np.unique(missing, axis=1, return_inverse=True)
    for i, pattern in enumerate(patterns.T):
        at = which.ravel() == i
        low[at], middle[at], high[at] = _middle(errors[~pattern][:, at], band)
    return Curve(x, low, middle, high)


def _middle(errors: FloatArray, band: Band) -> tuple[FloatArray, FloatArray, FloatArray]:
    if band == "quartiles":
        low, middle, high = np.percentile(errors, [25, 50, 75], axis=0)
        return low, middle, high
    found = interquartile_estimate(errors, Streams(0)("bootstrap/curve"))
    return found.low, found.value, found.high


def _errors(runs: Sequence[RecordedRun], kind: str) -> tuple[FloatArray, FloatArray]:
    """Movements, shape ``(n,)``, and errors, ``(runs, n)``, NaN where a run has none."""
    found = [
        {e.movements: e.errors[kind] for e in run.evaluations if kind in e.errors} for run in runs
    ]
    counts: dict[int, int] = {}
    for errors in found:
        for movements in errors:
            counts[movements] = counts.get(movements, 0) + 1
    shown = sorted(m for m, count in counts.items() if 2 * count >= len(runs))
    table = [[errors.get(m, np.nan) for m in shown] for errors in found]
    return np.array(shown, dtype=np.float64), np.array(table).reshape(len(runs), len(shown))


def _mean_costs(
    runs: Sequence[RecordedRun], movements: FloatArray, costs: Sequence[FloatArray]
) -> FloatArray:
    """What runs had spent at these evaluations, the mean of those that were evaluated then."""
    found: dict[int, list[float]] = {}
    for run, cost in zip(runs, costs, strict=True):
        for evaluation, spent in zip(run.evaluations, cost.tolist(), strict=True):
            found.setdefault(evaluation.movements, []).append(spent)
    return np.array([np.mean(found[int(m)]) for m in movements])
