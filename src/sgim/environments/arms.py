"""The arms that come with the library: named ones, and some drawn at random."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sgim.environments.arm import PlanarArm
from sgim.environments.obstacle_arm import ObstacleArm
from sgim.errors import SpaceError
from sgim.streams import Streams

DRAWN_ARMS = 16


def drawn_arm(number: int) -> PlanarArm:
    """An arm whose make-up is drawn at random: the same for the same number, always.

    Drawn are 2 to 60 joints, links equal or up to 10 % shorter each, how far the arm can curl (all
    joints at their limits turn the hand by 200° to 800°, no joint by more than 150°), noise of 0 to
    4 cm, a goal box from tight to twice the reach, and, one time in two, an obstacle.

    Args:
        number: Which arm, 0 or more.
    """
    rng = Streams(number)("environments/drawn arm")
    joints = round(float(np.exp(rng.uniform(math.log(2), math.log(60)))))
    curl = rng.uniform(200, 800)
    half = rng.uniform(0.8, 2.0)
    arm: dict[str, Any] = {
        "length_ratio": float(rng.uniform(0.9, 1.0)),
        "limit": math.radians(min(150.0, curl / joints)),
        "low": (-half, -half),
        "high": (half, half),
        "noise": float(rng.uniform(0.0, 0.04)),
    }
    if rng.random() < 0.5:
        return PlanarArm(joints, **arm)
    while True:
        centre = rng.uniform((-0.2, -0.8), (0.8, 0.8))
        try:
            return ObstacleArm(joints, centre=centre, radius=float(rng.uniform(0.1, 0.25)), **arm)
        except SpaceError:  # It would touch the stretched arm.
            continue


def _wide(joints: int, degrees: float) -> PlanarArm:
    return PlanarArm(joints, limit=math.radians(degrees), low=(-2.0, -2.0), high=(2.0, 2.0))


ARMS = {
    "2-tight": PlanarArm(2, limit=math.radians(150), low=(-1.0, -1.0)),
    "7-tight": PlanarArm(7),
    "7-wide": _wide(7, 60),
    "20-wide": _wide(20, 30),
    "50-wide": _wide(50, 15),
    "100-wide": _wide(100, 7.5),
    "obstacle": ObstacleArm(),
    **{f"drawn-{number}": drawn_arm(number) for number in range(DRAWN_ARMS)},
}
"""Named arms: by joints and goal box, tight or far larger than what can be reached; with an
obstacle; and drawn at random."""
