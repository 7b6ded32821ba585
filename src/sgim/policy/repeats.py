"""What trials of the same policy tell: how far outcomes differ by noise alone."""

from __future__ import annotations

import numpy as np

from sgim.spaces import FloatArray

_DIGITS = 9  # Policies that agree to so many are the same.


def repeats(inputs: FloatArray, outcomes: FloatArray) -> tuple[int, float]:
    """How often inputs were tried again, and the variance of what came of them.

    Args:
        inputs: Policies, followed by contexts, in the unit box, shape ``(t, n)``.
        outcomes: What each produced, shape ``(t, d)``.

    Returns:
        The number of trials beyond the first of each input, and the variance of the outcomes of
        equal inputs, all coordinates together; 0 if nothing was tried again.
    """
    _, group, sizes = np.unique(
        inputs.round(_DIGITS), axis=0, return_inverse=True, return_counts=True
    )
    group = group.reshape(-1)
    again = int((sizes - 1).sum())
    if not again:
        return 0, 0.0
    means = np.zeros((len(sizes), outcomes.shape[1]))
    np.add.at(means, group, outcomes)
    means /= sizes[:, None]
    return again, float(((outcomes - means[group]) ** 2).sum() / again)
