"""Makes the fishing world's demonstrators 1 and 2 from what SAGG-RIAC learners have tried.

Run it as ``python -m sgim.experiments.make_fishing_learned POOL.npz``; `make_fishing_pool` makes
the pool. Both have one movement in each of 127 tiles: demonstrator 1 one drawn at random,
demonstrator 2 that of ten which lands closest to where it should when it is repeated.
"""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.fishing import FishingRod
from sgim.environments.fishing.demonstrators import LEARNED, write_policies
from sgim.experiments.even_spread import by_tile, mean_miss
from sgim.experiments.make_fishing_pool import Pool, read_pool
from sgim.records import Demonstration
from sgim.streams import Streams

SEED = 5000
COUNT = 127
SEVERAL = 10
REPETITIONS = 8


def choose(
    pool: Pool, rng: np.random.Generator, *, count: int = COUNT, several: int = SEVERAL
) -> list[int]:
    """The most repeatable of ``several`` movements in each of ``count`` tiles, as indices."""
    world = FishingRod()
    tiles = by_tile(pool.landings, count)
    chosen = []
    for index in np.sort(rng.choice(len(tiles), count, replace=False)).tolist():
        drawn = rng.permutation(tiles[index])[:several].tolist()
        if len(drawn) == 1:
            chosen += drawn
            continue
        misses = [
            mean_miss(
                [partial(world.execute, pool.policies[i], None, rng)] * REPETITIONS,
                pool.landings[i],
            )
            for i in drawn
        ]
        chosen.append(drawn[int(np.argmin(misses))])
    return chosen


def main(pool_path: str, folder: Path) -> None:
    """Choose, and write both demonstrators."""
    streams = Streams(SEED)
    pool = read_pool(pool_path).of("sagg-riac")
    for demonstrator, several in ((1, 1), (2, SEVERAL)):
        chosen = choose(pool, streams("demonstrator", demonstrator), several=several)
        shown = [
            Demonstration({"float": pool.landings[i]}, policy=pool.policies[i]) for i in chosen
        ]
        write_policies(folder / LEARNED[demonstrator], shown)
        print(f"{len(shown)} demonstrations in {LEARNED[demonstrator]}")


if __name__ == "__main__":
    main(sys.argv[1], Path(environments.__file__).parent / "data")
