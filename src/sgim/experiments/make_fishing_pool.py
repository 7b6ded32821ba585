"""Explores the fishing world, for its benchmark goals and two of its demonstrators.

Run it as ``python -m sgim.experiments.make_fishing_pool POOL.npz``; it takes a quarter of an hour.
The pool is a large file that is not part of the package.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sgim import algorithms
from sgim.environments.fishing import FishingRod
from sgim.errors import SgimError
from sgim.spaces import FloatArray

SEED = 3000
RUNS = {"random": 6, "sagg-riac": 12}
MOVEMENTS = 10_000


@dataclass(frozen=True, eq=False)
class Pool:
    """Movements that learners tried and that landed the float.

    Attributes:
        policies: Shape ``(n, 25)``.
        landings: Where the float landed in m, shape ``(n, 2)``.
        learners: Which kind of learner made each, an index into ``RUNS``, shape ``(n,)``.
    """

    policies: FloatArray
    landings: FloatArray
    learners: np.ndarray[tuple[int], np.dtype[np.int64]]

    def of(self, learner: str) -> Pool:
        """The part that one kind of learner made."""
        rows = self.learners == list(RUNS).index(learner)
        return Pool(self.policies[rows], self.landings[rows], self.learners[rows])


def read_pool(path: str | Path) -> Pool:
    """Read a pool that `write_pool` wrote."""
    with np.load(path) as stored:
        return Pool(stored["policies"], stored["landings"], stored["learners"])


def write_pool(path: str | Path, pool: Pool) -> None:
    """Write a pool."""
    np.savez_compressed(
        path, policies=pool.policies, landings=pool.landings, learners=pool.learners
    )


def explore(learner: str, seed: int, movements: int) -> tuple[FloatArray, FloatArray]:
    """Let a learner explore the fast world at the usual noise.

    Returns:
        Policies and landings of the movements that landed, shapes ``(n, 25)`` and ``(n, 2)``.
    """
    world = FishingRod()
    made = algorithms.make(learner, world.task, seed=seed)
    policies, landings = [], []
    for number in range(movements):
        plan = made.ask()
        try:
            outcome = world.execute(plan.policy, None, np.random.default_rng([seed, number]))
        except SgimError as error:
            made.fail(plan, str(error))
            continue
        made.tell(plan, outcome)
        if "float" in outcome:
            policies.append(plan.policy)
            landings.append(outcome["float"])
    return np.array(policies), np.array(landings)


def main(path: str) -> None:
    """Explore with every learner, and write the pool."""
    parts: list[tuple[FloatArray, FloatArray]] = []
    learners: list[int] = []
    for index, (learner, runs) in enumerate(RUNS.items()):
        for run in range(runs):
            parts.append(explore(learner, SEED + run, MOVEMENTS))
            learners += [index] * len(parts[-1][0])
            print(f"{learner} {run}: {len(parts[-1][0])} of {MOVEMENTS} landed", flush=True)
    policies, landings = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    write_pool(path, Pool(policies, landings, np.array(learners)))


if __name__ == "__main__":
    main(sys.argv[1])
