"""Time adding to and asking `NearestNeighbours`, against one tree rebuilt on doubling.

The reference is "one k-d tree rebuilt on doubling, brute force over the newest": a k-d tree of
the first half of the points or more, and a plain numpy search through those added since.

Its cost grows through a cycle, from one doubling, at N / 2 points, to the next, at N. So every
structure is timed over that whole cycle: adding is the time of all N / 2 additions, rebuilding
and merging included, divided by their number; asking is the mean over stops evenly spaced in
the cycle, of the same queries at the same stops (the reference then searches N / 4 newest
points on average).

A second reference shows what the layout alone brings: the tree is rebuilt as seldom, but the
newest points are searched by the code of `NearestNeighbours` (its buffer holds N / 2 points).

Every answer is compared with brute force over all points. Exits with 1 if one differs, or if
the reference costs less than 20 times as much.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from sgim.memory.neighbours import NearestNeighbours

FloatArray = NDArray[np.float64]
Answer = tuple[FloatArray, NDArray[np.intp]]
NEIGHBOURS = (8, 20)
STOPS = 16
QUERIES_PER_STOP = 50
REQUIRED_RATIO = 20.0


class Structure(Protocol):
    """What is timed."""

    def add(self, point: FloatArray) -> None:
        """Add one point."""

    def query(self, point: FloatArray, k: int) -> Answer:
        """Find the k nearest points."""


class RebuiltOnDoubling:
    """The reference: one k-d tree rebuilt on doubling, brute force over the newest."""

    def __init__(self, dimension: int, first_tree: int) -> None:
        self.storage: FloatArray = np.empty((1024, dimension))
        self.count = 0
        self.in_tree = 0
        self.next_tree = first_tree
        self.tree: Any = None

    def add(self, point: FloatArray) -> None:
        """Add one point; rebuild the tree if that doubles the number of points."""
        if self.count == len(self.storage):
            self.storage = np.concatenate((self.storage, np.empty_like(self.storage)))
        self.storage[self.count] = point
        self.count += 1
        if self.count == self.next_tree:
            self.tree = cKDTree(self.storage[: self.count])
            self.in_tree = self.count
            self.next_tree = 2 * self.count

    def query(self, point: FloatArray, k: int) -> Answer:
        """Find the k nearest points."""
        distances, indices = self.tree.query(point, k)
        newest = self.storage[self.in_tree : self.count]
        if len(newest):
            new_distances = np.sqrt(((newest - point) ** 2).sum(axis=1))
            nearest = np.argpartition(new_distances, min(k, len(newest)) - 1)[:k]
            distances = np.concatenate((distances, new_distances[nearest]))
            indices = np.concatenate((indices, nearest + self.in_tree))
        order = np.lexsort((indices, distances))[:k]
        return distances[order], indices[order]


def brute_force(points: FloatArray, point: FloatArray, k: int) -> Answer:
    """The k nearest points, from every distance there is."""
    squares = (points[:, 0] - point[0]) ** 2 + (points[:, 1] - point[1]) ** 2
    # Ties at the k-th place are all kept until indices decide.
    near = np.flatnonzero(squares <= np.partition(squares, k - 1)[k - 1] * (1 + 1e-9))
    distances = np.sqrt(squares[near])
    order = np.lexsort((near, distances))[:k]
    return distances[order], near[order]


def time_cycle(
    structure: Structure, points: FloatArray, queries: FloatArray
) -> tuple[float, list[float], list[Answer]]:
    """Microseconds to add, microseconds to ask for each k, and all answers."""
    half = len(points) // 2
    for point in points[: half - 1]:
        structure.add(point)
    adding, done = 0.0, half - 1
    asking = [0.0] * len(NEIGHBOURS)
    answers: list[Answer] = []
    for stop, batch in enumerate(queries):
        upto = half + int((stop + 0.5) * (len(points) - half) / STOPS)
        begin = time.perf_counter()
        for point in points[done:upto]:
            structure.add(point)
        adding += time.perf_counter() - begin
        done = upto
        for i, k in enumerate(NEIGHBOURS):
            begin = time.perf_counter()
            found = [structure.query(query, k) for query in batch]
            asking[i] += time.perf_counter() - begin
            answers += found
    begin = time.perf_counter()
    for point in points[done:]:
        structure.add(point)
    adding += time.perf_counter() - begin
    return (
        1e6 * adding / (len(points) - half + 1),
        [1e6 * total / (STOPS * QUERIES_PER_STOP) for total in asking],
        answers,
    )


def expected_answers(points: FloatArray, queries: FloatArray) -> list[Answer]:
    """What brute force answers, in the order of `time_cycle`."""
    half = len(points) // 2
    answers = []
    for stop, batch in enumerate(queries):
        present = points[: half + int((stop + 0.5) * (len(points) - half) / STOPS)]
        farthest = [brute_force(present, query, max(NEIGHBOURS)) for query in batch]
        for k in NEIGHBOURS:
            answers += [(distances[:k], indices[:k]) for distances, indices in farthest]
    return answers


def main() -> int:
    """Run the benchmark and print a table; 0 if it holds what the module promises."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--points", type=int, default=1_000_000, help="N, where the cycle ends")
    parser.add_argument("--seed", type=int, default=0, help="seed of points and queries")
    options = parser.parse_args()
    if options.points < 10_000:
        parser.error(f"--points is {options.points}, expected at least 10000")

    rng = np.random.default_rng(options.seed)
    points = rng.random((options.points, 2))
    queries = rng.random((STOPS, QUERIES_PER_STOP, 2))
    half = options.points // 2
    structures: dict[str, Structure] = {
        "NearestNeighbours": NearestNeighbours(2),
        "reference: rebuilt on doubling": RebuiltOnDoubling(2, half),
        "same, our brute force": NearestNeighbours(2, buffer_size=half),
    }
    expected = expected_answers(points, queries)
    print(f"2-D, uniform, mean from {half} to {options.points} points; µs each")
    columns = ["add", *(f"query k={k}" for k in NEIGHBOURS)]
    columns += [f"add + query k={k}" for k in NEIGHBOURS] + ["ratio", "exact"]
    print(f"{'':32}" + "".join(f"{column:>18}" for column in columns))
    ours: list[float] = []
    worst, all_exact = np.inf, True
    for name, structure in structures.items():
        adding, asking, answers = time_cycle(structure, points, queries)
        both = [adding + time_to_ask for time_to_ask in asking]
        ours = ours or both
        ratio = min(theirs / own for theirs, own in zip(both, ours, strict=True))
        # The reference's distances may round otherwise than brute force does.
        same = np.array_equal if isinstance(structure, NearestNeighbours) else np.allclose
        exact = all(
            same(distances, right[0]) and np.array_equal(indices, right[1])
            for (distances, indices), right in zip(answers, expected, strict=True)
        )
        if name.startswith("reference"):
            worst = ratio
        all_exact = all_exact and exact
        figures = "".join(f"{figure:18.1f}" for figure in (adding, *asking, *both, ratio))
        print(f"{name:32}{figures}{'yes' if exact else 'NO':>18}", flush=True)
    print(
        f"{len(expected)} answers of each compared with brute force. Ratio: the smaller over k, "
        f"to NearestNeighbours; required of the reference: {REQUIRED_RATIO:g}"
    )
    return 0 if all_exact and worst >= REQUIRED_RATIO else 1


if __name__ == "__main__":
    sys.exit(main())
