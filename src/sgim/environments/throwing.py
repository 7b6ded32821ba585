"""The world of the thesis's section 4.3.3: one joint throws a ball, or places it at an angle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.environments.base import Environment, Generators
from sgim.errors import SpaceError
from sgim.primitives import PiecewiseAcceleration
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task

GRAVITY = 9.81
WALL = 10.0
SHOULDER_HEIGHT = 1.0
PLACING_SPEED = 0.01


class ThrowingArm(Environment):
    """An arm of 1 m that turns about a shoulder 1 m above ground and lets a ball go.

    A policy is 7 angular accelerations in [-5, 5] rad/s² and 7 durations in [0, 1] s, from the
    angle 0 at rest: ``(acceleration_1, duration_1, …, acceleration_7, duration_7)``. If the arm
    ends slower than 0.01 rad/s, the ball is placed; else it is thrown.

    - ``throw``: (x in m where the ball lands, greatest height in m), eq. 4.5 to 4.7. The ball
      bounces elastically on a wall at x = 10. The greatest height is that of the flight, so the
      height of release for a ball that leaves downwards.
    - ``place``: (final angle in rad, wrapped to (-π, π]).

    Outcomes may lie outside their boxes: strong throws do.

    Args:
        tolerance: Factor of the distances within which goals count as reached.

    Attributes:
        task: 14 policy parameters; the outcomes ``throw`` and ``place``.
        deterministic: True.
    """

    def __init__(self, tolerance: float = 1.0) -> None:
        primitive = PiecewiseAcceleration(segments=7, max_acceleration=5.0, max_duration=1.0)
        self.deterministic = True
        self.task = Task(
            primitive.policy_space,
            {
                "throw": Box([-10, 0], [10, 6], names=("distance", "height"), unit="m"),
                "place": Box([-np.pi], [np.pi], names=("angle",), unit="rad"),
            },
            primitive=primitive,
            tolerances={"throw": 0.01 * tolerance, "place": 0.002 * tolerance},
            sizes={"throw": 6, "place": 1},
        )

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy, shape ``(14,)``; bounds are not checked.

        Raises:
            SpaceError: If the policy has another shape.
        """
        # Plain floats: a hot path, where an array of one would cost several times as much.
        # Every operation here has its twin in `swing` and `flight`, in the same order.
        array = np.asarray(policy, dtype=np.float64)
        if array.shape != (14,):
            self.task.policy_space.check(policy, "policy")
        values = array.tolist()
        angle = speed = 0.0
        for acceleration, duration in zip(values[::2], values[1::2], strict=True):
            gain = acceleration * duration
            angle += (speed + 0.5 * gain) * duration
            speed += gain
        if abs(speed) < PLACING_SPEED:
            return {"place": np.array([_wrap(angle)])}
        cosine, sine = math.cos(angle), math.sin(angle)
        release = SHOULDER_HEIGHT + sine
        rising = speed * cosine
        square = rising * rising
        height = release + square / (2 * GRAVITY) if rising > 0 else release
        time = (rising + math.sqrt(square + 2 * GRAVITY * release)) / GRAVITY
        distance = cosine - speed * sine * time
        return {"throw": np.array([2 * WALL - distance if distance > WALL else distance, height])}

    def execute_batch(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
        rngs: Generators | None = None,
    ) -> list[Outcome]:
        """Execute several policies, shape ``(n, 14)``; bounds are not checked.

        Raises:
            SpaceError: If the policies have another shape.
        """
        if len(policies) == 0:
            return []
        angles, speeds = swing(policies)
        throws = list(flight(angles, speeds))
        outcomes: list[Outcome] = [{"throw": throw} for throw in throws]
        for i in np.flatnonzero(np.abs(speeds) < PLACING_SPEED).tolist():
            outcomes[i] = {"place": np.array([_wrap(float(angles[i]))])}
        return outcomes


def swing(policies: Sequence[Any] | FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where and how fast movements end, in closed form segment by segment.

    Args:
        policies: Shape ``(n, 14)``.

    Returns:
        Final angles in rad (not wrapped) and angular speeds in rad/s, each of shape ``(n,)``.

    Raises:
        SpaceError: If the policies have another shape.
    """
    values = np.asarray(policies, dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != 14:
        raise SpaceError(f"policies have shape {values.shape}, expected (n, 14)")
    columns = np.ascontiguousarray(values.T)
    angles, speeds = np.zeros(len(values)), np.zeros(len(values))
    for accelerations, durations in zip(columns[::2], columns[1::2], strict=True):
        gains = accelerations * durations
        angles += (speeds + 0.5 * gains) * durations
        speeds += gains
    return angles, speeds


def flight(angles: FloatArray, speeds: FloatArray) -> FloatArray:
    """Where balls land, and how high they fly (eq. 4.5 to 4.7).

    Args:
        angles: Angles of release in rad, shape ``(n,)``.
        speeds: Angular speeds of release in rad/s, shape ``(n,)``.

    Returns:
        Landing x and greatest height, in m, shape ``(n, 2)``.
    """
    # `math`, not `np`: on some processors NumPy's vector sine differs in the last bit.
    values = angles.tolist()
    cosines = np.array([math.cos(x) for x in values])
    sines = np.array([math.sin(x) for x in values])
    release = SHOULDER_HEIGHT + sines
    rising = speeds * cosines
    square = rising * rising
    heights = np.where(rising > 0, release + square / (2 * GRAVITY), release)
    times = (rising + np.sqrt(square + 2 * GRAVITY * release)) / GRAVITY
    distances = cosines - speeds * sines * times
    landings = np.where(distances > WALL, 2 * WALL - distances, distances)
    return np.stack([landings, heights], axis=1)


def _wrap(angle: float) -> float:
    """The same angle in (-π, π]."""
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped == -math.pi else wrapped
