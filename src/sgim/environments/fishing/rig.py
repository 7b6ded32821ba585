"""An arm that moves a rod, by policies or by recorded movements, with noise on its commands."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Any

import numpy as np

from sgim.environments.base import Environment
from sgim.environments.fishing.model import JOINTS, Variant
from sgim.environments.fishing.noise import Path, commanded
from sgim.environments.fishing.simulator import Simulator
from sgim.errors import SpaceError
from sgim.primitives import ViaPoints
from sgim.records import Outcome, Trajectory
from sgim.spaces import FloatArray


class Rig(Environment):
    """Base of the fishing worlds, which differ in what is observed of a movement.

    Args:
        variant: The model to simulate.
        primitive: What policies mean.
        hold: How long the arm is held still at the end of a movement, in s.
        noise: Factor of the noise on the arm's commands: 1 for the amounts of
            `sgim.environments.fishing.noise`, 0 for none.

    Attributes:
        noise: As given.
        deterministic: Whether there is no noise.
        step: Time step of the simulation in s.

    Raises:
        SgimError: If MuJoCo is not installed.
        SpaceError: If the factor is negative.
    """

    def __init__(self, variant: Variant, primitive: ViaPoints, hold: float, noise: float) -> None:
        if not 0 <= noise < math.inf:
            raise SpaceError(f"noise is {noise}, expected a factor of 0 or more")
        self.noise = noise
        self.deterministic = noise == 0
        self._primitive = primitive
        self._hold = hold
        self._simulator = Simulator(variant)
        self.step = self._simulator.step

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy; bounds are not checked.

        Raises:
            SpaceError: If the policy is malformed, or noise has no generator.
            SgimError: If the simulation becomes unstable.
        """
        return self._observed(commanded(*self._movement(policy), self.noise, rng))

    def follow(self, trajectory: Trajectory, rng: np.random.Generator | None = None) -> Outcome:
        """Lead the arm along recorded angles of its joints, then hold it still.

        Raises:
            SpaceError: If the trajectory is of other joints or not in rad, or noise has no
                generator.
            SgimError: If the simulation becomes unstable.
        """
        path, duration = _recorded(trajectory)
        return self._observed(commanded(path, self._times(duration), self.noise, rng))

    def positions(self, policy: Any) -> tuple[tuple[str, ...], FloatArray]:
        """Where all bodies are during a movement without noise; see `Simulator.positions`."""
        path, times = self._movement(policy)
        return self._simulator.positions(path(times))

    def positions_led(self, trajectory: Trajectory) -> tuple[tuple[str, ...], FloatArray]:
        """As `positions`, for an arm that is led as in `follow`, without noise."""
        path, duration = _recorded(trajectory)
        return self._simulator.positions(path(self._times(duration)))

    def _movement(self, policy: Any) -> tuple[Path, FloatArray]:
        """The set-points that a policy asks for, and the times of the simulation's steps."""
        point = self._primitive.policy_space.check(policy, "policy")[None]
        duration = float(self._primitive.durations(point)[0])
        return lambda times: self._primitive.positions(point, times)[0], self._times(duration)

    def _times(self, duration: float) -> FloatArray:
        """Times of the steps of a movement that lasts ``duration`` and is then held."""
        steps = math.ceil((duration + self._hold) / self.step)
        return np.asarray(np.arange(steps) * self.step, dtype=np.float64)

    @abstractmethod
    def _observed(self, set_points: FloatArray) -> Outcome:
        """What comes of set-points in rad, one row a time step, shape ``(t, 6)``."""


def _recorded(trajectory: Trajectory) -> tuple[Path, float]:
    """The path of a recorded movement, and how long it lasts in s."""
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
