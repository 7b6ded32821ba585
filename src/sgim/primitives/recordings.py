"""What fitting a primitive to a recording begins with: the right joints, units and durations."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from sgim.errors import SpaceError
from sgim.records import Trajectory
from sgim.spaces import FloatArray

_RADIANS = {"rad": 1.0, "deg": math.pi / 180}


def unit_factor(
    came: tuple[Sequence[str], str], wanted: tuple[Sequence[str], str], what: str = "trajectory"
) -> float:
    """By what positions are multiplied to have the unit wanted.

    Degrees are converted to radians and back; other units must be the same.

    Args:
        came: Names of the joints recorded, in any order, and the unit of their positions.
        wanted: Names of the joints expected, and the unit.
        what: What came, for the message.

    Raises:
        SpaceError: If the joints are others, or the unit is one that cannot be converted.
    """
    (joints, unit), (expected, target) = came, wanted
    says = f"{what} is of joints {', '.join(joints)} in {unit}, expected"
    if sorted(joints) != sorted(expected):
        missing = [joint for joint in expected if joint not in joints]
        lacks = f"; it lacks {', '.join(missing)}" if missing else ""
        raise SpaceError(f"{says} {', '.join(expected)} in {target}{lacks}")
    if unit == target:
        return 1.0
    if unit in _RADIANS and target in _RADIANS:
        return _RADIANS[unit] / _RADIANS[target]
    raise SpaceError(f"{says} {target}: convert the positions, or correct the unit's name")


def positions_of(trajectory: Trajectory, joints: Sequence[str], unit: str) -> FloatArray:
    """The positions of these joints, in their order and unit.

    Args:
        trajectory: A recording of exactly these joints, in any order.
        joints: Names of the joints wanted.
        unit: Unit wanted.

    Returns:
        Shape ``(n, joints)``.

    Raises:
        SpaceError: As `unit_factor`.
    """
    factor = unit_factor((trajectory.joints, trajectory.unit), (joints, unit))
    order = [trajectory.joints.index(joint) for joint in joints]
    return trajectory.positions[:, order] * factor


def with_sum(durations: FloatArray, end: float, longest: float) -> FloatArray:
    """The durations, slightly changed within [0, ``longest``] so that they add up to ``end``."""
    total = float(durations.sum())
    if total >= end:
        return durations * (end / total) if total > 0 else durations
    room = longest - durations
    share = (end - total) / max(float(room.sum()), end - total)
    filled: FloatArray = np.minimum(durations + share * room, longest)
    return filled
