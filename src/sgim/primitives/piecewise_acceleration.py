"""One joint driven by a sequence of constant accelerations (section 4.3.3.1 of the thesis)."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.errors import SpaceError
from sgim.primitives.recordings import positions_of
from sgim.primitives.segment_fit import angle_basis, refine, starting_durations
from sgim.records import Trajectory
from sgim.spaces import Box, FloatArray

_PARTS = ("acceleration", "duration")
_EXACT = 1e-9


class PiecewiseAcceleration:
    """Accelerations held for durations, from the angle 0 at rest.

    A policy is ``(acceleration_1, duration_1, acceleration_2, …)``, shape ``(2 · segments,)``.

    Args:
        segments: Number of accelerations.
        max_acceleration: Bound on each acceleration, either way, in rad/s².
        max_duration: Longest time an acceleration is held, in s.
        joint: The joint's name in trajectories.

    Attributes:
        policy_space: The box of policies.
        joints: The joint's name.
        unit: ``rad``.

    Raises:
        SpaceError: If a number is not positive.
    """

    def __init__(
        self,
        segments: int = 7,
        max_acceleration: float = 5.0,
        max_duration: float = 1.0,
        joint: str = "shoulder",
    ) -> None:
        if not (segments >= 1 and max_acceleration > 0 and max_duration > 0):
            raise SpaceError(
                f"segments={segments}, max_acceleration={max_acceleration}, "
                f"max_duration={max_duration}: expected positive numbers"
            )
        self.segments = segments
        self.max_acceleration = max_acceleration
        self.max_duration = max_duration
        self.joints: tuple[str, ...] = (joint,)
        self.unit = "rad"
        self.policy_space = Box(
            [-max_acceleration, 0.0] * segments,
            [max_acceleration, max_duration] * segments,
            names=[f"{what}_{k + 1}" for k in range(segments) for what in _PARTS],
            unit=["rad/s²", "s"] * segments,
        )

    def trajectory(self, policy: Any, rate: float) -> Trajectory:
        """The movement that a policy makes.

        Args:
            policy: Shape ``(2 · segments,)``, within the bounds.
            rate: Samples a second; the end of the movement is sampled as well.

        Raises:
            SpaceError: If the policy is malformed or lasts no time, or the rate is not positive.
        """
        point = self.policy_space.check(policy, "policy")
        durations = point[1::2]
        end = float(durations.sum())
        if not self.policy_space.contains(point) or end == 0:
            raise SpaceError(f"policy {point!r:.200} is outside its bounds, or lasts 0 s")
        if not 0 < rate < np.inf:
            raise SpaceError(f"rate is {rate}, expected a positive number of samples a second")
        times = np.arange(0.0, end, 1 / rate)
        # The end decides where a ball flies: it is kept even if it falls between two samples.
        times = np.append(times, end)
        angles = angle_basis(times, durations) @ point[::2]
        return Trajectory(times, angles[:, None], self.joints, self.unit)

    def fit(self, trajectory: Trajectory) -> tuple[FloatArray, float]:
        """The policy that best reproduces a recorded movement, by least squares.

        For given durations the angle is linear in the accelerations, so each start chooses
        durations and solves for the accelerations; both are then refined together within their
        bounds. The durations add up to the length of the recording.

        Args:
            trajectory: Angles of this primitive's joint, in rad or deg.

        Returns:
            The policy, shape ``(2 · segments,)``, and the root-mean-square residual in rad.

        Raises:
            SpaceError: If the trajectory is of other joints, in another unit, or longer than
                ``segments · max_duration``.
        """
        times, angles = self._check(trajectory)
        bounds = (self.max_acceleration, self.max_duration)
        best, residual = np.empty(0), np.inf
        for durations in starting_durations(times, angles, self.segments, *bounds):
            accelerations, durations = refine(times, angles, durations, *bounds)
            gap = angle_basis(times, durations) @ accelerations - angles
            rms = float(np.sqrt(np.mean(gap**2)))
            if rms < residual:
                residual = rms
                best = np.stack([accelerations, durations], axis=1).ravel()
            if residual < _EXACT:
                break
        return best, residual

    def _check(self, trajectory: Trajectory) -> tuple[FloatArray, FloatArray]:
        angles = positions_of(trajectory, self.joints, self.unit)
        times = trajectory.times - trajectory.times[0]
        longest = self.segments * self.max_duration
        if times[-1] > longest * (1 + 1e-9):
            raise SpaceError(
                f"trajectory lasts {times[-1]:g} s, but {self.segments} segments of at most "
                f"{self.max_duration:g} s can represent {longest:g} s: shorten it, or use more "
                "segments"
            )
        return times, angles[:, 0]
