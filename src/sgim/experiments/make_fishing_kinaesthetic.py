"""Makes the simulated kinaesthetic demonstrations of the fishing worlds (demonstrator 3).

Run it as ``python -m sgim.experiments.make_fishing_kinaesthetic``, or with ``fishing-floor`` behind
it for the world with a floor.
There is no person at hand who leads the arm. Instead, minimum-jerk movements are searched whose
landings spread evenly over what can be reached. Fragile movements make bad demonstrations, so in
each tile those are kept and varied that land closest to where they should when they are repeated
with noise; at the end, one of them is chosen by more repetitions, in the full model too.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.fishing import FishingFloor, FishingRod
from sgim.environments.fishing.demonstrators import FLOOR_RECORDINGS, RECORDINGS, write_recordings
from sgim.environments.fishing.floor import DURATION
from sgim.environments.fishing.movement import AMPLITUDES, HOME
from sgim.environments.fishing.reaching import reaching
from sgim.environments.fishing.rig import Rig
from sgim.errors import SgimError
from sgim.experiments.even_spread import by_tile, mean_miss
from sgim.records import Demonstration, Outcome, Trajectory
from sgim.spaces import FloatArray
from sgim.streams import Streams

SEVERAL = 4
"""Movements kept in each tile during the search."""

DOUBTED = 8
"""How often a movement is repeated that would be kept after two repetitions: they may be lucky."""

# The thesis's primitive gets no further than this share of its amplitudes at the end.
REACH = 0.88
# How far a movement is varied, as a share of the amplitudes and in s.
_VARIATION = 0.1


@dataclass(frozen=True)
class Search:
    """What is looked for, and where.

    Attributes:
        still: The world without noise.
        repeating: Worlds with noise by which one of several movements is chosen; the first is
            that of the search.
        repetitions: How often a movement is repeated in each of them to choose.
        kind: Kind of the outcome.
        low: Lower bounds of the outcomes wanted, in both coordinates.
        high: Upper bounds.
        grid: Tiles along each side during the search.
        shortest: Least duration of a movement in s.
        longest: Greatest duration in s.
        count: How many demonstrations to choose.
        movements: How many movements to try.
        seed: Of the search.
        file: Name of the file of the demonstrations.
    """

    still: Rig
    repeating: tuple[Rig, ...]
    repetitions: tuple[int, ...]
    kind: str
    low: float
    high: float
    grid: int
    shortest: float
    longest: float
    count: int
    movements: int
    seed: int
    file: str

    def shares(self, outcomes: FloatArray) -> FloatArray:
        """Where outcomes lie in the box wanted, as shares of its sides."""
        return (outcomes - self.low) / (self.high - self.low)


def rod_search() -> Search:
    """For the fishing rod: 127 landings, as the thesis has."""
    return Search(
        FishingRod(0.0),
        (FishingRod(), FishingRod(fast=False)),
        (8, 2),
        kind="float",
        low=-1.0,
        high=1.0,
        grid=13,
        shortest=0.8,
        longest=3.0,
        count=127,
        movements=60_000,
        seed=4000,
        file=RECORDINGS,
    )


def floor_search() -> Search:
    """For the floor: places spread over the camera's view."""
    return Search(
        FishingFloor(0.0),
        (FishingFloor(),),
        (6,),
        kind="ball",
        low=0.0,
        high=1.0,
        grid=6,
        shortest=DURATION,
        longest=DURATION,
        count=30,
        movements=1000,
        seed=4001,
        file=FLOOR_RECORDINGS,
    )


@dataclass(frozen=True, eq=False)
class Candidate:
    """A movement and where it lands.

    Attributes:
        end: Its last posture as shares of the amplitudes away from home, shape ``(6,)``.
        duration: In s.
        landing: Shape ``(2,)``, in the outcome's unit.
    """

    end: FloatArray
    duration: float
    landing: FloatArray

    @property
    def recording(self) -> Trajectory:
        """The movement as it is recorded."""
        return reaching(HOME + self.end * AMPLITUDES, self.duration)


