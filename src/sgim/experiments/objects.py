"""Recognising objects by manipulating them (chapter 2), with either caregiver."""

from __future__ import annotations

from functools import cache, partial
from typing import Literal

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


def _teachers(bias: Literal["unbiased", "biased"]) -> dict[str, Teacher]:
    return dict(caregivers(_table(), bias))


def _objects(bias: Literal["unbiased", "biased"]) -> Experiment:
    return Experiment(
        name="objects" if bias == "unbiased" else f"objects-{bias}",
        summary=f"Recognise toys by manipulating them (chapter 2); the caregiver is {bias}.",
        environment=_table,
        benchmark=_benchmark,
        teachers={"caregiver": CAREGIVERS[bias]},
        make_teachers=partial(_teachers, bias),
        unit="share of pictures not recognised",
        movements=PRESENTATIONS + EPISODES,
        evaluate_every=1,
        variant_of=None if bias == "unbiased" else "objects",
    )


OBJECTS = [_objects("unbiased"), _objects("biased")]
