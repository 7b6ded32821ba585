"""Makes the simulated kinaesthetic demonstrations of the fishing world (demonstrator 3).

Run it as ``python -m sgim.experiments.make_fishing_kinaesthetic``.
There is no person at hand who leads the arm. Instead, minimum-jerk movements are searched whose
landings spread evenly over what can be reached: end postures and durations are drawn at random,
or near those that landed where few have. Fragile movements make bad demonstrations, so of
several in a tile the one is kept that lands closest to where it should when it is repeated with
noise, by the fast model and by the full one.
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
MOVEMENTS = 20_000
COUNT = 127
GRID = 14
SEVERAL = 24
STAGES = ((6, 2, 0), (1, 10, 2))
"""How many candidates a tile are kept, after how many repetitions by the fast and full model."""

SHORTEST, LONGEST = 0.8, 3.0
# The thesis's primitive gets no further than this share of its amplitudes at the end.
REACH = 0.88
# How far a movement is varied, as a share of the amplitudes and in s.
_VARIATION = 0.12


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
    """Movements that land in the goal box without noise, also where few do."""
    still = FishingRod(0.0)
    found: list[Candidate] = []
    tiles: defaultdict[tuple[int, int], list[Candidate]] = defaultdict(list)
    for number in range(movements):
        if number < movements / 10 or rng.random() < 0.2:
            end, duration = rng.uniform(-REACH, REACH, 6), rng.uniform(SHORTEST, LONGEST)
        else:
            # Near a movement of that tile, of some, which has the fewest.
            names = list(tiles)
            drawn = [names[i] for i in rng.choice(len(names), size=8)]
            few = tiles[min(drawn, key=lambda name: len(tiles[name]))]
            near = few[int(rng.integers(len(few)))]
            end = np.clip(near.end + _VARIATION * rng.standard_normal(6), -REACH, REACH)
            varied = near.duration + _VARIATION * rng.standard_normal()
            duration = float(np.clip(varied, SHORTEST, LONGEST))
        try:
            outcome = still.follow(reaching(HOME + end * AMPLITUDES, duration))
        except SgimError:
            continue
        if "float" in outcome and np.abs(outcome["float"]).max() < 1:
            found.append(Candidate(end, duration, outcome["float"]))
            column, row = np.floor((outcome["float"] + 1) / 2 * GRID).astype(int).tolist()
            tiles[column, row].append(found[-1])
    return found


def most_repeatable(
    found: Sequence[Candidate], rng: np.random.Generator
) -> list[tuple[float, Candidate]]:
    """For each tile, the candidate that misses least when it is repeated, and by how much.

    All candidates are repeated a little, and the best of them more often.
    """
    worlds = FishingRod(), FishingRod(fast=False)
    chosen = []
    for tile in by_tile(np.array([candidate.landing for candidate in found]), COUNT):
        several = [found[i] for i in rng.permutation(tile)[:SEVERAL].tolist()]
        for finalists, *often in STAGES:
            misses = np.array([miss(candidate, worlds, often, rng) for candidate in several])
            best = misses.argsort()[:finalists].tolist()
            several = [several[i] for i in best]
        chosen.append((float(misses[best[0]]), several[0]))
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
    print(f"{len(found)} of {MOVEMENTS} movements landed in the box", flush=True)
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