def search(sought: Search, rng: np.random.Generator, movements: int) -> list[Candidate]:
    """Movements with outcomes wanted, a few in each tile, those that repeat best so far.

    Each is made without noise, and twice with it, or more often before it is kept; new ones vary
    those that were kept.
    """
    noisy = sought.repeating[:1]
    kept: defaultdict[tuple[int, int], list[tuple[float, Candidate]]] = defaultdict(list)
    for number in range(movements):
        if not kept or number < movements / 10 or rng.random() < 0.1:
            end = rng.uniform(-REACH, REACH, 6)
            duration = rng.uniform(sought.shortest, sought.longest)
        else:
            # Of some tiles, the one whose best movement repeats worst.
            names = list(kept)
            drawn = [names[i] for i in rng.choice(len(names), size=3)]
            worst = kept[max(drawn, key=lambda name: kept[name][0][0])]
            near = worst[int(rng.integers(len(worst)))][1]
            end = np.clip(near.end + _VARIATION * rng.standard_normal(6), -REACH, REACH)
            varied = near.duration + _VARIATION * rng.standard_normal()
            duration = float(np.clip(varied, sought.shortest, sought.longest))
        try:
            outcome = sought.still.follow(reaching(HOME + end * AMPLITUDES, duration))
        except SgimError:
            continue
        if sought.kind not in outcome:
            continue
        shares = sought.shares(outcome[sought.kind])
        if not ((shares > 0) & (shares < 1)).all():
            continue
        candidate = Candidate(end, duration, outcome[sought.kind])
        column, row = np.floor(shares * sought.grid).astype(int).tolist()
        tile = kept[column, row]
        missed = miss(sought.kind, candidate, noisy, [2], rng)
        if len(tile) < SEVERAL or missed < tile[-1][0]:
            more = miss(sought.kind, candidate, noisy, [DOUBTED - 2], rng)
            missed += (more - missed) * (DOUBTED - 2) / DOUBTED
            tile.append((missed, candidate))
            tile.sort(key=lambda pair: pair[0])
            del tile[SEVERAL:]
    return [candidate for tile in kept.values() for _, candidate in tile]


def most_repeatable(
    sought: Search, found: Sequence[Candidate], rng: np.random.Generator
) -> list[tuple[float, Candidate]]:
    """For each tile, the candidate that misses least when it is repeated, and by how much."""
    shares = sought.shares(np.array([candidate.landing for candidate in found]))
    chosen = []
    for tile in by_tile(2 * shares - 1, sought.count):
        misses = [
            miss(sought.kind, found[i], sought.repeating, sought.repetitions, rng) for i in tile
        ]
        best = int(np.argmin(misses))
        chosen.append((misses[best], found[tile[best]]))
    return chosen


def miss(
    kind: str,
    candidate: Candidate,
    worlds: Sequence[Rig],
    often: Sequence[int],
    rng: np.random.Generator,
) -> float:
    """How far a candidate lands from where it should, in the mean over repetitions.

    Args:
        kind: Kind of the outcome.
        candidate: The movement.
        worlds: Where it is repeated.
        often: How often in each of them.
        rng: For their noise.
    """
    recording = candidate.recording
    executions: list[Callable[[], Outcome]] = []
    for world, count in zip(worlds, often, strict=True):
        executions += [partial(world.follow, recording, rng)] * count
    return mean_miss(executions, candidate.landing, kind)


def main(sought: Search, folder: Path) -> None:
    """Search, choose, and write the demonstrations."""
    streams = Streams(sought.seed)
    found = search(sought, streams("search"), sought.movements)
    print(f"{len(found)} of {sought.movements} movements kept", flush=True)
    chosen = most_repeatable(sought, found, streams("repeat"))
    kept = sorted(chosen, key=lambda pair: pair[0])[: sought.count]
    misses = np.array([miss for miss, _ in kept])
    print(f"{len(chosen)} tiles, {len(kept)} kept; repeated they miss by {misses.mean():.3f}")
    shown = [
        Demonstration({sought.kind: candidate.landing}, trajectory=candidate.recording)
        for _, candidate in sorted(kept, key=lambda pair: pair[1].landing.tolist())
    ]
    write_recordings(folder / sought.file, shown, sought.kind)


if __name__ == "__main__":
    floor = sys.argv[1:] == ["fishing-floor"]
    main(floor_search() if floor else rod_search(), Path(environments.__file__).parent / "data")
