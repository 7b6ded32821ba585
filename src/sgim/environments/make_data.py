"""Make the tables of benchmark goals: ``python -m sgim.environments.make_data``."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import cast

import numpy as np

from sgim.environments.acrobot import Acrobot
from sgim.environments.arm import PlanarArm
from sgim.environments.arms import ARMS
from sgim.environments.benchmark_goals import ACROBOT_TABLE, THROWING_TABLE, arm_table
from sgim.environments.tables import write_table
from sgim.environments.throwing import PLACING_SPEED, ThrowingArm, flight, swing
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams

Made = tuple[FloatArray, str, tuple[str, str]]
"""Goals, shape ``(n, 2)``, how they were made, and the names of their coordinates."""

COMMAND = "python -m sgim.environments.make_data"
THROWING_TILES = (20, 15)
ARM_GOALS = 100
ACROBOT_TILES = 24
# Millions of movements reach all 300 tiles, some of them less than once in 25 000 movements; goals
# that rare would measure luck, so the pool is what a long random exploration finds.
_THROWING_POOL = 50_000
_ARM_POOL = 400_000
_ACROBOT_POOL = 10_000
# A tile that one posture in 1000 reaches is part of what a short exploration can find.
_ARM_SHARE = 1 / 1000
_CURLED_POOL = 100_000
_CURLED_LEAST = 20


def main(folder: Path) -> None:
    """Write the tables that ``folder`` lacks: those there are what results were measured by."""
    streams = Streams(0)
    makers: dict[str, Callable[[np.random.Generator], Made]] = {
        "throwing": _throwing,
        "acrobot": _acrobot,
        **{name: partial(_arm, name) for name in ARMS},
    }
    for name, make in makers.items():
        path = folder / {"throwing": THROWING_TABLE, "acrobot": ACROBOT_TABLE}.get(
            name, arm_table(name)
        )
        if path.exists():
            print(f"{path.name}: kept")
            continue
        goals, comment, columns = make(streams(f"make_data/{name}"))
        write_table(path, f"Made by: {COMMAND}\n{comment}", columns, goals, decimals=6)
        print(f"{path.name}: {len(goals)} goals")


def _throwing(rng: np.random.Generator) -> Made:
    box = cast(Box, ThrowingArm().task.outcome_spaces["throw"])
    pool = throwing_pool(rng, _THROWING_POOL)
    goals = one_point_per_tile(pool, box.low, box.range / THROWING_TILES, THROWING_TILES, 2)
    return goals, _tiled(goals, THROWING_TILES, len(pool), 2), ("distance", "height")


def _acrobot(rng: np.random.Generator) -> Made:
    pool, tiles = acrobot_pool(rng, _ACROBOT_POOL), (ACROBOT_TILES, ACROBOT_TILES)
    goals = one_point_per_tile(pool, np.full(2, -2.0), np.full(2, 4 / ACROBOT_TILES), tiles, 2)
    return goals, _tiled(goals, tiles, len(pool), 2), ("x", "y")


def _arm(name: str, rng: np.random.Generator) -> Made:
    arm = ARMS[name]
    if name.endswith("wide"):
        comment = "points spread evenly over the disc of radius 1 m, most of it within reach."
        return even_disc(ARM_GOALS), comment, ("x", "y")
    if name.endswith("tight"):
        pool = arm.hands(rng.uniform(-arm.limit, arm.limit, (_ARM_POOL, arm.joints)))
        least = round(_ARM_SHARE * _ARM_POOL)
    else:
        pool, least = arm.hands(_curled(rng, arm)), _CURLED_LEAST
    goals, tiles = about(ARM_GOALS, pool, arm, least)
    return goals, _tiled(goals, tiles, len(pool), least), ("x", "y")


def _curled(rng: np.random.Generator, arm: PlanarArm) -> FloatArray:
    """Postures whose joints lean the same way, or one half the other, shape ``(n, joints)``.

    Independent joints cancel each other out: with many of them, random postures are all alike.
    """
    ends = rng.uniform(-arm.limit, arm.limit, (_CURLED_POOL, 2))
    bends = rng.integers(0, arm.joints + 1, _CURLED_POOL)
    common = np.where(np.arange(arm.joints) < bends[:, None], ends[:, :1], ends[:, 1:])
    varied = common + rng.normal(0.0, 0.2 * arm.limit, common.shape)
    return np.clip(varied, -arm.limit, arm.limit)


def _tiled(goals: FloatArray, tiles: tuple[int, int], pool: int, least: int) -> str:
    return (
        f"{len(goals)} of {tiles[0]} x {tiles[1]} tiles of the box were reached {least} times or "
        f"more by {pool} movements;\nthe point reached nearest to the middle of each, in m."
    )


def even_disc(count: int) -> FloatArray:
    """Points spread evenly over the unit disc in a sunflower's spiral, shape ``(count, 2)``."""
    radii = np.sqrt((np.arange(count) + 0.5) / count)
    angles = np.arange(count) * (np.pi * (3 - np.sqrt(5)))
    points: FloatArray = radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
    return points


