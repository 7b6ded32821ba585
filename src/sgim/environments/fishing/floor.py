"""The world of the thesis's section 3.6: a ball that counts where it comes to rest on the floor."""

from __future__ import annotations

import numpy as np

from sgim.environments.fishing.model import BALL_RADIUS, FLOOR
from sgim.environments.fishing.movement import joint_movements
from sgim.environments.fishing.rig import Rig
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task

DURATION = 2.0
"""Of every movement, in s."""

MOVEMENTS = joint_movements(via_points=9, shortest=DURATION, longest=DURATION)
"""54 numbers: nine via points for each joint, spread over 2 s."""

HOLD = 2.0
"""How long the arm is held still before the ball is looked at, in s."""

VIEW_LOW = np.array([-0.5, 0.0])
VIEW_SIZE = 1.0
"""The camera sees a square of 1 m on the floor ahead of the base, from the corner `VIEW_LOW`."""

FAR = np.array([100.5, 0.5])
"""The outcome of a ball that is not at rest in view: 100 from the middle of the view."""

_RESTING_SPEED = 0.02
_TOUCHING = 0.003


class FishingFloor(Rig):
    """The arm and the rod above a floor, with a ball at the end of the line (section 3.6).

    The thesis gives this robot both 54 and 52 parameters; here there are 54, nine via points for
    each of six joints, and a fixed duration. The outcome ``ball`` is where the ball lies, in
    sides of the square that a camera sees, so that its view is [0, 1]². A ball that is still in
    the air, still rolls, or lies out of view has the outcome (100.5, 0.5), far from all that can
    be aimed at.

    Args:
        noise: Factor of the noise on the arm's commands, as in `FishingRod`.

    Attributes:
        task: 54 policy parameters, and the outcome ``ball``.
        deterministic: Whether there is no noise.

    Raises:
        SgimError: If MuJoCo is not installed.
        SpaceError: If the factor is negative.
    """

    def __init__(self, noise: float = 0.4) -> None:
        super().__init__(FLOOR, MOVEMENTS, HOLD, noise)
        assert FLOOR.floor is not None
        self._lying = FLOOR.floor + BALL_RADIUS
        self.task = Task(
            MOVEMENTS.policy_space,
            {"ball": Box([0, 0], [1, 1], names=("x", "y"), unit="views")},
            primitive=MOVEMENTS,
            tolerances={"ball": 0.02},
        )

    def _observed(self, set_points: FloatArray) -> Outcome:
        return {"ball": self._seen(*self._simulator.end(set_points))}

    def _seen(self, position: FloatArray, speed: float) -> FloatArray:
        """Where the camera sees a ball, from its position in m and speed in m/s."""
        seen: FloatArray = (position[:2] - VIEW_LOW) / VIEW_SIZE
        lies = position[2] < self._lying + _TOUCHING and speed < _RESTING_SPEED
        if lies and ((seen >= 0) & (seen <= 1)).all():
            return seen
        return FAR.copy()
