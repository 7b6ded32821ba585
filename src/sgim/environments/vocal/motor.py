"""The motor system: two commands of nine, which the articulators follow with delay (eq. 5.1).

An overdamped mass on a spring is linear, so that a position is the neutral one and the two
commands, each weighed by a function of time alone.
"""

from __future__ import annotations

import numpy as np

from sgim.environments.vocal.anatomy import ARTICULATORS
from sgim.spaces import FloatArray

MOTORS = (*ARTICULATORS, "pressure", "voicing")
"""What is commanded: the articulators, then what makes the voice."""

NEUTRAL = np.array([0.0] * len(ARTICULATORS) + [-0.25, -0.25])
"""Where every vocalisation begins: without a voice."""

DURATION = 0.8
"""Of a vocalisation, in s."""

SECOND_COMMAND = 0.25
"""When the second command takes the first one's place, in s."""

_DAMPING = 1.01
_FREQUENCY = 2 * np.pi / DURATION


def weights(times: FloatArray) -> FloatArray:
    """By how much the neutral position, the first and the second command count.

    Args:
        times: In s, shape ``(t,)``.

    Returns:
        Shape ``(3, t)``; the three sum to 1.
    """
    first = _followed(times)
    second = _followed(times - SECOND_COMMAND)
    return np.array([1.0 - first, first - second, second])


def trajectories(policies: FloatArray, times: FloatArray) -> FloatArray:
    """Positions of the motors.

    Args:
        policies: The first commands, then the second, shape ``(n, 18)``.
        times: In s, shape ``(t,)``.

    Returns:
        Shape ``(9, t, n)``.
    """
    columns = np.ascontiguousarray(policies.T)[:, None, :]
    neutral, first, second = weights(times)[:, None, :, None]
    begun = neutral * NEUTRAL[:, None, None]
    path: FloatArray = begun + first * columns[: len(MOTORS)] + second * columns[len(MOTORS) :]
    return path


def _followed(times: FloatArray) -> FloatArray:
    """How far a motor at rest has followed a command given at time 0."""
    root = _FREQUENCY * np.sqrt(_DAMPING**2 - 1)
    slow, fast = root - _FREQUENCY * _DAMPING, -root - _FREQUENCY * _DAMPING
    late = np.maximum(times, 0.0)
    left = (fast * np.exp(slow * late) - slow * np.exp(fast * late)) / (fast - slow)
    followed: FloatArray = 1.0 - left
    return followed
