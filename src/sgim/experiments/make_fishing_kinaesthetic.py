"""Makes the simulated kinaesthetic demonstrations of the fishing world (demonstrator 3).

Run it as ``python -m sgim.experiments.make_fishing_kinaesthetic``.
There is no person at hand who leads the arm. Instead, minimum-jerk movements are searched whose
landings spread evenly over what can be reached. Fragile movements make bad demonstrations, so in
each tile those are kept and varied that land closest to where they should when they are repeated
with noise; at the end, one of them is chosen by more repetitions, by the full model too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.fishing import FishingRod
from sgim.environments.fishing.demonstrators import KINAESTHETIC, write_recordings
from sgim.environments.fishing.movement import AMPLITUDES, HOME
from sgim.environments.fishing.reaching import reaching
from sgim.errors import SgimError
from sgim.experiments.even_spread import by_tile, mean_miss
from sgim.records import Demonstration, Outcome, Trajectory
from sgim.spaces import FloatArray
from sgim.streams import Streams

SEED = 4000
MOVEMENTS = 60_000
COUNT = 127
GRID = 13
SEVERAL = 4
REPETITIONS = (8, 2)
"""How often a movement that was kept is repeated by the fast and by the full model."""

DOUBTED = 8
"""How often a movement is repeated that would be kept after two repetitions: they may be lucky."""

SHORTEST, LONGEST = 0.8, 3.0
# The thesis's primitive gets no further than this share of its amplitudes at the end.
REACH = 0.88
# How far a movement is varied, as a share of the amplitudes and in s.
_VARIATION = 0.1


@dataclass(frozen=True, eq=False)
class Candidate:
    """A movement and where it lands.

    Attributes:
        end: Its last posture as shares of the amplitudes away from home, shape ``(6,)``.
        duration: In s.
        landing: Shape ``(2,)``, in m.
    """

    end: FloatArray
    duration: float
    landing: FloatArray

    @property
    def recording(self) -> Trajectory:
        """The movement as it is recorded."""
        return reaching(HOME + self.end * AMPLITUDES, self.duration)


def search(rng: np.random.Generator, movements: int) -> list[Candidate]:
    """Movements that land in the goal box, a few in each tile, those that repeat best so far.

    Each is made without noise, and twice with it, or more often before it is kept; new ones vary
    those that were kept.
    """
    still, noisy = FishingRod(0.0), FishingRod()
    kept: defaultdict[tuple[int, int], list[tuple[float, Candidate]]] = defaultdict(list)
    for number in range(movements):
        if number < movements / 10 or rng.random() < 0.1:
            end, duration = rng.uniform(-REACH, REACH, 6), rng.uniform(SHORTEST, LONGEST)
        else:
            # Of some tiles, the one whose best movement repeats worst.
            names = list(kept)
            drawn = [names[i] for i in rng.choice(len(names), size=3)]
            worst = kept[max(drawn, key=lambda name: kept[name][0][0])]
            near = worst[int(rng.integers(len(worst)))][1]
            end = np.clip(near.end + _VARIATION * rng.standard_normal(6), -REACH, REACH)
            varied = near.duration + _VARIATION * rng.standard_normal()
            duration = float(np.clip(varied, SHORTEST, LONGEST))
        try:
            outcome = still.follow(reaching(HOME + end * AMPLITUDES, duration))
        except SgimError:
            continue
        if "float" in outcome and np.abs(outcome["float"]).max() < 1:
            candidate = Candidate(end, duration, outcome["float"])
            column, row = np.floor((outcome["float"] + 1) / 2 * GRID).astype(int).tolist()
            tile = kept[column, row]
            missed = miss(candidate, [noisy], [2], rng)
            if len(tile) < SEVERAL or missed < tile[-1][0]:
                more = miss(candidate, [noisy], [DOUBTED - 2], rng)
                missed += (more - missed) * (DOUBTED - 2) / DOUBTED
                tile.append((missed, candidate))
                tile.sort(key=lambda pair: pair[0])
                del tile[SEVERAL:]
    return [candidate for tile in kept.values() for _, candidate in tile]


def most_repeatable(
    found: Sequence[Candidate], rng: np.random.Generator
) -> list[tuple[float, Candidate]]:
    """For each tile, the candidate that misses least when it is repeated, and by how much."""
    worlds = FishingRod(), FishingRod(fast=False)
    chosen = []
    for tile in by_tile(np.array([candidate.landing for candidate in found]), COUNT):
        misses = [miss(found[i], worlds, REPETITIONS, rng) for i in tile]
        best = int(np.argmin(misses))
        chosen.append((misses[best], found[tile[best]]))
    return chosen


def miss(
    candidate: Candidate,
    worlds: Sequence[FishingRod],
    often: Sequence[int],
    rng: np.random.Generator,
) -> float:
    """How far a candidate lands from where it should, in m, in the mean over repetitions.

    Args:
        candidate: The movement.
        worlds: Where it is repeated.
        often: How often in each of them.
        rng: For their noise.
    """
    recording = candidate.recording
    executions: list[Callable[[], Outcome]] = []
    for world, count in zip(worlds, often, strict=True):
        executions += [partial(world.follow, recording, rng)] * count
    return mean_miss(executions, candidate.landing)


def main(folder: Path) -> None:
    """Search, choose, and write the demonstrations."""
    streams = Streams(SEED)
    found = search(streams("search"), MOVEMENTS)
    print(f"{len(found)} of {MOVEMENTS} movements kept", flush=True)
    chosen = most_repeatable(found, streams("repeat"))
    kept = sorted(chosen, key=lambda pair: pair[0])[:COUNT]
    misses = np.array([miss for miss, _ in kept])
    print(f"{len(chosen)} tiles, {len(kept)} kept; repeated they miss by {misses.mean():.3f} m")
    shown = [
        Demonstration({"float": candidate.landing}, trajectory=candidate.recording)
        for _, candidate in sorted(kept, key=lambda pair: pair[1].landing.tolist())
    ]
    write_recordings(folder / KINAESTHETIC, shown)


if __name__ == "__main__":
    main(Path(environments.__file__).parent / "data")
