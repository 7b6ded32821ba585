"""Time learning to vocalise: the mixtures alone, the tract alone, and whole runs.

Run it as ``python benchmarks/mixtures.py``; ``--whole`` adds runs of 240 000 vocalisations with a
journal, alone and amid a language. Times are processor time per vocalisation, beside a fixed loop
of small NumPy operations timed in the same process, so that machines can be compared.
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse
import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from sgim.environments import VocalTract
from sgim.experiments import experiment
from sgim.experiments.vocal import BATCH
from sgim.outcome import MixtureInterest
from sgim.outcome.interest import EpisodeReport
from sgim.policy import AroundRest, Episode, MixtureModel, MixtureSearch
from sgim.records import Trial
from sgim.streams import Streams


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--movements", type=int, default=240_000)
    parser.add_argument("--whole", action="store_true", help="also whole runs")
    options = parser.parse_args()
    reference = min(reference_loop() for _ in range(5))
    print(f"reference: fixed NumPy loop, an iteration {reference:.1f} µs")
    for name, microseconds in parts(options.repeats).items():
        row(name, microseconds, reference)
    if options.whole:
        for learner in ("sagg-riac-gmm", "sgim-acts-gmm:1"):
            seconds, size = whole(learner, options.movements)
            row(f"{learner}, all", seconds / options.movements * 1e6, reference)
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            print(
                f"  {options.movements} vocalisations in {seconds:.1f} s, "
                f"{options.movements / seconds:.0f} a second; "
                f"journal {size / 1e6:.0f} MB, memory {memory:.0f} MB"
            )


def row(name: str, microseconds: float, reference: float) -> None:
    print(f"{name:34s} {microseconds:7.1f} µs  {microseconds / reference:6.2f} × reference")


def reference_loop(iterations: int = 5000) -> float:
    """Microseconds an iteration of small products and a small solve."""
    rng = np.random.default_rng(0)
    points, identity = rng.random((16, 14)), np.eye(16)
    start = time.process_time()
    for _ in range(iterations):
        np.linalg.solve(points @ points.T + identity, points[:, :2])
        np.clip(points[0] + 0.1, 0.0, 1.0)
    return (time.process_time() - start) / iterations * 1e6


def least(action: Callable[[], object], repeats: int) -> float:
    """The least processor time of an action on a batch, in microseconds a vocalisation."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        action()
        times.append(time.process_time() - start)
    return min(times) / BATCH * 1e6


def parts(repeats: int) -> dict[str, float]:
    """Microseconds a vocalisation of each part, in the state after 20 batches of a run."""
    vocal, tract = experiment("vocal"), VocalTract()
    learner = vocal.learner("sagg-riac-gmm")
    vocal.run(learner, batch=BATCH, evaluate_every=10**9).go(20 * BATCH)
    model, interest = learner.model, getattr(learner.strategy, "interest", None)
    assert isinstance(model, MixtureModel)
    assert isinstance(interest, MixtureInterest)
    streams = Streams(0)
    rngs = [streams("a", i) for i in range(BATCH)]
    goals = [goal for goal, _ in interest.choose_all(rngs, ["autonomous"], [None] * BATCH)]
    episodes = [Episode(i, g, None, r) for i, (g, r) in enumerate(zip(goals, rngs, strict=True))]
    search = MixtureSearch(model, AroundRest(tract.task, 0.042))
    policies = [tract.task.check_policy(p) for p in search.propose(episodes)]
    outcomes = tract.execute_batch(policies, None, rngs)
    trials = [Trial(p, o) for p, o in zip(policies, outcomes, strict=True)]
    none = [None] * BATCH

    def report() -> None:
        for i, goal in enumerate(goals):
            interest.update(EpisodeReport(i, "autonomous", goal, goal, None, -1, -i / BATCH, 1))

    return {
        "goals drawn": least(lambda: interest.choose_all(rngs, ["autonomous"], none), repeats),
        "policies drawn": least(lambda: search.propose(episodes), repeats),
        "tract": least(lambda: tract.execute_batch(policies, None, rngs), repeats),
        "joint model updated": least(lambda: model.learn_all(trials, goals, none), repeats),
        "interest fitted": least(report, repeats),
    }


def whole(learner: str, movements: int) -> tuple[float, int]:
    """Processor seconds of a run with its journal and evaluations, and the journal's size."""
    vocal = experiment("vocal")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.sgim"
        start = time.process_time()
        with vocal.start(learner, path, batch=BATCH, evaluate_every=vocal.evaluate_every) as run:
            run.go(movements)
        return time.process_time() - start, path.stat().st_size


if __name__ == "__main__":
    main()
