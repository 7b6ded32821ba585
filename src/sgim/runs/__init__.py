"""Runs: a learner in its world, with its journal, measured."""

from sgim.runs.benchmark import Benchmark
from sgim.runs.continuation import keep_journal
from sgim.runs.journal import Journal
from sgim.runs.repertoire import evaluate, open_repertoire
from sgim.runs.run import Interrupted, Run, RunError

__all__ = [
    "Benchmark",
    "Interrupted",
    "Journal",
    "Run",
    "RunError",
    "evaluate",
    "keep_journal",
    "open_repertoire",
]
