"""Throwing and placing (section 4.3.3), and variants of what the thesis leaves open about it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from sgim.environments.base import MinimalEnvironment
from sgim.environments.benchmark_goals import throwing_goals
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import (
    crowded_teachers,
    partial_teachers,
    throwing_teachers,
)
from sgim.experiments.experiment import Experiment
from sgim.runs.benchmark import Benchmark


def _benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(throwing_goals(), environment)


THROWING = Experiment(
    name="throwing",
    summary="Throw a ball as far and as high as asked, or place it at an angle (chapter 4.3).",
    environment=ThrowingArm,
    benchmark=_benchmark,
    teachers={
        "T1": "throws, from what a learner found by itself",
        "T2": "places at 10 angles, and is copied well",
        "T3": "places as T2 does, but is misread by who copies it",
    },
    make_teachers=throwing_teachers,
)


def _variant(name: str, summary: str, **changes: Any) -> Experiment:
    named = replace(THROWING, name=f"throwing-{name}", summary=summary, variant_of="throwing")
    return replace(named, **changes)


THROWING_VARIANTS = [
    *(
        _variant(
            str(count),
            f"T2 and T3 place at {count} angles.",
            make_teachers=partial(throwing_teachers, count),
            teachers={
                **THROWING.teachers,
                "T2": f"places at {count} angles, and is copied well",
            },
        )
        for count in (5, 20, 30, 100)
    ),
    _variant(
        "loose",
        "Goals count as reached within three times the distance.",
        environment=partial(ThrowingArm, tolerance=3.0),
    ),
    _variant(
        "strict",
        "Goals count as reached within a third of the distance.",
        environment=partial(ThrowingArm, tolerance=1 / 3),
    ),
    _variant(
        "partial",
        "T1 throws forwards only, T2 and T3 place on one side only.",
        make_teachers=partial_teachers,
    ),
    _variant(
        "crowd",
        "Seven more teachers, who are misread and show nothing that is hard to find.",
        make_teachers=crowded_teachers,
        teachers={**THROWING.teachers, **{f"U{k}": "of no use" for k in range(1, 8)}},
    ),
]
