"""Makes the sounds by which vocal repertoires are measured, and writes their table.

Run it as ``python -m sgim.experiments.make_vocal_goals``.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.tables import write_table
from sgim.environments.vocal.classes import TYPES, types
from sgim.environments.vocal.goals import GOALS_TABLE
from sgim.environments.vocal.perception import SOUND
from sgim.environments.vocal.world import KIND, VocalTract
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams

POOL = 40_000
OF_EACH_TYPE = 12


def spread(sounds: FloatArray, count: int) -> FloatArray:
    """Some of the sounds, far from each other: the one nearest to the middle, then the farthest.

    Args:
        sounds: Shape ``(n, 6)``.
        count: How many.
    """
    distances = np.linalg.norm(sounds - sounds.mean(axis=0), axis=1)
    chosen = [int(distances.argmin())]
    nearest = np.full(len(sounds), np.inf)
    while len(chosen) < count:
        nearest = np.minimum(nearest, np.linalg.norm(sounds - sounds[chosen[-1]], axis=1))
        chosen.append(int(nearest.argmax()))
    return sounds[chosen]


def main(folder: Path) -> None:
    """Write the table to ``folder``."""
    world = VocalTract(noise=0.0)
    space = world.task.policy_space
    assert isinstance(space, Box)
    rng = Streams(0)("make_vocal_goals")
    pool = world.sounds(space.decode(rng.random((POOL, len(space.low)))))
    box = world.task.outcome_spaces[KIND]
    pool = pool[[box.contains(sound) for sound in pool]]
    kinds = types(pool)
    goals = [np.zeros((1, len(SOUND)))]
    for number, name in enumerate(TYPES):
        if name != "NN":
            goals.append(spread(pool[kinds == number], OF_EACH_TYPE))
    comment = (
        "Made by: python -m sgim.experiments.make_vocal_goals\n"
        f"silence, then {OF_EACH_TYPE} sounds of each other type of {POOL} uniformly random\n"
        "policies, each the farthest from those before it, within the box of sounds."
    )
    columns = [name.replace("(", "_").replace(")", "") for name in SOUND]
    write_table(folder / GOALS_TABLE, comment, columns, np.concatenate(goals), decimals=4)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(environments.__file__).parent / "data")
