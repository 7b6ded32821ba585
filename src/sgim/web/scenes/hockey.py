"""The air hockey table on the page, seen from above."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.environments.hockey import (
    MALLET_RADIUS,
    MALLET_STEP,
    PUCK_RADIUS,
    AirHockey,
    Shot,
)
from sgim.records import Outcome, Trajectory
from sgim.spaces import FloatArray
from sgim.web.scenes.base import (
    FRAMES_A_SECOND,
    Movement,
    Shape,
    ball,
    between,
    fixed,
)

_MALLET, _PUCK = 0, 1
_SHORTEST, _LONGEST = 0.2, 2.0  # four intervals of 0.05 to 0.5 s


class HockeyScene:
    """The table, whose mallet is drawn with the pointer; see `Scene`."""

    def __init__(self) -> None:
        self._table = AirHockey()
        self.task = self._table.task
        self.joints: tuple[str, ...] = ("x", "y")
        self.unit = "m"
        self.low, self.high = np.full(2, -1.0), np.full(2, 1.0)
        self.home: FloatArray = np.array([0.05, -0.75])
        self.shortest, self.longest = _SHORTEST, _LONGEST
        self.reset(self.home)

    def describe(self) -> dict[str, Any]:
        """What the page draws; see `Scene`."""
        still = [
            fixed("sheet", [[-1.05, -1.05, -0.03], [1.05, 1.05, -0.03]], "table"),
            *(
                fixed("line", [[x0, y0, 0], [x1, y1, 0]], "dark", 0.012)
                for x0, y0, x1, y1 in (
                    (-1.05, -1.05, -1.05, 1.05),
                    (-1.05, 1.05, 1.05, 1.05),
                    (1.05, 1.05, 1.05, -1.05),
                    (1.05, -1.05, -1.05, -1.05),
                )
            ),
        ]
        block = self._table.obstacle
        if block is not None:
            right = min(block.right, 1.05)
            places = [[block.left, block.bottom, 0], [right, block.top, 0.06]]
            still.append(fixed("block", places, "dark"))
        return {
            "view": {"kind": "flat", "centre": [0.0, 0.0], "size": [2.3, 2.3]},
            "points": ["mallet", "puck"],
            "handle": _MALLET,
            "tempo": 0.5,
            "planes": ["level"],
            "still": still,
            "moving": [
                ball(_MALLET, MALLET_RADIUS, "arm", 0.08),
                ball(_PUCK, PUCK_RADIUS, "float", 0.05),
            ],
        }

    def goal(self, kind: str, point: FloatArray) -> list[Shape]:
        """A spot on the far border."""
        x = float(point[0])
        return [
            fixed("ring", [[x, 1.0, 0.02]], "goal", 0.06),
            fixed("line", [[x, 1.0, 0.02], [x, 1.12, 0.02]], "goal", 0.015),
        ]

    def movement(self, policy: Any) -> Movement:
        """What a policy does; see `Scene`."""
        (shot,) = self._table.shots([policy])
        return self._movement(shot, self._table.execute(policy))

    def fit(self, trajectory: Trajectory) -> tuple[Any, float]:
        """The task's correspondence (eq. 3.7); see `Scene`."""
        assert self.task.primitive is not None
        return self.task.primitive.fit(trajectory)

    def led(self, trajectory: Trajectory, policy: Any) -> Movement:
        """What a person's movement does; see `Scene`."""
        outcome, shot = self._table.follow(trajectory)
        return self._movement(shot, outcome)

    def _movement(self, shot: Shot, outcome: Outcome) -> Movement:
        end = float(shot.times[-1])
        times = np.append(np.arange(0.0, end, 1 / FRAMES_A_SECOND), end)
        frames = np.zeros((len(times), 2, 3))
        when: FloatArray = np.arange(len(shot.mallet), dtype=np.float64) * MALLET_STEP
        frames[:, _MALLET, :2] = between(times, when, shot.mallet)
        frames[:, _PUCK, :2] = between(times, shot.times, shot.puck)
        return Movement(times, frames, outcome)

    def reset(self, joints: FloatArray) -> None:
        """The puck at its start, the mallet where it is; see `Scene`."""
        self._times = [0.0]
        self._path: list[FloatArray] = [np.array(joints, dtype=np.float64)]

    def held(self, joints: FloatArray) -> FloatArray:
        """The mallet; see `Scene`."""
        return np.append(joints, 0.0)

    def reach(self, target: FloatArray, joints: FloatArray) -> FloatArray:
        """The mallet goes where the pointer is; see `Scene`."""
        return np.clip(target[:2], self.low, self.high)

    def advance(self, joints: FloatArray, seconds: float) -> None:
        """Let the mallet follow, and the puck fly; see `Scene`."""
        self._times.append(self._times[-1] + max(seconds, 1e-4))
        self._path.append(np.clip(joints, self.low, self.high))

    def points(self) -> FloatArray:
        """Where mallet and puck are; see `Scene`."""
        places = np.zeros((2, 3))
        places[_MALLET, :2] = self._path[-1]
        places[_PUCK, :2] = self._table.puck_start
        if len(self._times) > 1 and self._times[-1] < self.longest + 4:
            _, shot = self._table.follow(
                Trajectory(self._times, self._path, self.joints, self.unit)
            )
            now = np.array([self._times[-1]])
            places[_PUCK, :2] = between(now, shot.times, shot.puck)[0]
        return places
