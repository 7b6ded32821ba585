"""Movements as a person leads an arm: from home to another posture, smoothly and without detours.

They are minimum-jerk movements (Flash and Hogan 1985, *The coordination of arm movements*): all
joints set out and arrive together, and have one shape that is scaled to their ends.
"""

from __future__ import annotations

import math

import numpy as np

from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import HOME
from sgim.records import Trajectory
from sgim.spaces import FloatArray

RATE = 25.0
"""Samples a second, at least, of a recorded movement."""

MIRROR: FloatArray = np.array([-1.0, 1.0, 1.0, -1.0, 1.0, -1.0])
"""What a posture's angles from home are multiplied by to mirror it, left and right."""


def reaching(end: FloatArray, duration: float, shortest: float = 0.0) -> Trajectory:
    """The minimum-jerk movement from home to a posture, as it would be recorded.

    Args:
        end: The posture in rad, shape ``(6,)``.
        duration: In s.
        shortest: What the recording lasts at least, in s: after a quicker movement the arm is held
            still.
    """
    lasting = max(duration, shortest)
    times = np.linspace(0.0, lasting, math.ceil(lasting * RATE) + 1)
    share = np.minimum(times / duration, 1.0)
    way = share**3 * (10 - 15 * share + 6 * share**2)
    positions = HOME + way[:, None] * (end - HOME)
    # As exact as it is kept, so that it can be led again to where it landed.
    kept = positions.astype(np.float32).astype(np.float64)
    return Trajectory(times, kept, JOINTS, "rad")
