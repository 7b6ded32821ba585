"""What fitting a primitive to a recording begins with: the right joints, units and durations."""

from __future__ import annotations

import math

import numpy as np

from sgim.errors import SpaceError
from sgim.records import Trajectory
from sgim.spaces import FloatArray

_RADIANS = {"rad": 1.0, "deg": math.pi / 180}


def positions_of(trajectory: Trajectory, joints: tuple[str, ...], unit: str) -> FloatArray:
    """The positions of these joints, in their order and unit.

    Degrees are converted to radians and back; other units must be the same.

    Args:
        trajectory: A recording of exactly these joints, in any order.
        joints: Names of the joints wanted.
        unit: Unit wanted.

    Returns:
        Shape ``(n, joints)``.

    Raises:
        SpaceError: If the recording is of other joints, or in a unit that cannot be converted.
    """
    came = f"trajectory is of joints {', '.join(trajectory.joints)} in {trajectory.unit}"
    if sorted(trajectory.joints) != sorted(joints):
        missing = [joint for joint in joints if joint not in trajectory.joints]
        lacks = f"; it lacks {', '.join(missing)}" if missing else ""
        raise SpaceError(f"{came}, expected {', '.join(joints)} in {unit}{lacks}")
    positions = trajectory.positions[:, [trajectory.joints.index(joint) for joint in joints]]
    if trajectory.unit == unit:
        return positions
    if trajectory.unit in _RADIANS and unit in _RADIANS:
        return positions * (_RADIANS[trajectory.unit] / _RADIANS[unit])
    raise SpaceError(
        f"{came}, expected {unit}: convert it, or correct the unit if only its name is wrong"
    )


def with_sum(durations: FloatArray, end: float, longest: float) -> FloatArray:
    """The durations, changed as little as it takes within [0, ``longest``] to add up to ``end``."""
    total = float(durations.sum())
    if total >= end:
        return durations * (end / total) if total > 0 else durations
    room = longest - durations
    share = (end - total) / max(float(room.sum()), end - total)
    return np.minimum(durations + share * room, longest)
