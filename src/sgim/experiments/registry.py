"""The experiments that come with the library."""

from __future__ import annotations

from functools import partial

from sgim.environments.acrobot import Acrobot
from sgim.environments.arm import PlanarArm
from sgim.environments.arms import ARMS
from sgim.environments.base import MinimalEnvironment
from sgim.environments.benchmark_goals import acrobot_goals, hockey_goals, reachable_goals
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.environments.obstacle_arm import ObstacleArm
from sgim.errors import unknown
from sgim.experiments.experiment import Experiment
from sgim.experiments.fishing import FISHING
from sgim.experiments.objects import OBJECTS
from sgim.experiments.throwing import THROWING, THROWING_VARIANTS
from sgim.experiments.vocal import VOCAL
from sgim.runs.benchmark import Benchmark

DEFAULT_ARM = "7-tight"


def _hockey_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(hockey_goals(), environment)


def _arm_benchmark(name: str, environment: MinimalEnvironment) -> Benchmark:
    assert isinstance(environment, PlanarArm)
    return Benchmark(reachable_goals(name), environment.without_noise(), "metric")


def _arm(name: str) -> Experiment:
    arm = ARMS[name]
    what = f"a planar arm of {arm.joints} joints"
    past = " past an obstacle" if isinstance(arm, ObstacleArm) else ""
    return Experiment(
        name="arm" if name == DEFAULT_ARM else f"arm-{name}",
        summary=f"Reach with the hand of {what}{past}; goals: {name}.",
        environment=lambda: arm,
        benchmark=partial(_arm_benchmark, name),
        unit="m",
        movements=10000,
    )


def _acrobot_benchmark(environment: MinimalEnvironment) -> Benchmark:
    return Benchmark(acrobot_goals(), environment, "metric")


ACROBOT = Experiment(
    name="acrobot",
    summary="Swing the tip of a two-link pendulum where asked (Gymnasium's Acrobot).",
    environment=Acrobot,
    benchmark=_acrobot_benchmark,
    unit="m",
    movements=5000,
)


HOCKEY = Experiment(
    name="hockey",
    summary="Hit a puck so that it meets the far border at a given place (section 4.2.2).",
    environment=AirHockey,
    benchmark=_hockey_benchmark,
    teachers={"expert": "hits the right quarter, most of it hidden by an obstacle"},
    make_teachers=hockey_teachers,
)

EXPERIMENTS = {
    e.name: e
    for e in [
        THROWING,
        *THROWING_VARIANTS,
        HOCKEY,
        *FISHING,
        OBJECTS,
        VOCAL,
        *(_arm(name) for name in ARMS),
        ACROBOT,
    ]
}


def experiment(name: str) -> Experiment:
    """The experiment of this name.

    Raises:
        UnknownNameError: If there is none; the message has the nearest name.
    """
    if name not in EXPERIMENTS:
        raise unknown("experiment", name, EXPERIMENTS)
    return EXPERIMENTS[name]
