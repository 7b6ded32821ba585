"""Whether a difference, or the lack of one, could be chance.

P-values of ranks are exact, also with ties: with six runs of each, as with twenty, the normal
approximation claims more than the data say. Only large samples take it.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from sgim.errors import SgimError
from sgim.spaces import FloatArray
from sgim.statistics.effects import signed_ranks

Alternative = Literal["two-sided", "greater"]

_MOST_EXACT = 60
"""Runs in all up to which the distribution of ranks is computed exactly."""


def signed_rank_p(differences: ArrayLike, alternative: Alternative = "two-sided") -> float:
    """P-value of Wilcoxon's signed-rank test (1945), for runs that are paired.

    Args:
        differences: Of the pairs, shape ``(n,)``; zeros are left out, as Wilcoxon does.
        alternative: ``"greater"``: the differences tend to be positive.

    Returns:
        The p-value; 1 if all differences are 0.
    """
    ranks, signs = signed_ranks(differences)
    if not len(ranks):
        return 1.0
    if len(ranks) > _MOST_EXACT:
        from scipy.stats import wilcoxon

        # SciPy has no exact p-value for so many with ties.
        return float(wilcoxon(ranks * signs, alternative=alternative, method="approx").pvalue)
    doubled = np.rint(2 * ranks).astype(int)  # shared ranks are halves
    chances = np.zeros(doubled.sum() + 1)
    chances[0] = 1.0
    for rank in doubled:
        chances[rank:] = (chances[rank:] + chances[: len(chances) - rank]) / 2
        chances[:rank] /= 2
    return _tail(chances, int(doubled[signs > 0].sum()), alternative)


def mann_whitney_p(
    one: ArrayLike, other: ArrayLike, alternative: Alternative = "two-sided"
) -> float:
    """P-value of the test of Mann and Whitney (1947), for runs that are not paired.

    Args:
        one: Shape ``(n,)``, one or more.
        other: Shape ``(m,)``, one or more.
        alternative: ``"greater"``: those of ``one`` tend to be greater.
    """
    from scipy.stats import mannwhitneyu, rankdata

    first, second = np.asarray(one, dtype=np.float64), np.asarray(other, dtype=np.float64)
    if not len(first) or not len(second):
        raise SgimError("the test of Mann and Whitney needs one run or more on each side")
    n = len(first)
    if n + len(second) > _MOST_EXACT:
        # As many ties as there are runs leave SciPy without a spread to divide by.
        if np.ptp([*first, *second]) == 0:
            return 1.0
        found = mannwhitneyu(first, second, alternative=alternative, method="asymptotic")
        return float(found.pvalue)
    doubled = np.rint(2 * rankdata([*first, *second])).astype(int)
    ways = np.zeros((n + 1, doubled.sum() + 1))  # to choose k runs whose ranks have a sum
    ways[0, 0] = 1.0
    for rank in doubled:
        ways[1:, rank:] = ways[1:, rank:] + ways[:-1, : ways.shape[1] - rank]
    return _tail(ways[n] / comb(len(doubled), n), int(doubled[:n].sum()), alternative)


def not_higher_p(
    one: ArrayLike,
    other: ArrayLike,
    margin: float = 0.2,
    *,
    paired: bool,
    relative: bool = True,
) -> float:
    """P-value of not being higher: small if one is lower than the other, or higher by little.

    A test of non-inferiority, one-sided: that one is not higher by the margin, as for ratios in
    bioequivalence (Hauschke et al. 1999). To be higher by a share of the larger of the two is
    b ≤ (1 − margin) a, which is tested as it stands: no margin is estimated from the data.
    The test is Wilcoxon's of the pairs, or Mann and Whitney's.

    Args:
        one: Shape ``(n,)``.
        other: Shape ``(m,)``; with ``m == n`` if paired.
        margin: As a share of the larger, in (0, 1), or absolute, above 0.
        paired: Whether they belong together two by two.
        relative: Whether the margin is a share of the larger. Values must then not be negative.

    Raises:
        SgimError: If the margin or the values are not of that sort.
    """
    bound, second = less_margin(one, margin, relative), np.asarray(other, dtype=np.float64)
    if relative and second.min() < 0:
        raise SgimError("a relative margin needs values of 0 or more; pass relative=False")
    if paired:
        return signed_rank_p(second - bound, "greater")
    return mann_whitney_p(second, bound, "greater")


def equivalence_p(
    one: ArrayLike,
    other: ArrayLike,
    margin: float = 0.2,
    *,
    paired: bool,
    relative: bool = True,
) -> float:
    """P-value of equivalence: small if the two differ by less than the margin.

    Two one-sided tests (Schuirmann 1987): that one is not higher than the other by the margin, and
    not lower; the larger of the two p-values.

    Args:
        one: Shape ``(n,)``.
        other: Shape ``(m,)``; with ``m == n`` if paired.
        margin: As in `not_higher_p`, which tests each side.
        paired: Whether they belong together two by two.
        relative: Whether the margin is a share of the larger. Values must then not be negative.

    Raises:
        SgimError: If the margin or the values are not of that sort.
    """
    return max(
        not_higher_p(one, other, margin, paired=paired, relative=relative),
        not_higher_p(other, one, margin, paired=paired, relative=relative),
    )


def less_margin(values: ArrayLike, margin: float, relative: bool) -> FloatArray:
    """Values, less the margin: what another must exceed for them not to be higher than it.

    Args:
        values: Of any shape.
        margin: A share of the values, in (0, 1), or absolute, above 0.
        relative: Which of the two. Values must then not be negative.

    Raises:
        SgimError: If the margin or the values are not of that sort.
    """
    found = np.asarray(values, dtype=np.float64)
    if not margin > 0 or (relative and margin >= 1):
        below = ", a share below 1" if relative else ""
        raise SgimError(f"margin is {margin}, expected more than 0{below}, such as 0.2")
    if relative and found.min() < 0:
        raise SgimError("a relative margin needs values of 0 or more; pass relative=False")
    return (1 - margin) * found if relative else found - margin


def holm(p_values: Sequence[float]) -> list[float]:
    """P-values corrected for their number by Holm's step-down procedure (1979).

    Args:
        p_values: Of one family of tests, in any order.

    Returns:
        The corrected ones in the same order: those under a level are rejected by the procedure
        at that level, which errs in one or more of them with at most that probability.
    """
    corrected = [0.0] * len(p_values)
    largest = 0.0
    for step, index in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        largest = max(largest, min(1.0, (len(p_values) - step) * p_values[index]))
        corrected[index] = largest
    return corrected


def least_pairs(comparisons: int, level: float = 0.05) -> int:
    """How many pairs of runs Wilcoxon's two-sided test needs to be able to reject at all.

    Its smallest p-value with n pairs is 2 / 2ⁿ; Holm multiplies it by the number of comparisons.
    """
    pairs = 1
    while comparisons * 2.0 ** (1 - pairs) > level:
        pairs += 1
    return pairs


def _tail(chances: FloatArray, found: int, alternative: Alternative) -> float:
    """The p-value of a sum whose null distribution is given; two-sided by doubling."""
    greater = float(chances[found:].sum())
    if alternative == "greater":
        return min(1.0, greater)
    lower = float(chances[: found + 1].sum())
    return min(1.0, 2 * min(greater, lower))


def mean_vector_p(one: FloatArray, other: FloatArray) -> float:
    """P-value of Hotelling's T² test (1931): two samples of vectors have one mean.

    For two groups it is the multivariate analysis of variance (Krzanowski 1988).

    Args:
        one: Shape ``(n, d)``.
        other: Shape ``(m, d)``, with n + m ≥ d + 2.

    Raises:
        SgimError: If there are too few vectors for so many coordinates.
    """
    from scipy.stats import f

    (n, d), m = one.shape, len(other)
    freedom = n + m - d - 1
    if freedom < 1 or not m:
        raise SgimError(f"{n} and {m} vectors of {d} numbers are too few for Hotelling's test")
    gap = one.mean(axis=0) - other.mean(axis=0)
    scatter = [(x - x.mean(axis=0)).T @ (x - x.mean(axis=0)) for x in (one, other)]
    pooled = (scatter[0] + scatter[1]) / (n + m - 2)
    statistic = n * m / (n + m) * float(gap @ np.linalg.pinv(pooled) @ gap)
    return float(f.sf(statistic * freedom / (d * (n + m - 2)), d, freedom))
