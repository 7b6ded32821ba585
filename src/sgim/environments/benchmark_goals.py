"""Fixed goals to measure repertoires by, independent of any learning."""

from __future__ import annotations

import numpy as np

from sgim.environments.arms import ARMS
from sgim.environments.tables import read_table
from sgim.errors import unknown
from sgim.records import Goal

THROWING_TABLE = "throwing_goals.csv"
ACROBOT_TABLE = "acrobot_goals.csv"
PLACING_GOALS = 100
HOCKEY_GOALS = 41


def throwing_goals() -> list[Goal]:
    """Throws spread over what can be reached, then 100 angles spread evenly over the circle.

    The throws are one reached point in each of 20 x 15 tiles of the throwing box, where the tile
    was reached twice or more by a large pool of movements.
    """
    throws = [Goal("throw", point) for point in read_table(THROWING_TABLE)]
    angles = -np.pi + (np.arange(PLACING_GOALS) + 0.5) * 2 * np.pi / PLACING_GOALS
    return throws + [Goal("place", angles[k : k + 1]) for k in range(PLACING_GOALS)]


def hockey_goals() -> list[Goal]:
    """Every 0.05 m of the top border, from -1 to 1: 41 goals."""
    half = HOCKEY_GOALS // 2
    return [Goal("hit", np.array([k / half])) for k in range(-half, half + 1)]


def acrobot_goals() -> list[Goal]:
    """Positions, in m, spread over where policies that mostly push their hardest bring the tip."""
    return [Goal("tip", point) for point in read_table(ACROBOT_TABLE)]


def reachable_goals(name: str) -> list[Goal]:
    """About 100 positions spread over what an arm's hand reaches.

    For tight boxes, one in each tile that random postures reach often enough; for wide ones, the
    disc of the arm's length, whose rim is out of reach; for the others, one in each tile that
    curled postures reach.

    Args:
        name: A key of `ARMS`.

    Raises:
        UnknownNameError: If no arm has that name.
    """
    if name not in ARMS:
        raise unknown("arm", name, ARMS)
    return [Goal("hand", point) for point in read_table(arm_table(name))]


def arm_table(name: str) -> str:
    """Name of the table that holds an arm's goals."""
    return f"arm_goals_{name}.csv"
