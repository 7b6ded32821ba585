"""Makes the simulated kinaesthetic demonstrations of the fishing worlds (demonstrator 3).

Run it as ``python -m sgim.experiments.make_fishing_kinaesthetic``, or with ``fishing-floor`` behind
it for the world with a floor.
There is no person at hand who leads the arm. Instead, minimum-jerk movements are searched whose
landings spread evenly over what can be reached. As on the page where a person teaches, each is
mapped to the robot's primitive and replayed by the robot, and accepted or done again: in each tile
those are kept and varied whose replays with noise land closest to where the arm that was led had
landed; at the end, one of them is chosen by more replays, in the full model too.
"""

from __future__ import annotations

import math
import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.fishing import FishingFloor, FishingRod
from sgim.environments.fishing.demonstrators import FLOOR_RECORDINGS, RECORDINGS, write_recordings
from sgim.environments.fishing.floor import DURATION, MOVEMENTS
from sgim.environments.fishing.movement import AMPLITUDES, FISHING, HOME
from sgim.environments.fishing.reaching import MIRROR, reaching
from sgim.environments.fishing.rig import Rig
from sgim.errors import SgimError
from sgim.experiments.even_spread import by_tile, mean_miss
from sgim.primitives import ViaPoints
from sgim.records import Demonstration, Trajectory
from sgim.spaces import FloatArray
from sgim.streams import Streams

SEVERAL = 4
"""Movements kept in each tile during the search."""

REPLAYS = 8
"""How often a movement is replayed before it is kept."""

# Shares of the movements tried that are drawn anew, and that mirror one kept.
_NEW = 0.1
_MIRRORED = 0.1
# How far a movement is varied, as a share of the amplitudes and of the duration.
_LEAST_VARIATION = 0.01
_GREATEST_VARIATION = 0.2

Kept = dict[tuple[int, int], list[tuple[float, "Candidate"]]]
"""Tile → how far replays miss, and the movement, the best first."""


@dataclass(frozen=True)
class Search:
    """What is looked for, and where.

    Attributes:
        still: The world without noise, where the arm is led.
        primitive: What the robot maps a recording to.
        replaying: Worlds with noise, by which one of several movements is chosen; the first is
            that of the search.
        replays: How often a movement is replayed in each of them to choose.
        kind: Kind of the outcome.
        low: Lower bounds of the outcomes wanted, in both coordinates.
        high: Upper bounds.
        grid: Tiles along each side during the search.
        quickest: Least duration of a movement in s.
        slowest: Greatest duration in s.
        recorded: What a recording lasts at least, in s; after a quicker movement the arm is held
            still.
        count: How many demonstrations to choose.
        movements: How many movements to try.
        seed: Of the search.
        file: Name of the file of the demonstrations.
    """

    still: Rig
    primitive: ViaPoints
    replaying: tuple[Rig, ...]
    replays: tuple[int, ...]
    kind: str
    low: float
    high: float
    grid: int
    quickest: float
    slowest: float
    recorded: float
    count: int
    movements: int
    seed: int
    file: str

    def shares(self, outcomes: FloatArray) -> FloatArray:
        """Where outcomes lie in the box wanted, as shares of its sides."""
        return (outcomes - self.low) / (self.high - self.low)

    def recording(self, end: FloatArray, duration: float) -> Trajectory:
        """The movement to a posture, given as shares of the amplitudes away from home."""
        return reaching(HOME + end * AMPLITUDES, duration, self.recorded)


def rod_search() -> Search:
    """For the fishing rod: 127 landings, as the thesis has."""
    return Search(
        FishingRod(0.0),
        FISHING,
        (FishingRod(), FishingRod(fast=False)),
        (24, 4),
        kind="float",
        low=-1.0,
        high=1.0,
        grid=13,
        quickest=0.4,
        slowest=3.0,
        recorded=0.8,
        count=127,
        movements=27_500,
        seed=4000,
        file=RECORDINGS,
    )


def floor_search() -> Search:
    """For the floor: places spread over the camera's view."""
    return Search(
        FishingFloor(0.0),
        MOVEMENTS,
        (FishingFloor(),),
        (6,),
        kind="ball",
        low=0.0,
        high=1.0,
        grid=6,
        quickest=DURATION,
        slowest=DURATION,
        recorded=DURATION,
        count=30,
        movements=1000,
        seed=4001,
        file=FLOOR_RECORDINGS,
    )


@dataclass(frozen=True, eq=False)
class Candidate:
    """A movement that was led, and where it lands.

    Attributes:
        end: Its last posture as shares of the amplitudes away from home, shape ``(6,)``.
        duration: In s.
        recording: The movement as it is recorded.
        copy: The policy that the robot maps it to.
        landing: Shape ``(2,)``, in the outcome's unit.
    """

    end: FloatArray
    duration: float
    recording: Trajectory
    copy: FloatArray
    landing: FloatArray


