"""The world of the thesis's chapter 3: an arm with a fishing rod learns where the float lands."""

from __future__ import annotations

import math

from sgim.environments.fishing.model import FAST, FULL
from sgim.environments.fishing.movement import FISHING
from sgim.environments.fishing.rig import Rig
from sgim.errors import SpaceError
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task

HOLD = 1.5
"""How long the arm is held still at the end of a movement, in s."""

TOLERANCE = 0.02
"""Distance in m below which a goal counts as reached."""


class FishingRod(Rig):
    """An arm of six joints with a rod, a line of 60 cm and a float, above water (section 3.2).

    The base is at (0, 0). A policy is 25 numbers in [0, 1]: four via points of the six joints, then
    the duration. The outcome ``float`` is the position (x, y) in m where the float first meets
    the water; it is absent if it never does while the arm moves and for 1.5 s after.

    Args:
        noise: Factor of the noise on the arm's commands: 1 for the amounts of
            `sgim.environments.fishing.noise`, 0 for none.
        fast: Whether to simulate the line by 8 segments instead of 30, at twice the time step:
            about a quarter of the time.
        widen: Factor by which the box of goals exceeds [-1, 1] in each dimension.

    Attributes:
        task: 25 policy parameters, and the outcome ``float``.
        deterministic: Whether there is no noise.
        rest: Where the float hangs at the start, (x, y) in m, shape ``(2,)``: a_org of eq. 3.8.
        step: Time step of the simulation in s.

    Raises:
        SgimError: If MuJoCo is not installed.
        SpaceError: If a factor is out of its range.
    """

    def __init__(self, noise: float = 0.4, *, fast: bool = True, widen: float = 1.0) -> None:
        if not 1 <= widen < math.inf:
            raise SpaceError(f"widen is {widen}, expected a factor of 1 or more")
        super().__init__(FAST if fast else FULL, FISHING, HOLD, noise)
        self.fast = fast
        self.widen = widen
        self.rest: FloatArray = self._simulator.rest[:2].copy()
        self.task = Task(
            FISHING.policy_space,
            {"float": Box([-widen, -widen], [widen, widen], names=("x", "y"), unit="m")},
            primitive=FISHING,
            tolerances={"float": TOLERANCE / (2 * widen)},
        )

    def without_noise(self) -> FishingRod:
        """The same world without noise."""
        return FishingRod(0.0, fast=self.fast, widen=self.widen)

    def _observed(self, set_points: FloatArray) -> Outcome:
        landing = self._simulator.land(set_points)
        return {} if landing is None else {"float": landing}
