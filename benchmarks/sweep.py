"""How much of its time on one process a sweep takes on two.

The same runs are made on one process and on two, in turn, each in a folder of its own; shown are
the times and their ratio, which is .5 where nothing is lost. The first sweep on two processes also
starts them, which is part of its time. Run it with ``python benchmarks/sweep.py``.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from pathlib import Path
from statistics import median

from sgim.experiments.sweep_plan import Part, plan
from sgim.runs.sweep import sweep
from sgim.runs.sweep_run import PlannedRun


def seconds(runs: list[PlannedRun], jobs: int) -> float:
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        ended = sweep(runs, jobs=jobs, out=Path(folder))
        taken = time.perf_counter() - start
    failed = [run for run in ended if run.status != "finished"]
    if failed:
        raise SystemExit(failed[0].error)
    return taken


def main() -> None:
    parser = argparse.ArgumentParser(description="Time of a sweep on two processes beside one.")
    parser.add_argument("--seeds", type=int, default=24, help="how many runs")
    parser.add_argument("--movements", type=int, default=8000, help="movements of each")
    parser.add_argument("--repeats", type=int, default=3, help="how often both are timed")
    arguments = parser.parse_args()
    part = Part(
        ("throwing",), ("sgim-acts",), tuple(range(arguments.seeds)), movements=arguments.movements
    )
    runs = plan([part])
    ratios = []
    for _ in range(arguments.repeats):
        one, two = seconds(runs, 1), seconds(runs, 2)
        ratios.append(two / one)
        load = os.getloadavg()[0]
        print(f"one {one:.1f} s   two {two:.1f} s   ratio {two / one:.2f}   load {load:.1f}")
    print(f"median ratio {median(ratios):.2f}")


if __name__ == "__main__":
    main()
