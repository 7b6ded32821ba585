"""Make the tables of benchmark goals: ``python -m sgim.environments.make_data``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import cast

import numpy as np

from sgim.environments.arm import ARMS, PlanarArm
from sgim.environments.benchmark_goals import THROWING_TABLE, arm_table
from sgim.environments.tables import write_table
from sgim.environments.throwing import PLACING_SPEED, ThrowingArm, flight, swing
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams

COMMAND = "python -m sgim.environments.make_data"
THROWING_TILES = (20, 15)
ARM_GOALS = 100
# Millions of movements reach all 300 tiles, some of them less than once in 25 000 movements; goals
# that rare would measure luck, so the pool is what a long random exploration finds.
_THROWING_POOL = 50_000
_ARM_POOL = 400_000
# A tile that one posture in 1000 reaches is part of what a short exploration can find.
_ARM_SHARE = 1 / 1000


def main(folder: Path) -> None:
    """Write all tables to ``folder``."""
    streams = Streams(0)
    box = cast(Box, ThrowingArm().task.outcome_spaces["throw"])
    pool = throwing_pool(streams("make_data/throwing"), _THROWING_POOL)
    goals = one_point_per_tile(pool, box.low, box.range / THROWING_TILES, THROWING_TILES, 2)
    comment = _tiled(goals, THROWING_TILES, len(pool), 2)
    _write(folder / THROWING_TABLE, goals, comment, ("distance", "height"))
    for name, arm in ARMS.items():
        if name.endswith("wide"):
            goals = even_disc(ARM_GOALS)
            comment = "points spread evenly over the disc of radius 1 m, most of it within reach."
        else:
            rng = streams(f"make_data/{name}")
            pool = arm.hands(rng.uniform(-arm.limit, arm.limit, (_ARM_POOL, arm.joints)))
            least = round(_ARM_SHARE * _ARM_POOL)
            goals, tiles = about(ARM_GOALS, pool, arm, least)
            comment = _tiled(goals, tiles, len(pool), least)
        _write(folder / arm_table(name), goals, comment, ("x", "y"))


def _tiled(goals: FloatArray, tiles: tuple[int, int], pool: int, least: int) -> str:
    return (
        f"{len(goals)} of {tiles[0]} x {tiles[1]} tiles of the box were reached {least} times or "
        f"more by {pool} movements;\nthe point reached nearest to the middle of each, in m."
    )


def _write(path: Path, goals: FloatArray, comment: str, columns: tuple[str, str]) -> None:
    write_table(path, f"Made by: {COMMAND}\n{comment}", columns, goals, decimals=6)
    print(f"{path.name}: {len(goals)} goals")


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
