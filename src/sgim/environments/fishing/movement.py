"""How a policy becomes set-points of the joints: via points and Gaussian weights (eq. 3.6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sgim.environments.fishing.model import HOME_DEGREES, JOINTS
from sgim.primitives import EvenlySpaced, ViaPoints
from sgim.spaces import Box, FloatArray

HOME: FloatArray = np.radians(HOME_DEGREES)
"""Angles of the joints at home in rad, shape ``(6,)``."""

AMPLITUDES: FloatArray = 0.7 * np.radians((120.0, 60.0, 60.0, 90.0, 60.0, 45.0))
"""How far a via point may be from home, either way, in rad, shape ``(6,)``."""


def via_point_path(points: FloatArray, duration: float, times: FloatArray) -> FloatArray:
    """Joint angles that pass by via points, spread evenly over the duration.

    Each via point has a Gaussian weight in time, as wide as half the time between two of them;
    the weights are normalised (eq. 3.6, with the sign of the exponent that decays). After the
    duration the last angles are held.

    Args:
        points: Shape ``(n, joints)``, in rad.
        duration: In s.
        times: In s from the start, shape ``(t,)``.

    Returns:
        Shape ``(t, joints)``, in rad.
    """
    gap = duration / (len(points) - 1)
    off = (np.minimum(times, duration) / gap)[:, None] - np.arange(len(points))
    # 2 · off² is (t - tᵢ)² over twice the square of the width, gap / 2.
    weights = np.exp(-2.0 * off**2)
    weights /= weights.sum(axis=1, keepdims=True)
    return np.asarray(weights @ points)


@dataclass(frozen=True)
class Encoding:
    """How the numbers of a policy are read: one via point after the other, then the duration.

    Attributes:
        via_points: For each of the six joints.
        shortest: Duration in s where its number is 0.
        longest: Duration in s where its number is 1; if it is ``shortest``, the duration is
            fixed and policies have no number for it.
    """

    via_points: int
    shortest: float
    longest: float

    @property
    def policy_space(self) -> Box:
        """The unit box of policies."""
        names = [f"{joint}_{i + 1}" for i in range(self.via_points) for joint in JOINTS]
        if self.longest > self.shortest:
            names.append("duration")
        return Box(0.0, 1.0, names=names)

    def duration(self, policy: FloatArray) -> float:
        """Duration of the movement in s."""
        return self.shortest + float(policy[-1]) * (self.longest - self.shortest)

    def path(self, policy: FloatArray, times: FloatArray) -> FloatArray:
        """Set-points of the joints in rad at these times in s, shape ``(t, 6)``."""
        numbers = policy[: len(JOINTS) * self.via_points].reshape(self.via_points, len(JOINTS))
        points = HOME + (2.0 * numbers - 1.0) * AMPLITUDES
        return via_point_path(points, self.duration(policy), times)


FISHING = Encoding(via_points=4, shortest=0.8, longest=3.0)
"""25 numbers, as chapter 3 has them: four via points a joint, and the duration."""

PRIMITIVE = ViaPoints(
    Box(HOME - AMPLITUDES, HOME + AMPLITUDES, names=JOINTS, unit="rad"),
    EvenlySpaced(FISHING.via_points, FISHING.shortest, FISHING.longest),
    scaled=True,
)
"""The same encoding as a task's primitive: it maps recorded movements to policies (eq. 3.7)."""
