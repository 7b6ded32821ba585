"""Runs measured again by another way of answering, which learning does not depend on."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from sgim.errors import SgimError
from sgim.events import Evaluated
from sgim.experiments import EXPERIMENTS
from sgim.runs.benchmark import Benchmark
from sgim.runs.measured import MeasuredRun
from sgim.runs.repertoire import evaluate, open_repertoire

Run = TypeVar("Run", bound=MeasuredRun)


class Answered:
    """Measures runs again by one way of answering, and keeps what it found beside the journals.

    What ``a.sgim`` learned in its first N movements is remembered, asked for the benchmark's goals,
    and executed, with the noise of the run's own evaluation at N. The errors are written to
    ``a.WAY.json``, and are taken from there the next time.

    Args:
        way: Name of the way of answering.
    """

    def __init__(self, way: str) -> None:
        self.way = way
        self._benchmarks: dict[str, Benchmark] = {}

    def measure(self, run: Run, movements: Iterable[int]) -> Run:
        """The run with its errors at some of its evaluations, by this way.

        Raises:
            SgimError: If the run is of no experiment of the library.
            UnknownNameError: If there is no such way of answering.
            JournalError: If the journal cannot be read.
        """
        file = run.path.with_suffix(f".{self.way}.json")
        known = json.loads(file.read_text("utf-8")) if file.exists() else {}
        there = {evaluation.movements for evaluation in run.evaluations}
        wanted = sorted(there.intersection(movements))
        for number in wanted:
            if str(number) not in known:
                known[str(number)] = self._errors(run, number)
                _write(file, known)
        found = tuple(Evaluated(number, known[str(number)]) for number in wanted)
        return replace(run, evaluations=found)

    def _errors(self, run: MeasuredRun, movements: int) -> dict[str, float]:
        repertoire = open_repertoire(run.path, movements=movements)
        benchmark = self._benchmark(run)
        return evaluate(repertoire, benchmark, by=self.way, seed=run.seed or 0, index=movements)

    def _benchmark(self, run: MeasuredRun) -> Benchmark:
        name = run.experiment or ""
        if name not in EXPERIMENTS:
            raise SgimError(f"{run.path} is of no experiment of the library: it has no benchmark")
        if name not in self._benchmarks:
            declared = EXPERIMENTS[name]
            made = declared.benchmark(declared.environment())
            if not isinstance(made, Benchmark):
                raise SgimError(f"{name} is measured by no goals that could be answered otherwise")
            self._benchmarks[name] = made
        return self._benchmarks[name]


def _write(file: Path, errors: dict[str, dict[str, float]]) -> None:
    """Write all or nothing: the process may be stopped any time."""
    made = file.with_name(file.name + ".new")
    made.write_text(json.dumps(errors), "utf-8")
    made.replace(file)
