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
_ARM_POOL = 100_000
_LEAST = 2


def main(folder: Path) -> None:
    """Write all tables to ``folder``."""
    streams = Streams(0)
    box = cast(Box, ThrowingArm().task.outcome_spaces["throw"])
    pool = throwing_pool(streams("make_data/throwing"), _THROWING_POOL)
    goals = one_point_per_tile(pool, box.low, box.range / THROWING_TILES, THROWING_TILES)
    _write(folder / THROWING_TABLE, goals, THROWING_TILES, len(pool), ("distance", "height"))
    for name, arm in ARMS.items():
        pool = arm_pool(arm, streams(f"make_data/{name}"), _ARM_POOL)
        goals, tiles = about(ARM_GOALS, pool, arm)
        _write(folder / arm_table(name), goals, tiles, len(pool), ("x", "y"))


def _write(
    path: Path, goals: FloatArray, tiles: tuple[int, int], pool: int, columns: tuple[str, str]
) -> None:
    comment = (
        f"Made by: {COMMAND}\n"
        f"{len(goals)} of {tiles[0]} x {tiles[1]} tiles of the box were reached {_LEAST} times or "
        f"more by {pool} movements;\nthe point reached nearest to the middle of each, in m."
    )
    write_table(path, comment, columns, goals, decimals=6)
    print(f"{path.name}: {len(goals)} goals, {tiles[0]} x {tiles[1]} tiles")


def throwing_pool(rng: np.random.Generator, count: int) -> FloatArray:
    """Where ``count`` random policies throw, shape ``(n ≤ count, 2)``; the others place."""
    policies = rng.random((count, 14))
    policies[:, ::2] = 10 * policies[:, ::2] - 5
    angles, speeds = swing(policies)
    thrown = np.abs(speeds) >= PLACING_SPEED
    return flight(angles[thrown], speeds[thrown])


def arm_pool(arm: PlanarArm, rng: np.random.Generator, count: int) -> FloatArray:
    """Where ``count`` postures reach, shape ``(count, 2)``.

    Half of the postures are uniform. Those of many joints all end close to each other; the other
    half, whose joints turn alike in runs, spread over what can be reached.
    """
    half = count // 2
    uniform = rng.uniform(-arm.limit, arm.limit, (count - half, arm.joints))
    return arm.hands(np.concatenate([_runs(rng, half, arm.joints, arm.limit), uniform]))


def _runs(rng: np.random.Generator, count: int, length: int, limit: float) -> FloatArray:
    """Rows of numbers within ± ``limit``, alike in 1 to 4 runs but for a little noise."""
    runs = rng.integers(1, 5, count)
    cuts = np.sort(rng.integers(0, length, (count, 3)), axis=1)
    cuts[np.arange(3) >= (runs - 1)[:, None]] = length
    run = (np.arange(length) >= cuts[:, :, None]).sum(axis=1)
    levels = rng.uniform(-1.2 * limit, 1.2 * limit, (count, 4))
    values = np.take_along_axis(levels, run, axis=1)
    values += rng.uniform(-0.1 * limit, 0.1 * limit, values.shape)
    return np.clip(values, -limit, limit)


def one_point_per_tile(
    pool: FloatArray, low: FloatArray, size: FloatArray, tiles: tuple[int, int]
) -> FloatArray:
    """For each tile with two points or more of the pool, the one nearest to its middle.

    Args:
        pool: Points, shape ``(n, 2)``; those outside of the tiles are left out.
        low: Lower corner of the tiles, shape ``(2,)``.
        size: Size of a tile, shape ``(2,)``.
        tiles: Number of tiles along each axis.

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
    chosen: FloatArray = points[order[first[counts >= _LEAST]]]
    return chosen


def about(count: int, pool: FloatArray, arm: PlanarArm) -> tuple[FloatArray, tuple[int, int]]:
    """Tile an arm's goal box with squares such that about ``count`` of them are reached."""
    box = arm.goal_box
    best, best_tiles = np.empty((0, 2)), (0, 0)
    for along in range(4, 41):
        size = box.range[0] / along
        tiles = (along, round(float(box.range[1] / size)))
        goals = one_point_per_tile(pool, box.low, box.range / tiles, tiles)
        if abs(len(goals) - count) < abs(len(best) - count):
            best, best_tiles = goals, tiles
    return best, best_tiles


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "data")
