"""The experiments that come with the library."""

from __future__ import annotations

from functools import partial

from sgim.environments.arm import ARMS, PlanarArm
from sgim.environments.base import MinimalEnvironment
from sgim.environments.benchmark_goals import hockey_goals, reachable_goals, throwing_goals
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import unknown
from sgim.experiments.experiment import Experiment
from sgim.runs.benchmark import Benchmark

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

EXPERIMENTS = {e.name: e for e in [THROWING, HOCKEY, *(_arm(name) for name in ARMS)]}


def experiment(name: str) -> Experiment:
    """The experiment of this name.

    Raises:
        UnknownNameError: If there is none; the message has the nearest name.
    """
    if name not in EXPERIMENTS:
        raise unknown("experiment", name, EXPERIMENTS)
    return EXPERIMENTS[name]
