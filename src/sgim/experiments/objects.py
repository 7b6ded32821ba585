"""Recognising objects by manipulating them (chapter 2), with either caregiver."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from sgim.environments.base import MinimalEnvironment
from sgim.environments.objects import CAREGIVERS, ToyTable, caregivers, kept_pictures
from sgim.experiments.experiment import Experiment
from sgim.experiments.recognition_benchmark import RecognitionBenchmark
from sgim.teachers import Teacher

PRESENTATIONS = 5
EPISODES = 100


@cache
def _table() -> ToyTable:
    """The one table: what its camera has computed of the empty table serves all runs."""
    return ToyTable()


def _benchmark(environment: MinimalEnvironment) -> RecognitionBenchmark:
    return RecognitionBenchmark(kept_pictures())


def _teachers() -> Mapping[str, Teacher]:
    return caregivers(_table())


OBJECTS = Experiment(
    name="objects",
    summary="Recognise toys by manipulating them, or asking a caregiver to (chapter 2).",
    environment=_table,
    benchmark=_benchmark,
    teachers=CAREGIVERS,
    make_teachers=_teachers,
    default_teacher="unbiased",
    unit="share of pictures not recognised",
    movements=PRESENTATIONS + EPISODES,
    evaluate_every=1,
)
