"""Beside quality-diversity search: CMA-MAE and CVT-MAP-Elites at equal numbers of movements.

Run it as ``python benchmarks/quality_diversity.py [--seeds 0-9] [EXPERIMENT …]``; it needs pyribs
(``pip install 'sgim[quality-diversity]'``). Each search fills an archive of 3000 cells over the
outcomes; it answers a goal with the elite nearest to it, and is measured on the experiment's own
benchmark. As there is nothing to optimise but coverage, every movement has the same objective: in
CMA-MAE a cell is then worth less the more often it was reached, so that the search descends the
density of what it found (Fontaine and Nikolaidis 2023); CVT-MAP-Elites keeps the first elite of
each cell and varies elites (Vassiliades et al. 2018). Outcomes of several kinds are put side by
side, a kind that was not produced at the lower corner of its space, where it answers no goal.
"""

from __future__ import annotations

import argparse
import warnings
from typing import Any

import numpy as np
from ribs.archives import CVTArchive
from ribs.emitters import EvolutionStrategyEmitter, GaussianEmitter
from ribs.schedulers import Scheduler

from sgim.environments.base import MinimalEnvironment, execute_all
from sgim.experiments import EXPERIMENTS, experiment
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams

CELLS = 3000
AT_ONCE = 20
EMITTERS = 5
STEP = 0.1
LEARNING_RATE = 0.01
CHECKPOINTS = (500, 1000, 2000, 5000, 10000)
LEARNERS = ("random-goal-babbling", "sagg-riac")


class Elites:
    """What a benchmark asks of a learner: for a goal, the elite nearest to it."""

    def __init__(self, archive: CVTArchive, slices: dict[str, slice], spaces: Any) -> None:
        elites = archive.data(["solution", "measures"])
        self.solutions, self.measures = elites["solution"], elites["measures"]
        self.slices, self.spaces = slices, spaces

    def best_policies(self, kind: str, points: Any, contexts: Any = None) -> list[Any]:
        """The elite for each goal; None where no elite produced the kind."""
        known = self.measures[:, self.slices[kind]]
        produced = (known != self.spaces[kind].low).any(axis=1)
        if not produced.any():
            return [None] * len(points)
        known, solutions = known[produced], self.solutions[produced]
        return [solutions[np.argmin(((known - p) ** 2).sum(axis=1))] for p in points]


def searched(
    name: str, environment: MinimalEnvironment, seed: int
) -> tuple[Scheduler, CVTArchive, dict[str, slice]]:
    """A search of the named kind, its archive, and where each kind is among the measures."""
    policies, spaces = environment.task.policy_space, environment.task.outcome_spaces
    assert isinstance(policies, Box)
    slices, ranges = {}, []
    for kind, space in spaces.items():
        assert isinstance(space, Box)
        slices[kind] = slice(len(ranges), len(ranges) + space.dimension)
        ranges += list(zip(space.low, space.high, strict=True))
    annealed = {"learning_rate": LEARNING_RATE, "threshold_min": 0.0} if name == "CMA-MAE" else {}
    centroids = np.random.default_rng(seed).uniform(
        [low for low, _ in ranges], [high for _, high in ranges], (CELLS, len(ranges))
    )
    archive = CVTArchive(
        solution_dim=policies.dimension, centroids=centroids, ranges=ranges, seed=seed, **annealed
    )
    result = CVTArchive(
        solution_dim=policies.dimension, centroids=centroids, ranges=ranges, seed=seed
    )
    middle, bounds = (
        (policies.low + policies.high) / 2,
        list(zip(policies.low, policies.high, strict=True)),
    )
    if name == "CMA-MAE":
        emitters = [
            EvolutionStrategyEmitter(
                archive,
                x0=middle,
                sigma0=STEP * float(np.mean(policies.range)),
                ranker="imp",
                selection_rule="mu",
                restart_rule="basic",
                bounds=bounds,
                batch_size=AT_ONCE,
                seed=10 * seed + i,
            )
            for i in range(EMITTERS)
        ]
        return Scheduler(archive, emitters, result_archive=result), result, slices
    start = np.random.default_rng(seed).uniform(policies.low, policies.high, (100, len(middle)))
    emitters = [
        GaussianEmitter(
            archive,
            sigma=STEP * policies.range,
            initial_solutions=start,
            bounds=bounds,
            batch_size=100,
            seed=seed,
        )
    ]
    return Scheduler(archive, emitters), archive, slices


def measures(outcome: Outcome, spaces: Any) -> FloatArray:
    return np.concatenate([outcome.get(kind, space.low) for kind, space in spaces.items()])


def search_errors(name: str, experiment_name: str, seed: int, movements: int) -> list[float]:
    """The total error at each checkpoint up to a number of movements."""
    world = experiment(experiment_name)
    environment = world.environment()
    benchmark, streams = world.benchmark(environment), Streams(seed)
    scheduler, archive, slices = searched(name, environment, seed)
    rng, made, errors = streams("search"), 0, []
    spaces = environment.task.outcome_spaces
    for checkpoint in (c for c in CHECKPOINTS if c <= movements):
        while made < checkpoint:
            policies = scheduler.ask()
            outcomes = execute_all(environment, policies, None, [rng] * len(policies))
            scheduler.tell(np.ones(len(policies)), [measures(o, spaces) for o in outcomes])
            made += len(policies)
        errors.append(benchmark.evaluate(Elites(archive, slices, spaces), streams, made)["total"])  # type: ignore[arg-type]
    return errors


def learner_errors(name: str, experiment_name: str, seed: int, movements: int) -> list[float]:
    world = experiment(experiment_name)
    run = world.run(world.learner(name, seed=seed), evaluate_every=500)
    found = {e.movements: e.errors["total"] for e in run.go(movements)}
    return [found[c] for c in CHECKPOINTS if c <= movements]


def main() -> None:
    # CMA-ES draws again what falls out of bounds, and says so when it has to do it often.
    warnings.filterwarnings("ignore", "During bounds handling")
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("experiments", nargs="*", default=["arm", "arm-50-wide", "throwing"])
    parser.add_argument("--seeds", default="0-9", help="first-last")
    options = parser.parse_args()
    first, last = (int(part) for part in options.seeds.split("-"))
    for name in options.experiments:
        movements = EXPERIMENTS[name].movements
        shown = [c for c in CHECKPOINTS if c <= movements]
        print(
            f"{name}: median total error [quartiles] after {', '.join(map(str, shown))} movements"
        )
        extra = ("sgim-acts",) if EXPERIMENTS[name].teachers else ()
        for search in ("CMA-MAE", "CVT-MAP-Elites", *LEARNERS, *extra):
            measure = search_errors if search.isupper() or "CVT" in search else learner_errors
            errors = [measure(search, name, seed, movements) for seed in range(first, last + 1)]
            low, middle, high = np.quantile(errors, (0.25, 0.5, 0.75), axis=0)
            cells = [
                f"{m:.4f} [{a:.4f}, {b:.4f}]" for a, m, b in zip(low, middle, high, strict=True)
            ]
            print(f"  {search:22s}" + "  ".join(cells), flush=True)


if __name__ == "__main__":
    main()
