"""The fishing rod on the page: an arm, a rod, a line, and water."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.environments.fishing import FishingRod
from sgim.environments.fishing.leading import HIGH, LOW, LedArm
from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import FISHING, HOME
from sgim.records import Trajectory
from sgim.spaces import FloatArray
from sgim.web.scenes.base import Movement, Shape, ball, fixed, thinned, tube


class FishingScene:
    """The arm and the rod, led by the rod's tip or joint by joint; see `Scene`."""

    def __init__(self) -> None:
        self._rod = FishingRod(0.0)
        self._arm = LedArm()
        self.task = self._rod.task
        self._primitive = FISHING
        self.joints: tuple[str, ...] = JOINTS
        self.unit = "rad"
        self.low, self.high, self.home = LOW, HIGH, HOME
        self.shortest, self.longest = FISHING.timing.shortest, FISHING.timing.longest

    def describe(self) -> dict[str, Any]:
        """What the page draws; see `Scene`."""
        names = self._arm.names
        arm = [names.index(name) for name in ("link0", "link1", "link2", "rod0")]
        rod = [i for i, name in enumerate(names) if name.startswith("rod")]
        line = [i for i, name in enumerate(names) if name.startswith("line")]
        return {
            "view": {
                "kind": "perspective",
                "position": [1.75, -1.2, 1.15],
                "target": [0.0, 0.25, 0.2],
            },
            "points": list(names),
            "handle": line[0],
            "tempo": 0.5,
            "planes": ["camera", "level", "upright"],
            "still": [
                fixed("sheet", [[-1.1, -1.1, 0], [1.1, 1.1, 0]], "water"),
                fixed("pillar", [[0, 0, -0.02], [0, 0, 0.15]], "dark", 0.045),
            ],
            "moving": [
                tube(arm, 0.024, "arm"),
                tube([*rod, line[0]], 0.007, "rod"),
                tube([*line, len(names) - 1], 0.003, "line"),
                ball(len(names) - 1, 0.022, "float"),
            ],
        }

    def goal(self, kind: str, point: FloatArray) -> list[Shape]:
        """A ring on the water."""
        x, y = point
        return [
            fixed("ring", [[x, y, 0.004]], "goal", 0.06),
            fixed("spot", [[x, y, 0.004]], "goal", 0.02),
        ]

    def movement(self, policy: Any) -> Movement:
        """What a policy does; see `Scene`."""
        _, path = self._rod.positions(policy)
        return self._movement(path, self._rod.execute(policy))

    def fit(self, trajectory: Trajectory) -> tuple[Any, float]:
        """The task's correspondence (eq. 3.7); see `Scene`."""
        return self._primitive.fit(trajectory)

    def led(self, trajectory: Trajectory, policy: Any) -> Movement:
        """What a person's movement does; see `Scene`."""
        _, path = self._rod.positions_led(trajectory)
        return self._movement(path, self._rod.follow(trajectory))

    def _movement(self, path: FloatArray, outcome: Any) -> Movement:
        times: FloatArray = np.arange(len(path), dtype=np.float64) * self._rod.step
        wet = np.flatnonzero(path[:, -1, 2] <= 0.0)
        if len(wet):  # what comes after the landing does not count
            end = min(len(path), int(wet[0]) + round(0.4 / self._rod.step))
            times, path = times[:end], path[:end]
        return Movement(*thinned(times, path), outcome)

    def reset(self, joints: FloatArray) -> None:
        """Back home; the arm then goes where the joints are; see `Scene`."""
        self._arm.reset()
        if not np.allclose(joints, HOME):
            self._arm.advance(joints, 0.5)

    def held(self, joints: FloatArray) -> FloatArray:
        """The tip of a rod that does not bend; see `Scene`."""
        return self._arm.tip(joints)

    def reach(self, target: FloatArray, joints: FloatArray) -> FloatArray:
        """Inverse kinematics of the rod's tip; see `Scene`."""
        return self._arm.reach(target, joints)

    def advance(self, joints: FloatArray, seconds: float) -> None:
        """Let the arm follow; see `Scene`."""
        self._arm.advance(joints, seconds)

    def points(self) -> FloatArray:
        """Where the bodies are; see `Scene`."""
        return self._arm.positions()
