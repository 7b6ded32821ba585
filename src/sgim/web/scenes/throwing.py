"""The throwing arm on the page, seen from the side: x to the right, heights upward."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sgim.environments.throwing import GRAVITY, SHOULDER_HEIGHT, WALL, ThrowingArm, swing
from sgim.primitives import PiecewiseAcceleration
from sgim.records import Outcome, Trajectory
from sgim.spaces import Box, FloatArray, Space
from sgim.web.scenes.base import FRAMES_A_SECOND, Movement, Shape, ball, fixed, tube

_SHOULDER, _HAND, _BALL = 0, 1, 2
_ARM = 1.0
_STILL_TIME = 0.06
_STILL = 0.01


class ThrowingScene:
    """The arm, turned by its hand. What it throws is what the learner's nearest policy throws."""

    def __init__(self) -> None:
        self._world = ThrowingArm()
        self.task = self._world.task
        primitive = self.task.primitive
        assert isinstance(primitive, PiecewiseAcceleration)
        self._primitive = primitive
        self.joints = primitive.joints
        self.unit = primitive.unit
        self.low, self.high = np.array([-4 * math.pi]), np.array([4 * math.pi])
        self.home: FloatArray = np.zeros(1)
        self.shortest, self.longest = 0.2, primitive.segments * primitive.max_duration
        self._angle = 0.0

    def describe(self) -> dict[str, Any]:
        """What the page draws; see `Scene`."""
        return {
            "view": {"kind": "flat", "centre": [1.5, 2.6], "size": [18.5, 7.2]},
            "points": ["shoulder", "hand", "ball"],
            "handle": _HAND,
            "tempo": 1.0,
            "near": {"centre": [0.0, 1.0], "size": [3.4, 2.6]},
            "ends": "release",
            "planes": ["level"],
            "still": [
                fixed("line", [[-10.5, 0, 0], [WALL, 0, 0]], "dark", 0.05),
                fixed("line", [[WALL, 0, 0], [WALL, 6.5, 0]], "dark", 0.05),
                fixed("line", [[0, 0, -0.1], [0, SHOULDER_HEIGHT, -0.1]], "line", 0.06),
            ],
            "moving": [
                tube([_SHOULDER, _HAND], 0.07, "arm"),
                ball(_BALL, 0.13, "float"),
            ],
        }

    def goal(self, kind: str, point: FloatArray) -> list[Shape]:
        """Where to land and how high to fly, or the angle at which to place."""
        if kind == "place":
            angle = float(point[0])
            hand = [_ARM * math.cos(angle), SHOULDER_HEIGHT + _ARM * math.sin(angle), 0.0]
            return [
                fixed("line", [[0, SHOULDER_HEIGHT, 0.02], [*hand[:2], 0.02]], "goal", 0.03),
                fixed("ring", [hand], "goal", 0.2),
            ]
        x, height = point
        return [
            fixed("ring", [[x, 0, 0.02]], "goal", 0.25),
            fixed("line", [[x - 0.8, height, 0], [x + 0.8, height, 0]], "goal", 0.035),
            fixed("line", [[x, 0, 0], [x, height, 0]], "goal", 0.012),
        ]

    def fit(self, trajectory: Trajectory) -> tuple[FloatArray, float]:
        """The nearest policy; one that ends at rest if the arm was held still at the end.

        The world takes a ball to be placed only if the arm stops within 0.01 rad/s, which no
        hand and no least squares meet by themselves.
        """
        policy, residual = self._primitive.fit(trajectory)
        angles = trajectory.positions[:, 0]
        lately = trajectory.times >= trajectory.times[-1] - _STILL_TIME
        if float(np.ptp(angles[lately])) < _STILL:
            policy = _at_rest(policy, self.task.policy_space)
        return policy, residual

    def movement(self, policy: Any) -> Movement:
        """What a policy does; see `Scene`."""
        turned = self._primitive.trajectory(policy, FRAMES_A_SECOND)
        return self._flown(turned, policy)

    def led(self, trajectory: Trajectory, policy: Any) -> Movement:
        """The arm as it was led, and the ball as the learner's nearest policy throws it."""
        since = trajectory.times - trajectory.times[0]
        times = np.append(np.arange(0, since[-1], 1 / FRAMES_A_SECOND), since[-1])
        angles = np.interp(times, since, trajectory.positions[:, 0])
        return self._flown(Trajectory(times, angles[:, None], self.joints), policy)

    def _flown(self, turned: Trajectory, policy: Any) -> Movement:
        outcome: Outcome = self._world.execute(policy)
        arm = np.array([_places(angle) for angle in turned.positions[:, 0].tolist()])
        times = turned.times
        flight = _flight(policy) if "throw" in outcome else np.repeat(arm[-1:, _BALL], 12, axis=0)
        still = np.repeat(arm[-1:], len(flight), axis=0)
        still[:, _BALL] = flight
        after = times[-1] + np.arange(1, len(flight) + 1) / FRAMES_A_SECOND
        return Movement(np.append(times, after), np.concatenate([arm, still]), outcome)

    def reset(self, joints: FloatArray) -> None:
        """The ball in the hand; see `Scene`."""
        self._angle = float(joints[0])

    def held(self, joints: FloatArray) -> FloatArray:
        """The hand; see `Scene`."""
        return np.array(_places(float(joints[0]))[_HAND])

    def reach(self, target: FloatArray, joints: FloatArray) -> FloatArray:
        """The angle towards the pointer, turned no further than needed; see `Scene`."""
        wanted = math.atan2(float(target[1]) - SHOULDER_HEIGHT, float(target[0]))
        now = float(joints[0])
        angle = now + math.remainder(wanted - now, math.tau)
        return np.clip([angle], self.low, self.high)

    def advance(self, joints: FloatArray, seconds: float) -> None:
        """Turn the arm; see `Scene`."""
        self._angle = float(joints[0])

    def points(self) -> FloatArray:
        """Where shoulder, hand and ball are; see `Scene`."""
        return np.array(_places(self._angle))


def _places(angle: float) -> list[list[float]]:
    hand = [_ARM * math.cos(angle), SHOULDER_HEIGHT + _ARM * math.sin(angle), 0.0]
    return [[0.0, SHOULDER_HEIGHT, 0.0], hand, hand]


def _at_rest(policy: FloatArray, space: Space) -> FloatArray:
    """The policy, its accelerations changed as little as it takes to end at rest."""
    assert isinstance(space, Box)
    rest = policy.copy()
    for _ in range(5):  # again where a bound was met
        durations = rest[1::2]
        speed = float(rest[::2] @ durations)
        rest[::2] -= durations * (speed / max(float(durations @ durations), 1e-12))
        rest = space.clip(rest)
    return rest


def _flight(policy: Any) -> FloatArray:
    """Where the ball is while it flies, shape ``(n, 3)``."""
    angles, speeds = swing([policy])
    angle, speed = float(angles[0]), float(speeds[0])
    x, y = math.cos(angle), SHOULDER_HEIGHT + math.sin(angle)
    across, up = -speed * math.sin(angle), speed * math.cos(angle)
    duration = (up + math.sqrt(up * up + 2 * GRAVITY * y)) / GRAVITY
    t = np.append(np.arange(1 / FRAMES_A_SECOND, duration, 1 / FRAMES_A_SECOND), duration)
    flown = x + across * t
    flown = np.where(flown > WALL, 2 * WALL - flown, flown)
    return np.stack([flown, y + up * t - GRAVITY / 2 * t * t, np.zeros_like(t)], axis=1)
