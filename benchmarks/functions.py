"""Learners on functions from policies to outcomes that no choice of the library was made on.

Run it as ``python benchmarks/functions.py [NAME …] [--configurations modern …]``. Each function is
awkward in its own way: many coordinates, jumps, outcomes that are seldom produced, a huge goal box,
units of all sizes, noise. Printed is the median over seeds of the mean distance from goals to what
the learner's answers produce without noise, after some movements. The 100 goals are outcomes of
random policies that are far from each other.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np

import sgim
from sgim.records import Goal
from sgim.runs.benchmark import Benchmark
from sgim.streams import Streams

FIXED = np.random.default_rng(99)
A, B = FIXED.normal(size=(3, 20)) / 20**0.5, FIXED.normal(size=(20, 20)) / 20**0.5
C = FIXED.normal(size=(6, 12)) / 12**0.5


class Function:
    """A world made of a function, which gives None where nothing is produced."""

    def __init__(
        self,
        function: Callable[[Any], Any],
        policy: int,
        outcome: int,
        *,
        noise: float = 0.0,
        box: float = 1.0,
        reach: float = 1.0,
    ) -> None:
        self.function, self.noise, self.deterministic = function, noise, noise == 0
        self.made = policy, outcome, box, reach
        self.task = sgim.Task(
            sgim.Box(np.full(policy, -reach), np.full(policy, reach)),
            {"outcome": sgim.Box(np.full(outcome, -box), np.full(outcome, box))},
        )

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> dict[str, Any]:
        """What a policy produces."""
        found = self.function(np.asarray(policy))
        if found is None:
            return {}
        drawn = rng.normal(0, self.noise, len(found)) if self.noise else 0.0
        return {"outcome": np.asarray(found, dtype=np.float64) + drawn}

    def still(self) -> Function:
        """The same without noise."""
        policy, outcome, box, reach = self.made
        return Function(self.function, policy, outcome, box=box, reach=reach)

    def goals(self, count: int = 100) -> list[Goal]:
        """Outcomes of random policies, each as far as can be from those before."""
        rng, still = np.random.default_rng(5), self.still()
        drawn = [still.execute(self.task.policy_space.sample(rng)) for _ in range(20_000)]
        space = self.task.outcome_spaces["outcome"]
        points = np.array([o["outcome"] for o in drawn if o and space.contains(o["outcome"])])
        scaled = points / points.std(axis=0)
        chosen, apart = [0], ((scaled - scaled[0]) ** 2).sum(axis=1)
        while len(chosen) < count:
            chosen.append(int(apart.argmax()))
            apart = np.minimum(apart, ((scaled - scaled[chosen[-1]]) ** 2).sum(axis=1))
        return [Goal("outcome", points[i]) for i in chosen]


def smooth(p: Any) -> Any:
    return np.tanh(1.5 * A @ np.sin(3 * B @ p))


def jumping(p: Any) -> Any:
    return [0.5 * p[0] + 0.5 * np.sign(p[1] * p[2]), 0.7 * p[3] + 0.3 * np.sign(p[0] - p[4])]


def seldom(p: Any) -> Any:
    if np.abs(p[:3] - 0.6).max() > 0.35:
        return None
    return [(p[3] + p[4] * p[5]) / 2, (p[6] - p[7]) / 2]


def ring(p: Any) -> Any:
    angle, radius = np.pi * (p[0] + 0.5 * p[1]), 0.8 + 0.1 * p[2]
    return [radius * np.cos(angle), radius * np.sin(angle)]


def units(p: Any) -> Any:
    return [1000 * p[0] * p[1] + 500 * p[2], 2000 * (p[3] + 0.2 * np.sin(5 * p[4]))]


def waves(p: Any) -> Any:
    return [np.sin(9 * p[0]) * p[1], 0.8 * np.cos(7 * p[2] + 4 * p[3])]


def step(p: Any) -> Any:
    return np.tanh(p[:3] * [1 / 50, 1 / 500, 1 / 5] + 0.3 * np.sin(p[3:6] / 30))


FUNCTIONS = {
    "smooth": Function(smooth, 20, 3),
    "smooth-noise": Function(smooth, 20, 3, noise=0.03),
    "smooth-much-noise": Function(smooth, 20, 3, noise=0.2),
    "jumping": Function(jumping, 6, 2),
    "seldom": Function(seldom, 8, 2),
    "huge-box": Function(lambda p: 0.5 * np.tanh(A[:2, :10] @ p), 10, 2, noise=0.01, box=50),
    "units": Function(units, 5, 2, box=3000),
    "ring": Function(ring, 5, 2, noise=0.05),
    "six": Function(lambda p: np.tanh(2 * C @ p), 12, 6, noise=0.02),
    "waves": Function(waves, 4, 2, noise=0.02),
    "step": Function(step, 6, 3, noise=0.01, reach=100),
}


def errors(world: Function, learner: str, configuration: str, seed: int, at: list[int]) -> Any:
    made = sgim.algorithms.make(learner, world.task, [], seed=seed, configuration=configuration)
    benchmark, found = Benchmark(world.goals(), world.still(), "metric"), []
    with sgim.Run(made, world) as run:
        for movements in at:
            run.go(movements)
            found.append(benchmark.evaluate(made, Streams(seed), movements)["total"])
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", default=list(FUNCTIONS), metavar="NAME")
    parser.add_argument("--learners", nargs="+", default=["sagg-riac"])
    parser.add_argument("--configurations", nargs="+", default=["modern"])
    parser.add_argument("--seeds", type=int, default=3, help="how many, from 1000 on")
    parser.add_argument("--at", nargs="+", type=int, default=[100, 200, 500, 2000])
    given = parser.parse_args()
    print("median error after", *given.at)
    for name in given.names:
        for learner in given.learners:
            for configuration in given.configurations:
                seeds = range(1000, 1000 + given.seeds)
                world = FUNCTIONS[name]
                all_ = [errors(world, learner, configuration, s, given.at) for s in seeds]
                numbers = " ".join(f"{x:9.4g}" for x in np.median(all_, axis=0))
                print(f"{name:18} {learner:22} {configuration:32} {numbers}", flush=True)


if __name__ == "__main__":
    main()
