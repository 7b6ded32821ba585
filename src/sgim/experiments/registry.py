"""The experiments that come with the library."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from sgim.environments.arm import ARMS, PlanarArm
from sgim.environments.base import MinimalEnvironment
from sgim.environments.benchmark_goals import hockey_goals, reachable_goals, throwing_goals
from sgim.environments.fishing import FishingFloor, FishingRod
from sgim.environments.fishing.demonstrators import DEMONSTRATORS, fishing_teacher
from sgim.environments.fishing.goals import fishing_goals, floor_goals
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import unknown
from sgim.experiments.experiment import Experiment
from sgim.runs.benchmark import Benchmark
from sgim.teachers import Teacher

DEFAULT_ARM = "7-tight"


def _throwing_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(throwing_goals(), environment)


def _hockey_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(hockey_goals(), environment)


def _arm_benchmark(name: str, environment: MinimalEnvironment) -> Benchmark:
    assert isinstance(environment, PlanarArm)
    return Benchmark(reachable_goals(name), environment.without_noise(), "metric")


def _arm(name: str) -> Experiment:
    arm = ARMS[name]
    joints = arm.task.policy_space.dimension
    return Experiment(
        name="arm" if name == DEFAULT_ARM else f"arm-{name}",
        summary=f"Reach with the hand of a planar arm of {joints} joints; goals: {name}.",
        environment=lambda: arm,
        benchmark=partial(_arm_benchmark, name),
        unit="m",
        movements=10000,
    )


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
    )


def _floor_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(floor_goals(), environment, "metric")


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
        unit="sides of the view",
        movements=5000,
    ),
]

THROWING = Experiment(
    name="throwing",
    summary="Throw a ball as far and as high as asked, or place it at an angle (chapter 4.3).",
    environment=ThrowingArm,
    benchmark=_throwing_benchmark,
    teachers={
        "T1": "throws, from what a learner found by itself",
        "T2": "places at 10 angles, and is copied well",
        "T3": "places as T2 does, but is misread by who copies it",
    },
    make_teachers=throwing_teachers,
)

HOCKEY = Experiment(
    name="hockey",
    summary="Hit a puck so that it meets the far border at a given place (section 4.2.2).",
    environment=AirHockey,
    benchmark=_hockey_benchmark,
    teachers={"expert": "hits the right quarter, most of it hidden by an obstacle"},
    make_teachers=hockey_teachers,
)

EXPERIMENTS = {e.name: e for e in [THROWING, HOCKEY, *FISHING, *(_arm(name) for name in ARMS)]}


def experiment(name: str) -> Experiment:
    """The experiment of this name.

    Raises:
        UnknownNameError: If there is none; the message has the nearest name.
    """
    if name not in EXPERIMENTS:
        raise unknown("experiment", name, EXPERIMENTS)
    return EXPERIMENTS[name]