def throwing_pool(rng: np.random.Generator, count: int) -> FloatArray:
    """Where ``count`` random policies throw, shape ``(n ≤ count, 2)``; the others place."""
    policies = rng.random((count, 14))
    policies[:, ::2] = 10 * policies[:, ::2] - 5
    angles, speeds = swing(policies)
    thrown = np.abs(speeds) >= PLACING_SPEED
    return flight(angles[thrown], speeds[thrown])


def acrobot_pool(rng: np.random.Generator, count: int) -> FloatArray:
    """Where random policies that mostly push with all they can bring the tip, ``(count, 2)``."""
    acrobot = Acrobot()
    drawn = rng.uniform(-1.0, 1.0, (count, cast(Box, acrobot.task.policy_space).dimension))
    policies = np.sign(drawn) * np.abs(drawn) ** 0.2
    return np.array([acrobot.execute(policy, None, rng)["tip"] for policy in policies])


def one_point_per_tile(
    pool: FloatArray, low: FloatArray, size: FloatArray, tiles: tuple[int, int], least: int
) -> FloatArray:
    """For each tile with ``least`` points or more of the pool, the one nearest to its middle.

    Args:
        pool: Points, shape ``(n, 2)``; those outside of the tiles are left out.
        low: Lower corner of the tiles, shape ``(2,)``.
        size: Size of a tile, shape ``(2,)``.
        tiles: Number of tiles along each axis.
        least: How many points a tile must have.

    Returns:
        Shape ``(tiles reached, 2)``, tile by tile.
    """
    scaled = (pool - low) / size
    inside = ((scaled >= 0) & (scaled < tiles)).all(axis=1)
    points, scaled = pool[inside], scaled[inside]
    cells = np.floor(scaled)
    indices = (cells[:, 0] * tiles[1] + cells[:, 1]).astype(np.int64)
    off_middle = ((scaled - cells - 0.5) ** 2).sum(axis=1)
    order = np.lexsort((off_middle, indices))
    _, first, counts = np.unique(indices[order], return_index=True, return_counts=True)
    chosen: FloatArray = points[order[first[counts >= least]]]
    return chosen


def about(
    count: int, pool: FloatArray, arm: PlanarArm, least: int
) -> tuple[FloatArray, tuple[int, int]]:
    """Tile an arm's goal box with squares such that about ``count`` of them are reached."""
    box = arm.goal_box
    best, best_tiles = np.empty((0, 2)), (0, 0)
    for along in range(4, 41):
        size = box.range[0] / along
        tiles = (along, round(float(box.range[1] / size)))
        goals = one_point_per_tile(pool, box.low, box.range / tiles, tiles, least)
        if abs(len(goals) - count) < abs(len(best) - count):
            best, best_tiles = goals, tiles
    return best, best_tiles


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "data")
