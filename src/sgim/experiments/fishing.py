"""The fishing rod (chapter 3), and its variants."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from sgim.environments.base import MinimalEnvironment
from sgim.environments.fishing import FishingFloor, FishingRod
from sgim.environments.fishing.demonstrators import DEMONSTRATORS, fishing_teacher, floor_teacher
from sgim.environments.fishing.goals import fishing_goals, floor_goals
from sgim.experiments.experiment import Experiment
from sgim.runs.benchmark import Benchmark
from sgim.teachers import Teacher


def _fishing_benchmark(environment: MinimalEnvironment) -> Benchmark:
    assert isinstance(environment, FishingRod)
    return Benchmark(fishing_goals(), environment, "metric", {"float": environment.rest})


def _fishing_teachers(make: Callable[[], FishingRod]) -> dict[str, Teacher]:
    task = make().task
    return {f"D{number}": fishing_teacher(number, task) for number in DEMONSTRATORS}


def _fishing(name: str, summary: str, make: Callable[[], FishingRod]) -> Experiment:
    return Experiment(
        name=name,
        summary=summary,
        environment=make,
        benchmark=_fishing_benchmark,
        teachers={f"D{number}": line for number, line in DEMONSTRATORS.items()},
        make_teachers=partial(_fishing_teachers, make),
        unit="m",
        movements=5000,
        variant_of=None if name == "fishing" else "fishing",
    )


def _floor_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(floor_goals(), environment, "metric")


def _floor_teachers() -> dict[str, Teacher]:
    return {"D3": floor_teacher(FishingFloor().task)}


_CAST = "Cast the float of a fishing rod where asked on the water"

FISHING = [
    _fishing("fishing", f"{_CAST} (chapter 3): fast model, noise 0.4.", FishingRod),
    _fishing("fishing-full", f"{_CAST}: full model.", partial(FishingRod, fast=False)),
    _fishing("fishing-noisy", f"{_CAST}: noise 1.", partial(FishingRod, 1.0)),
    _fishing("fishing-still", f"{_CAST}: no noise.", partial(FishingRod, 0.0)),
    _fishing(
        "fishing-wide",
        f"{_CAST}: goals in a box a hundred times as long and wide.",
        partial(FishingRod, widen=100.0),
    ),
    Experiment(
        name="fishing-floor",
        summary="Bring a ball on the line to rest where asked on the floor (section 3.6).",
        environment=FishingFloor,
        benchmark=_floor_benchmark,
        teachers={"D3": DEMONSTRATORS[3]},
        make_teachers=_floor_teachers,
        unit="sides of the view",
        movements=5000,
        variant_of="fishing",
    ),
]
