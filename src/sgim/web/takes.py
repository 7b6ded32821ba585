"""Takes: movements that a person drew, and what they are worth to the learner."""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.errors import SgimError
from sgim.records import Demonstration, Trajectory
from sgim.spaces import FloatArray
from sgim.web.protocol import Assess, Assessed, Curves, GoalPoint
from sgim.web.scenes import Movement, Scene

RATE = 100.0
"""Samples a second that a take is brought to."""

KEPT = 200
"""Takes that are remembered."""

_SLACK = 1e-6
_FASTEST = 8.0


@dataclass(frozen=True, eq=False)
class Take:
    """A take that was assessed.

    Attributes:
        demonstration: What the learner would be given.
        raw: The samples as they were drawn.
    """

    demonstration: Demonstration
    raw: list[list[float]]


class Takes:
    """Assesses takes, and remembers them.

    Args:
        scene: The world they were led in.
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._kept: OrderedDict[str, Take] = OrderedDict()

    def get(self, name: str) -> Take | None:
        """The take of this name, if it was assessed."""
        return self._kept.get(name)

    def assess(self, asked: Assess) -> Assessed:
        """Say what a take reaches, and how well the learner's primitive can follow it."""
        try:
            trajectory = self.trajectory(asked.samples, asked.speed)
            return self._assessed(asked, trajectory)
        except (SgimError, ValueError) as error:
            return _refused(asked.take, str(error), self._scene.unit)

    def trajectory(self, samples: list[list[float]], speed: float) -> Trajectory:
        """A take as a movement of even samples, as long as movements can be.

        Raises:
            SgimError: If it is malformed, of too few samples, beyond the limits, or too long.
        """
        scene = self._scene
        width = 1 + len(scene.joints)
        if len(samples) < 3 or any(len(sample) != width for sample in samples):
            raise SgimError("nothing was drawn: begin to record, then lead the arm")
        if not 1 / _FASTEST <= speed <= _FASTEST:
            raise SgimError(f"speed is {speed:g}, expected 1/{_FASTEST:g} to {_FASTEST:g}")
        values = np.array(samples, dtype=np.float64)
        times, joints = (values[:, 0] - values[0, 0]) / speed, values[:, 1:]
        later = np.append(True, np.diff(times) > 0)
        if not (np.diff(times) >= 0).all() or later.sum() < 2:
            raise SgimError("the times of the samples do not increase")
        if (joints < scene.low - _SLACK).any() or (joints > scene.high + _SLACK).any():
            raise SgimError("a joint is beyond its limits")
        times, joints = times[later], np.clip(joints[later], scene.low, scene.high)
        if times[-1] > scene.longest:
            faster = math.ceil(10 * speed * times[-1] / scene.longest) / 10
            raise SgimError(
                f"it lasts {times[-1]:.1f} s, but movements last {scene.longest:g} s at most: "
                f"trim it, or play it {faster:g} times as fast"
            )
        if times[-1] < scene.shortest:  # then held still
            times, joints = np.append(times, scene.shortest), np.append(joints, joints[-1:], 0)
        count = max(3, round(times[-1] * RATE) + 1)
        even = np.linspace(0.0, times[-1], count)
        columns = [np.interp(even, times, column) for column in joints.T]
        return Trajectory(even, np.stack(columns, axis=1), scene.joints, scene.unit)

    def _assessed(self, asked: Assess, trajectory: Trajectory) -> Assessed:
        scene = self._scene
        policy, residual = scene.fit(trajectory)
        shown, fitted = scene.led(trajectory, policy), scene.movement(policy)
        outcome = {kind: np.asarray(point) for kind, point in shown.outcome.items()}
        problem = ""
        if outcome:
            demonstration = Demonstration(outcome, policy, trajectory)
            self._kept[asked.take] = Take(demonstration, asked.raw)
            self._kept.move_to_end(asked.take)
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        else:
            kinds = " or ".join(scene.task.outcome_spaces)
            problem = f"it ends without an outcome ({kinds}), so there is nothing to learn from it"
        return Assessed(
            take=asked.take,
            problem=problem,
            outcome={kind: point.tolist() for kind, point in outcome.items()},
            reached={kind: np.asarray(p).tolist() for kind, p in fitted.outcome.items()},
            distance=self._distance(outcome, asked.goal),
            residual=residual,
            unit=scene.unit,
            duration=float(trajectory.times[-1]),
            shown=shown.plain(),
            fitted=fitted.plain(),
            curves=self._curves(trajectory, policy, fitted),
        )

    def _distance(self, outcome: dict[str, FloatArray], goal: GoalPoint | None) -> float | None:
        """The distance in the unit box, at most 1, as the learner measures it."""
        if goal is None:
            return None
        if goal.kind not in outcome:
            return 1.0
        space = self._scene.task.goal_spaces[goal.kind]
        gap = space.encode(outcome[goal.kind]) - space.encode(np.array(goal.point))
        return min(1.0, float(np.linalg.norm(gap)))

    def _curves(self, trajectory: Trajectory, policy: Any, fitted: Movement) -> list[Curves]:
        primitive: Any = self._scene.task.primitive
        every = max(1, len(trajectory.times) // 80)
        times, shown = trajectory.times[::every], trajectory.positions[::every]
        follows = primitive.trajectory(policy, RATE)
        curves = []
        for i, joint in enumerate(trajectory.joints):
            follow = np.interp(times, follows.times, follows.positions[:, i])
            columns = (times, shown[:, i], follow)
            curves.append(Curves(joint, *(np.round(column, 4).tolist() for column in columns)))
        return curves


def _refused(take: str, problem: str, unit: str) -> Assessed:
    return Assessed(take, problem, {}, {}, None, 0.0, unit, 0.0, None, None, [])