def search(sought: Search, rng: np.random.Generator, movements: int) -> list[Candidate]:
    """Movements with outcomes wanted, a few in each tile, those that replay best so far."""
    kept: Kept = defaultdict(list)
    for _ in range(movements):
        fresh = not kept or rng.random() < _NEW
        candidate = led(sought, *(_new(sought, rng) if fresh else _varied(sought, kept, rng)))
        if candidate is None:
            continue
        column, row = np.floor(sought.shares(candidate.landing) * sought.grid).astype(int).tolist()
        tile = kept[column, row]
        worst = tile[-1][0] if len(tile) == SEVERAL else math.inf
        missed = miss(sought, candidate, (REPLAYS,), worst, rng)
        if len(tile) < SEVERAL or missed < worst:
            tile.append((missed, candidate))
            tile.sort(key=lambda pair: pair[0])
            del tile[SEVERAL:]
    return [candidate for tile in kept.values() for _, candidate in tile]


def led(sought: Search, end: FloatArray, duration: float) -> Candidate | None:
    """A movement without noise, if what comes of it is wanted."""
    recording = sought.recording(end, duration)
    try:
        outcome = sought.still.follow(recording)
    except SgimError:
        return None
    if sought.kind not in outcome:
        return None
    shares = sought.shares(outcome[sought.kind])
    if not ((shares > 0) & (shares < 1)).all():
        return None
    copy, _ = sought.primitive.fit(recording)
    return Candidate(end, duration, recording, copy, outcome[sought.kind])


def miss(
    sought: Search,
    candidate: Candidate,
    often: Sequence[int],
    least: float,
    rng: np.random.Generator,
) -> float:
    """How far replays with noise land from where the arm that was led did, in the mean.

    Args:
        sought: Where to replay.
        candidate: The movement.
        often: How often in each of the worlds.
        least: What need not be told apart from infinity, nor anything greater.
        rng: For the noise.
    """
    executions = [
        partial(world.execute, candidate.copy, None, rng)
        for world, count in zip(sought.replaying, often, strict=False)
        for _ in range(count)
    ]
    return mean_miss(executions, candidate.landing, sought.kind, least)


def most_repeatable(
    sought: Search, found: Sequence[Candidate], rng: np.random.Generator
) -> list[tuple[float, Candidate]]:
    """For each tile, the candidate whose replays miss least, and by how much."""
    shares = sought.shares(np.array([candidate.landing for candidate in found]))
    chosen = []
    for tile in by_tile(2 * shares - 1, sought.count):
        least, best = math.inf, found[tile[0]]
        for candidate in (found[i] for i in tile):
            missed = miss(sought, candidate, sought.replays, least, rng)
            if missed < least:
                least, best = missed, candidate
        chosen.append((least, best))
    return chosen


def _new(sought: Search, rng: np.random.Generator) -> tuple[FloatArray, float]:
    """An end and a duration drawn at random; short ones are as frequent as long ones."""
    slowest = math.log(sought.slowest / sought.quickest)
    return rng.uniform(-1.0, 1.0, 6), sought.quickest * math.exp(slowest * rng.random())


def _varied(sought: Search, kept: Kept, rng: np.random.Generator) -> tuple[FloatArray, float]:
    """An end and a duration near those of a movement kept, in any tile or in a bad one."""
    names = list(kept)
    drawn = [names[i] for i in rng.choice(len(names), size=3)]
    name = drawn[0] if rng.random() < 0.5 else max(drawn, key=lambda name: kept[name][0][0])
    near = kept[name][int(rng.integers(len(kept[name])))][1]
    end = near.end * (MIRROR if rng.random() < _MIRRORED else 1.0)
    far = math.log(_GREATEST_VARIATION / _LEAST_VARIATION)
    far = _LEAST_VARIATION * math.exp(far * rng.random())
    varied = near.duration * math.exp(far * rng.standard_normal())
    return (
        np.clip(end + far * rng.standard_normal(6), -1.0, 1.0),
        float(np.clip(varied, sought.quickest, sought.slowest)),
    )


def main(sought: Search, folder: Path) -> None:
    """Search, choose, and write the demonstrations."""
    streams = Streams(sought.seed)
    found = search(sought, streams("search"), sought.movements)
    print(f"{len(found)} of {sought.movements} movements kept", flush=True)
    chosen = most_repeatable(sought, found, streams("repeat"))
    kept = sorted(chosen, key=lambda pair: pair[0])[: sought.count]
    misses = np.array([miss for miss, _ in kept])
    print(f"{len(chosen)} tiles, {len(kept)} kept; replayed they miss by {misses.mean():.3f}")
    shown = [
        Demonstration({sought.kind: candidate.landing}, trajectory=candidate.recording)
        for _, candidate in sorted(kept, key=lambda pair: pair[1].landing.tolist())
    ]
    write_recordings(folder / sought.file, shown, sought.kind)


if __name__ == "__main__":
    floor = sys.argv[1:] == ["fishing-floor"]
    main(floor_search() if floor else rod_search(), Path(environments.__file__).parent / "data")
