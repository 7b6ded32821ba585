"""Where a series changes: its stages, by least squares."""

from __future__ import annotations

import numpy as np

from sgim.errors import SgimError
from sgim.spaces import FloatArray


def stages(values: FloatArray, *, tolerance: float, most: int, shortest: int = 1) -> list[int]:
    """Cut a series into the fewest stages within which it hardly changes.

    For each number of stages, dynamic programming finds those with the least sum of squared
    distances of values from their stage's mean (Auger and Lawrence 1989). Of these, the fewest
    stages are taken whose root mean square distance is within the tolerance.

    Args:
        values: One row for each window of time, shape ``(w, d)``.
        tolerance: The distance allowed.
        most: Most stages; so many if even they are not within the tolerance.
        shortest: Fewest windows in a stage.

    Returns:
        Where stages begin, and w: for k stages, k + 1 increasing numbers from 0 to w.

    Raises:
        SgimError: If there are fewer windows than a stage needs.
    """
    w = len(values)
    if not 1 <= shortest <= w or most < 1:
        raise SgimError(f"{w} windows cannot be cut into stages of {shortest} or more each")
    scatter = _scatter(values, shortest)
    costs = scatter[0, 1:].copy()  # of the first j windows cut into k stages, k = 1
    cuts: list[np.ndarray] = []
    while np.sqrt(costs[-1] / w) > tolerance and len(cuts) + 1 < most:
        # The last stage begins at i: what is before it has one stage fewer.
        ways = costs[:-1, None] + scatter[1:w, 2:]
        best = ways.argmin(axis=0)
        fewer = ways[best, np.arange(w - 1)]
        if not np.isfinite(fewer[-1]):
            break
        cuts.append(best + 1)
        costs = np.concatenate([[np.inf], fewer])
    ends = [w]
    for before in reversed(cuts):
        ends.append(int(before[ends[-1] - 2]))
    return [0, *reversed(ends)]


def _scatter(values: FloatArray, shortest: int) -> FloatArray:
    """Sums of squared distances from the mean of windows i to j - 1, infinite if too few."""
    w = len(values)
    sums = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    squares = np.concatenate([[0.0], np.cumsum((values**2).sum(axis=1))])
    start, end = np.arange(w + 1)[:, None], np.arange(w + 1)[None, :]
    count = end - start
    apart = ((sums[None] - sums[:, None]) ** 2).sum(axis=2)
    found = squares[None] - squares[:, None] - apart / np.maximum(count, 1)
    return np.where(count >= shortest, np.maximum(found, 0.0), np.inf)
