"""Every part that comes with the library passes its conformance suite."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from sgim.environments import (
    ARMS,
    AirHockey,
    Environment,
    PlanarArm,
    ThrowingArm,
    hockey_teachers,
    throwing_teachers,
)
from sgim.memory import Memory
from sgim.outcome.absolute_progress import AbsoluteProgress
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.interest import UniformGoals
from sgim.outcome.mixture_interest import MixtureInterest
from sgim.outcome.progress import CompetenceChange, InterestMeasure, MeanProgress
from sgim.outcome.region_tree import RegionTree
from sgim.outcome.table import InterestTable
from sgim.policy.explorer import Explorer
from sgim.policy.guided_search import GuidedSearch
from sgim.policy.local_search import LocalSearch
from sgim.policy.mixture_model import Learning, MixtureModel
from sgim.policy.mixture_search import AroundRest, MixtureSearch
from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.population import CovarianceAdaptation, PathIntegral, PopulationSearch
from sgim.policy.simple import Mimicry, NoisyNearest, RandomPolicies
from sgim.policy.ways import answering_of
from sgim.spaces import Box, Choices, Space
from sgim.streams import Streams
from sgim.task import Task
from sgim.teachers import ScriptedTeacher
from sgim.testing import (
    check_environment,
    check_explorer,
    check_interest_map,
    check_model,
    check_space,
    check_teacher,
)

THROWING = ThrowingArm()
HOCKEY = AirHockey()
ENVIRONMENTS: dict[str, Environment] = {
    "throwing arm": THROWING,
    "air hockey": HOCKEY,
    "air hockey without an obstacle": AirHockey(obstacle=None),
    "arm with noise": PlanarArm(7),
    "arm without noise": PlanarArm(7, noise=0),
    "arm with a varying start": PlanarArm(3, vary_start=True),
    "arm with a varying start, without noise": PlanarArm(2, noise=0, vary_start=True),
    **ARMS,
}
LABELS = Choices(["red", "green", "blue"])
PLACE = Box([0, 0], [1, 3])
TASKS = {
    "throwing": THROWING.task,
    "air hockey": HOCKEY.task,
    "hand": PlanarArm(7).task,
    "hand with a varying start": PlanarArm(3, vary_start=True).task,
    "one joint": PlanarArm(1).task,
    "a hundred joints": ARMS["100-wide"].task,
    "labels among outcomes": Task(Box(0, 1, names="abcde"), {"word": LABELS, "place": PLACE}),
    "labels as contexts": Task(Box(-0.1, 0.2), {"place": PLACE}, context_space=LABELS),
}
MODES = {"alone": 1.0, "mimic": 2.0, "emulate": 3.0}
VECTOR_TASKS = {name: task for name, task in TASKS.items() if "labels" not in name}
NAMED = pytest.mark.parametrize("task", TASKS.values(), ids=TASKS.keys())


@pytest.mark.parametrize("environment", ENVIRONMENTS.values(), ids=ENVIRONMENTS.keys())
def test_every_environment_passes(environment: Environment) -> None:
    check_environment(environment)
    check_environment(environment, trials=3, seed=7)


@pytest.mark.parametrize("name", throwing_teachers())
def test_every_throwing_teacher_passes(name: str) -> None:
    check_teacher(throwing_teachers()[name], THROWING.task)


@pytest.mark.parametrize("name", hockey_teachers())
def test_every_hockey_teacher_passes(name: str) -> None:
    check_teacher(hockey_teachers()[name], HOCKEY.task)


def test_a_teacher_who_always_declines_passes() -> None:
    check_teacher(ScriptedTeacher(lambda goal: None), THROWING.task)


@pytest.mark.parametrize("space", [LABELS, PLACE, Box(-0.1, 0.2), THROWING.task.policy_space])
def test_every_space_passes(space: Space) -> None:
    check_space(space)


@pytest.mark.parametrize("task", VECTOR_TASKS.values(), ids=VECTOR_TASKS.keys())
@pytest.mark.parametrize("credit", ["chosen", "pursued"])
@pytest.mark.parametrize("measure", [MeanProgress, CompetenceChange])
def test_every_region_tree_passes(task: Task, credit: Any, measure: Any) -> None:
    made: InterestMeasure = measure(task.sizes) if measure is MeanProgress else measure()

    def make() -> RegionTree:
        return RegionTree(
            task.goal_spaces,
            MODES,
            made,
            Streams(0),
            context_space=task.context_space,
            staleness=0.02 if credit == "chosen" else 0.0,
            credit=credit,
        )

    check_interest_map(make, task.goal_spaces, list(MODES), context_space=task.context_space)


@pytest.mark.parametrize("task", VECTOR_TASKS.values(), ids=VECTOR_TASKS.keys())
@pytest.mark.parametrize("goals", [1, 3])
def test_every_map_of_expected_gain_passes(task: Task, goals: int) -> None:
    def lacks(kind: str, places: Any, context: Any) -> Any:
        return places[:, 0]

    def make() -> ExpectedGain:
        return ExpectedGain(
            task.goal_spaces,
            MODES,
            lacks,
            Streams(0),
            context_space=task.context_space,
            capacity=8,
            goals=goals,
        )

    check_interest_map(make, task.goal_spaces, list(MODES), context_space=task.context_space)


@pytest.mark.parametrize("task", VECTOR_TASKS.values(), ids=VECTOR_TASKS.keys())
def test_every_map_of_mixtures_passes(task: Task) -> None:
    def by_covariance() -> MixtureInterest:
        return MixtureInterest(
            task.goal_spaces,
            MODES,
            Streams(0),
            context_space=task.context_space,
            window=60,
            every=30,
            uniform_share=0.1,
            random_modes=0.1,
        )

    def by_absolute_progress() -> AbsoluteProgress:
        return AbsoluteProgress(
            task.goal_spaces,
            MODES,
            Streams(0),
            context_space=task.context_space,
            window=60,
            every=30,
        )

    for make in (by_covariance, by_absolute_progress):
        check_interest_map(make, task.goal_spaces, list(MODES), context_space=task.context_space)


@NAMED
def test_uniform_goals_pass(task: Task) -> None:
    spaces = task.goal_spaces
    check_interest_map(
        lambda: UniformGoals(spaces), spaces, list(MODES), context_space=task.context_space
    )


def test_an_interest_table_passes() -> None:
    check_interest_map(
        lambda: InterestTable("word", LABELS, MODES, CompetenceChange()),
        {"word": LABELS},
        list(MODES),
    )


@NAMED
@pytest.mark.parametrize("way", ["nearest", "local"])
def test_the_nearest_model_passes_with_the_ways_that_trust_a_deterministic_world(
    task: Task, way: str
) -> None:
    check_model(lambda: NearestModel(Memory(task), answering_of(way)), task)


@pytest.mark.parametrize("task", VECTOR_TASKS.values(), ids=VECTOR_TASKS.keys())
def test_the_mixture_model_passes(task: Task) -> None:
    learning = Learning(components=4, every=20, starving=0.01)

    def make() -> MixtureModel:
        return MixtureModel(task, Streams(0), learning, nearest=NearestModel(Memory(task)))

    def search(model: MixtureModel) -> MixtureSearch:
        return MixtureSearch(model, AroundRest(task, 0.1))

    check_model(make, task)
    check_explorer(search, task, make_model=make)


EXPLORERS: Mapping[str, Callable[[NearestModel], Explorer]] = {
    "Nelder-Mead": NelderMeadSearch,
    "local search": LocalSearch,
    "local search, large variations": lambda model: LocalSearch(model, variation=(1.0, 30.0)),
    "guided search": lambda model: GuidedSearch(LocalSearch(model)),
    "guided search, until the middle": lambda model: GuidedSearch(LocalSearch(model), 60),
    "CMA-ES": lambda model: PopulationSearch(model, CovarianceAdaptation),
    "PI2": lambda model: PopulationSearch(model, PathIntegral),
    "noise around the nearest": NoisyNearest,
    "noise from the first trial on": lambda model: NoisyNearest(model, bootstrap=0),
    "mimicry": lambda model: Mimicry(model.memory.task.policy_space, 0.3),
    "exact mimicry first": lambda model: Mimicry(
        model.memory.task.policy_space, 0.3, scaled=True, exact_first=True
    ),
    "random policies": lambda model: RandomPolicies(model.memory.task.policy_space),
}


@NAMED
@pytest.mark.parametrize("make", EXPLORERS.values(), ids=EXPLORERS.keys())
def test_every_explorer_passes(task: Task, make: Callable[[NearestModel], Explorer]) -> None:
    check_explorer(make, task)
    check_explorer(make, task, seed=1)


@pytest.mark.parametrize("dimension", range(1, 20))
def test_the_rounding_of_local_search_does_not_depend_on_its_company(dimension: int) -> None:
    rng = np.random.default_rng(dimension)
    outcomes = Box(np.zeros(1 + dimension % 4), 1)
    policies = Box(-1 - rng.random(dimension), 1)
    task = Task(policies, {"place": outcomes, "throw": Box([0, 0, 0], 1)})
    check_explorer(LocalSearch, task, seed=dimension)
    check_explorer(lambda model: GuidedSearch(LocalSearch(model)), task, seed=dimension)
    check_explorer(NelderMeadSearch, task, seed=dimension)
