"""How a policy becomes set-points of the joints: via points and Gaussian weights (eq. 3.6)."""

from __future__ import annotations

import numpy as np

from sgim.environments.fishing.model import HOME_DEGREES, JOINTS
from sgim.primitives import EvenlySpaced, ViaPoints
from sgim.spaces import Box, FloatArray

HOME: FloatArray = np.radians(HOME_DEGREES)
"""Angles of the joints at home in rad, shape ``(6,)``."""

AMPLITUDES: FloatArray = 0.7 * np.radians((120.0, 60.0, 60.0, 90.0, 60.0, 45.0))
"""How far a via point may be from home, either way, in rad, shape ``(6,)``."""


def joint_movements(via_points: int, shortest: float, longest: float) -> ViaPoints:
    """Movements of the six joints, of policies in the unit box.

    Each via point's weight is as wide as half the time between two of them.

    Args:
        via_points: For each joint, spread evenly over the movement.
        shortest: Least duration in s.
        longest: Greatest duration in s; if it is ``shortest``, policies have no number for it.
    """
    reach = Box(HOME - AMPLITUDES, HOME + AMPLITUDES, names=JOINTS, unit="rad")
    timing = EvenlySpaced(via_points, shortest, longest, width=0.5 / (via_points - 1))
    return ViaPoints(reach, timing, scaled=True)


FISHING = joint_movements(via_points=4, shortest=0.8, longest=3.0)
"""25 numbers, as chapter 3 has them: four via points a joint, and the duration."""
