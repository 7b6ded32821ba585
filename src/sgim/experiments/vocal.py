"""Learning to vocalise (chapter 5), alone or amid one of three ambient languages."""

from __future__ import annotations

from sgim.environments.base import MinimalEnvironment
from sgim.environments.vocal import VocalTract, ambient_language, vocal_goals
from sgim.environments.vocal.languages import DESCRIPTIONS, LANGUAGES
from sgim.experiments.experiment import NO_TEACHER, Experiment
from sgim.runs.benchmark import Benchmark
from sgim.teachers import Teacher

BATCH = 400
"""Vocalisations between two updates of the thesis's model, which therefore go side by side."""


def _benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(vocal_goals(), VocalTract(noise=0.0), "metric")


def _teachers() -> dict[str, Teacher]:
    return {name: ambient_language(name) for name in LANGUAGES}


VOCAL = Experiment(
    name="vocal",
    summary="Make a vocal tract sound as asked, twice in 0.8 s (chapter 5).",
    environment=VocalTract,
    benchmark=_benchmark,
    teachers=DESCRIPTIONS,
    make_teachers=_teachers,
    unit="distance between sounds",
    movements=240_000,
    alone="sagg-riac-gmm",
    taught="sgim-acts-gmm",
    default_teacher=NO_TEACHER,
    batch=BATCH,
    evaluate_every=60 * BATCH,
)
