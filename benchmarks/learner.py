"""Time a learner's movements: alone, in batches, as memory grows, and how much it needs.

Run it as ``python benchmarks/learner.py``; ``--long`` adds the 100 000 movements and
``--memory`` a million trials. Times are per movement, all in: deciding, simulating, learning and
the journal; the evaluations too with ``--evaluations``. They are printed beside a fixed loop of
small NumPy operations timed in the same process, so that machines can be compared by the ratio.
Random policies cost nothing to decide, so that their time is that of the bookkeeping.
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse
import resource
import tempfile
import time
from pathlib import Path

import numpy as np

from sgim.experiments import experiment
from sgim.memory import Memory
from sgim.records import Trial


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--learner", default="sgim-acts")
    parser.add_argument("--configuration", default="modern")
    parser.add_argument("--movements", type=int, default=8000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--evaluations", action="store_true", help="count the evaluations, too")
    parser.add_argument("--long", action="store_true", help="also the cost at 100 000 movements")
    parser.add_argument("--memory", action="store_true", help="also a million remembered trials")
    options = parser.parse_args()
    throwing = experiment("throwing")
    kinds = {
        "one movement at a time": (options.learner, 1),
        "64 at a time": (options.learner, 64),
        "400 at a time": (options.learner, 400),
        "random policies, one at a time": ("random", 1),
        "random policies, 400 at a time": ("random", 400),
    }
    reference: list[float] = []
    times: dict[str, list[float]] = {name: [] for name in kinds}
    for _ in range(options.repeats):  # in turn, so that a drifting machine is fair to all
        reference.append(reference_loop())
        for name, (learner, batch) in kinds.items():
            times[name].append(run(throwing, options, learner, batch))
    row("reference: fixed NumPy loop, an iteration", reference, reference)
    for name in kinds:
        row(name, times[name], reference)
    asks = [asking(throwing, options, 1), asking(throwing, options, 64)]
    print(
        f"a plan by ask {asks[0]:.1f} µs, by ask_batch(64) {asks[1]:.1f} µs: "
        f"{asks[0] / asks[1]:.2f} times the throughput"
    )
    if options.long:
        growth(throwing, options)
    if options.memory:
        million_trials()


def row(name: str, values: list[float], reference: list[float]) -> None:
    ratios = np.array(values) / np.array(reference)
    print(
        f"{name:45s} median {np.median(values):7.1f} µs  least {min(values):7.1f} µs  "
        f"{np.median(ratios):6.2f} × reference"
    )


def reference_loop(iterations: int = 20000) -> float:
    """Microseconds an iteration of what a learner does most: small vectors, a small solve."""
    rng = np.random.default_rng(0)
    points, matrix = rng.random((16, 14)), rng.random((200, 2))
    identity = np.eye(16)
    start = time.process_time()
    for _ in range(iterations):
        gram = points @ points.T + identity
        np.linalg.solve(gram, points[:, :2])
        offsets = matrix - matrix[0]
        np.einsum("ij,ij->i", offsets, offsets).argmin()
        np.clip(points[0] + 0.1, 0.0, 1.0)
    return (time.process_time() - start) / iterations * 1e6


def run(throwing, options, name: str, batch: int) -> float:
    with tempfile.TemporaryDirectory() as folder:
        learner = throwing.learner(name, configuration=options.configuration)
        with throwing.run(learner, Path(folder) / "run.sgim", batch=batch) as going:
            if not options.evaluations:
                going.benchmark = None
            start = time.process_time()
            going.go(options.movements)
            return (time.process_time() - start) / options.movements * 1e6


def asking(throwing, options, batch: int) -> float:
    """Microseconds a plan for deciding alone, the telling left out of the clock."""
    learner = throwing.learner(options.learner, configuration=options.configuration)
    world, teachers = throwing.environment(), throwing.make_teachers()
    spent = 0.0
    while learner.movements < options.movements:
        start = time.process_time()
        if batch == 1:
            learner.ask()
        else:
            learner.ask_batch(batch)
        spent += time.process_time() - start
        for plan in learner.pending:
            if plan.request is not None:
                rng = np.random.default_rng(plan.id)
                shown = teachers[plan.request.teacher].demonstrate(plan.request.goal, rng)
                learner.answer(plan, shown)
        for plan in learner.pending:
            learner.tell(plan, world.execute(plan.policy, None, None))
    return spent / learner.movements * 1e6


def growth(throwing, options) -> None:
    with tempfile.TemporaryDirectory() as folder:
        learner = throwing.learner(options.learner, configuration=options.configuration)
        times = {}
        with throwing.run(learner, Path(folder) / "run.sgim") as going:
            if not options.evaluations:
                going.benchmark = None
            for mark in (9000, 10000, 90000, 100000):
                start = time.process_time()
                going.go(mark)
                times[mark] = time.process_time() - start
    early, late = times[10000] / 1000 * 1e6, times[100000] / 10000 * 1e6
    print(
        f"a movement from 9 000 to 10 000: {early:.1f} µs; from 90 000 to 100 000: {late:.1f} µs;"
        f" {late / early:.2f} times"
    )


def million_trials() -> None:
    throwing = experiment("throwing")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    memory = Memory(throwing.environment().task)
    rng = np.random.default_rng(0)
    space = throwing.environment().task.policy_space
    for _ in range(1000):
        policies = space.decode(rng.random((1000, 14)))
        points = rng.random((1000, 2)) * [20, 6] - [10, 0]
        for policy, point in zip(policies, points, strict=True):
            memory.add(Trial(policy, {"throw": point}))
        memory.kinds["throw"].nearest(np.array([0.5, 0.5]), 20)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"a million trials of 14 + 2 numbers, indexed: peak {peak:.0f} MB of the whole process, "
        f"{peak - before:.0f} MB more than before"
    )


if __name__ == "__main__":
    main()
