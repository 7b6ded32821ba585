"""The world of the thesis's chapter 3: an arm with a fishing rod learns where the float lands."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sgim.environments.base import Environment
from sgim.environments.fishing.model import FAST, FULL, JOINTS
from sgim.environments.fishing.movement import FISHING, PRIMITIVE
from sgim.environments.fishing.noise import Path, commanded
from sgim.environments.fishing.simulator import Simulator
from sgim.errors import SpaceError
from sgim.records import Outcome, Trajectory
from sgim.spaces import Box, FloatArray
from sgim.task import Task

HOLD = 1.5
"""How long the arm is held still at the end of a movement, in s."""

TOLERANCE = 0.02
"""Distance in m below which a goal counts as reached."""


class FishingRod(Environment):
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
        if not 0 <= noise < math.inf:
            raise SpaceError(f"noise is {noise}, expected a factor of 0 or more")
        if not 1 <= widen < math.inf:
            raise SpaceError(f"widen is {widen}, expected a factor of 1 or more")
        self.noise = noise
        self.fast = fast
        self.widen = widen
        self.deterministic = noise == 0
        self._simulator = Simulator(FAST if fast else FULL)
        self.step = self._simulator.step
        self.rest: FloatArray = self._simulator.rest[:2].copy()
        self.task = Task(
            FISHING.policy_space,
            {"float": Box([-widen, -widen], [widen, widen], names=("x", "y"), unit="m")},
            primitive=PRIMITIVE,
            tolerances={"float": TOLERANCE / (2 * widen)},
        )

    def without_noise(self) -> FishingRod:
        """The same world without noise."""
        return FishingRod(0.0, fast=self.fast, widen=self.widen)

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy, shape ``(25,)``; bounds are not checked.

        Raises:
            SpaceError: If the policy is malformed, or noise has no generator.
            SgimError: If the simulation becomes unstable.
        """
        point = FISHING.policy_space.check(policy, "policy")
        return self._outcome(lambda times: FISHING.path(point, times), FISHING.duration(point), rng)

    def follow(self, trajectory: Trajectory, rng: np.random.Generator | None = None) -> Outcome:
        """Lead the arm along recorded angles of its joints, then hold it still.

        Raises:
            SpaceError: If the trajectory is of other joints or not in rad, or noise has no
                generator.
            SgimError: If the simulation becomes unstable.
        """
        path, duration = _recorded(trajectory)
        return self._outcome(path, duration, rng)

    def positions(self, policy: Any) -> tuple[tuple[str, ...], FloatArray]:
        """Where all bodies are during a movement without noise; see `Simulator.positions`."""
        point = FISHING.policy_space.check(policy, "policy")
        return self._simulator.positions(FISHING.path(point, self._times(FISHING.duration(point))))

    def positions_led(self, trajectory: Trajectory) -> tuple[tuple[str, ...], FloatArray]:
        """As `positions`, for an arm that is led as in `follow`, without noise."""
        path, duration = _recorded(trajectory)
        return self._simulator.positions(path(self._times(duration)))

    def _outcome(self, path: Path, duration: float, rng: np.random.Generator | None) -> Outcome:
        set_points = commanded(path, self._times(duration), self.noise, rng)
        landing = self._simulator.land(set_points)
        return {} if landing is None else {"float": landing}

    def _times(self, duration: float) -> FloatArray:
        """Times of the steps of a movement that lasts ``duration`` and is then held."""
        steps = math.ceil((duration + HOLD) / self.step)
        return np.asarray(np.arange(steps) * self.step, dtype=np.float64)


def _recorded(trajectory: Trajectory) -> tuple[Path, float]:
    """The set-points at given times of a recorded movement, and how long it lasts in s."""
    if trajectory.joints != JOINTS or trajectory.unit != "rad":
        raise SpaceError(
            f"trajectory is of joints {', '.join(trajectory.joints)} in {trajectory.unit}, "
            f"expected {', '.join(JOINTS)} in rad"
        )
    recorded = trajectory.times - trajectory.times[0]

    def path(times: FloatArray) -> FloatArray:
        columns = [np.interp(times, recorded, column) for column in trajectory.positions.T]
        return np.stack(columns, axis=1)

    return path, float(recorded[-1])
