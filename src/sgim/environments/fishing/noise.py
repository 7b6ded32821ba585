"""What comes between the set-points that a policy asks for and those that the motors get."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sgim.environments.fishing.movement import HOME
from sgim.errors import SpaceError
from sgim.spaces import FloatArray

WANDER = 0.03
"""Standard deviation in rad of the wandering of each set-point, an Ornstein-Uhlenbeck process."""

WANDER_TIME = 0.15
"""Its time constant in s."""

GAIN = 0.03
"""Standard deviation of the relative error of how far each joint is sent from home."""

LONGEST_DELAY = 0.020
"""The commands come late by up to so many s."""

Path = Callable[[FloatArray], FloatArray]
"""Set-points in rad, shape ``(t, 6)``, at times in s, shape ``(t,)``."""


def commanded(
    path: Path, times: FloatArray, factor: float, rng: np.random.Generator | None
) -> FloatArray:
    """The set-points of one execution, disturbed if the factor is not 0.

    Raises:
        SpaceError: If noise has no generator.
    """
    if factor == 0:
        return path(times)
    if rng is None:
        raise SpaceError("a world with noise needs the trial's generator: pass rng=…")
    return disturbed(path, times, factor, rng)


def disturbed(path: Path, times: FloatArray, factor: float, rng: np.random.Generator) -> FloatArray:
    """The set-points of one noisy execution.

    The noise is small, but a line that is whipped makes much of it: outcomes scatter little
    after some policies, and widely after others.

    Args:
        path: The set-points that the movement asks for.
        times: Evenly spaced times from 0 in s, shape ``(t,)``.
        factor: Of all the noise; 1 for the amounts of this module.
        rng: The trial's generator.

    Returns:
        Shape ``(t, 6)``, in rad.
    """
    delay = factor * LONGEST_DELAY * rng.random()
    gains = 1.0 + factor * GAIN * rng.standard_normal(len(HOME))
    set_points = HOME + gains * (path(np.maximum(times - delay, 0.0)) - HOME)
    set_points[times < delay] = HOME
    return np.asarray(set_points + factor * _wandering(times, rng))


def _wandering(times: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Ornstein-Uhlenbeck processes that start at 0, shape ``(t, 6)``."""
    kept = float(np.exp(-(times[1] - times[0]) / WANDER_TIME))
    shocks = WANDER * np.sqrt(1 - kept**2) * rng.standard_normal((len(times) - 1, len(HOME)))
    # x_n = Σ keptⁿ⁻ᵏ shock_k as a running sum; over the longest movement it grows to e³⁰ only.
    grown = np.exp(times[1:, None] / WANDER_TIME)
    wandering = np.zeros((len(times), len(HOME)))
    wandering[1:] = np.cumsum(grown * shocks, axis=0) / grown
    return wandering
