"""A planar arm that an obstacle stops: what it reaches has edges, and a near side and a far one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sgim.environments.arm import PlanarArm
from sgim.errors import SpaceError
from sgim.spaces import FloatArray

_STEPS = 64
_POSTURES_AT_ONCE = 256


class ObstacleArm(PlanarArm):
    """A planar arm with a round obstacle in its way.

    A movement goes from the stretched arm to the policy's posture, all joints in step. Where a
    link touches the obstacle on the way, the arm stays there.

    Args:
        joints: Number of joints.
        centre: Centre of the obstacle in m.
        radius: Its radius in m.
        **arm: As `PlanarArm` takes them: ``length_ratio``, ``limit``, ``low``, ``high``, ``noise``.

    Raises:
        SpaceError: If a number is out of its range, or the stretched arm touches the obstacle.
    """

    def __init__(
        self,
        joints: int = 5,
        *,
        centre: ArrayLike = (0.45, 0.35),
        radius: float = 0.15,
        **arm: Any,
    ) -> None:
        super().__init__(joints, **{"limit": math.radians(90), "low": (-1.0, -1.0), **arm})
        self.centre = np.array(centre, dtype=np.float64)
        self.radius = radius
        if self.centre.shape != (2,) or not 0 < radius < math.inf:
            raise SpaceError(
                f"obstacle at {centre!r} of radius {radius!r}, expected x, y and a positive number"
            )
        if self._touching(np.zeros((1, joints)))[0]:
            raise SpaceError(
                f"the stretched arm touches the obstacle at {self.centre.tolist()}; "
                "movements start there, so move the obstacle away from the x axis"
            )

    def without_noise(self) -> ObstacleArm:
        """The same arm and obstacle without noise."""
        return ObstacleArm(
            self.joints,
            centre=self.centre,
            radius=self.radius,
            length_ratio=self.length_ratio,
            limit=self.limit,
            low=self.goal_box.low,
            high=self.goal_box.high,
            noise=0.0,
        )

    def hands(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
    ) -> FloatArray:
        """Positions of the tip without noise where the movements end, in m, shape ``(n, 2)``."""
        postures = np.array(policies, dtype=np.float64)
        if postures.ndim == 2 and postures.shape[1] == self.joints:
            for start in range(0, len(postures), _POSTURES_AT_ONCE):
                some = postures[start : start + _POSTURES_AT_ONCE]
                some *= self._shares_of_the_way(some)[:, None]
        return super().hands(postures, contexts)

    def _shares_of_the_way(self, postures: FloatArray) -> FloatArray:
        """How much of each movement is made before the arm touches, in [0, 1], shape ``(n,)``."""
        shares = np.arange(1, _STEPS + 1) / _STEPS
        ways = postures[:, None, :] * shares[:, None]
        touching = self._touching(ways.reshape(-1, self.joints)).reshape(-1, _STEPS)
        first: FloatArray = np.where(touching.any(axis=1), touching.argmax(axis=1), _STEPS)
        return first / _STEPS

    def _touching(self, postures: FloatArray) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Whether any link of each posture is within the radius of the centre, shape ``(n,)``."""
        angles = np.cumsum(postures, axis=1)
        along = np.stack((np.cos(angles), np.sin(angles)), axis=-1)
        ends = np.cumsum(along * self.lengths[:, None], axis=1)
        to_centre = self.centre - (ends - along * self.lengths[:, None])
        nearest = np.clip((to_centre * along).sum(axis=-1), 0.0, self.lengths)
        gaps = to_centre - nearest[..., None] * along
        touching: np.ndarray[Any, np.dtype[np.bool_]] = (
            (gaps**2).sum(axis=-1) < self.radius**2
        ).any(axis=1)
        return touching
