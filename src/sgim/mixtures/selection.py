"""How many components: fits compared by Akaike's information criterion."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from sgim.mixtures.expectation import fit
from sgim.mixtures.mixture import GaussianMixture
from sgim.spaces import FloatArray


def criterion(mixture: GaussianMixture, data: FloatArray) -> float:
    """Akaike's criterion (1974): twice the free parameters minus twice the log likelihood."""
    k, d = mixture.components, mixture.dimension
    free = k * (d + d * (d + 1) // 2) + k - 1
    return 2.0 * free - 2.0 * len(data) * mixture.log_likelihood(data)


def fit_by_criterion(
    data: FloatArray,
    numbers: Iterable[int],
    rng: np.random.Generator,
    *,
    floor: float = 1e-5,
    sweeps: int = 100,
) -> GaussianMixture:
    """The best fit of those with these numbers of components, the smaller in a tie.

    Args:
        data: The points, shape ``(n, d)``.
        numbers: Of components.
        rng: For the fits, in turn.
        floor: Variance added in every direction.
        sweeps: Most repetitions of EM in each.
    """
    fits = [fit(data, k, rng, floor=floor, sweeps=sweeps) for k in numbers]
    return min(fits, key=lambda mixture: criterion(mixture, data))
