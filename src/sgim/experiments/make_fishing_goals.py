"""Makes the fishing world's benchmark goals from a pool of movements.

Run it as ``python -m sgim.experiments.make_fishing_goals POOL.npz``; `make_fishing_pool` makes
the pool.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.fishing.goals import GOALS_TABLE
from sgim.environments.make_data import one_point_per_tile
from sgim.environments.tables import write_table
from sgim.experiments.make_fishing_pool import RUNS, read_pool
from sgim.spaces import FloatArray

GOALS = 358
LEAST = 3


def tiled(landings: FloatArray) -> tuple[FloatArray, int]:
    """One landing in each tile reached three times or more, of about 358 square tiles.

    Args:
        landings: In m, shape ``(n, 2)``; those outside [-1, 1]² are left out.

    Returns:
        The goals, and how many tiles there are along each axis.
    """
    low = np.array([-1.0, -1.0])
    choices = [
        (one_point_per_tile(landings, low, np.full(2, 2 / n), (n, n), LEAST), n)
        for n in range(10, 31)
    ]
    return min(choices, key=lambda choice: abs(len(choice[0]) - GOALS))


def main(pool_path: str, folder: Path) -> None:
    """Write the goals."""
    pool = read_pool(pool_path)
    goals, along = tiled(pool.landings)
    runs = ", ".join(f"{count} {learner}" for learner, count in RUNS.items())
    comment = (
        "Made by: python -m sgim.experiments.make_fishing_pool POOL.npz\n"
        "and:     python -m sgim.experiments.make_fishing_goals POOL.npz\n"
        f"{len(goals)} of {along} x {along} tiles of [-1, 1] x [-1, 1] were reached {LEAST} times\n"
        f"or more by the {len(pool.landings)} movements of a pool ({runs} runs, configuration\n"
        "modern) that landed; the point reached nearest to the middle of each, in m."
    )
    write_table(folder / GOALS_TABLE, comment, ("x", "y"), goals, decimals=4)
    print(f"{len(goals)} goals from {len(pool.landings)} landings, {along} tiles along each axis")


if __name__ == "__main__":
    main(sys.argv[1], Path(environments.__file__).parent / "data")
