"""How large a difference is, in words that need no unit."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from sgim.spaces import FloatArray


def signed_ranks(differences: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Ranks of the sizes of the differences that are not 0, ties sharing theirs, and their signs.

    Returns:
        Ranks and signs (1 or −1), of one length.
    """
    from scipy.stats import rankdata

    found = np.asarray(differences, dtype=np.float64)
    found = found[found != 0]
    return np.asarray(rankdata(np.abs(found))), np.sign(found)


def rank_biserial(differences: ArrayLike) -> float:
    """The matched-pairs rank-biserial correlation (Kerby 2014).

    Args:
        differences: Of pairs, shape ``(n,)``.

    Returns:
        Ranks in favour of positive differences minus those against, as a share of all: 1 if all
        are positive, −1 if all are negative, 0 if they balance or there are none but zeros.
    """
    ranks, signs = signed_ranks(differences)
    return float(ranks @ signs / ranks.sum()) if len(ranks) else 0.0


def probability_lower(one: ArrayLike, other: ArrayLike, *, paired: bool) -> float:
    """The probability of superiority, for errors: how often one is lower, ties counting half.

    Of unpaired runs it is the A of Vargha and Delaney (2000), over all pairs of a run of one with
    a run of the other; of paired ones, the share of the pairs.

    Args:
        one: Errors, shape ``(n,)``.
        other: Errors, shape ``(m,)``; with ``m == n`` if paired.
        paired: Whether the runs belong together two by two.
    """
    first, second = np.asarray(one), np.asarray(other)
    if not paired:
        first = first[:, None]
    return float(((first < second) + 0.5 * (first == second)).mean())
