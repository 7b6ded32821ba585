"""Population search: where it starts, that it comes nearer, and what it needs."""

import sys

import numpy as np
import pytest
from tests.helpers import PLANE, episode_for, plane, random_policies, remember, tell

from sgim.errors import SgimError
from sgim.policy import CovarianceAdaptation, PathIntegral, PopulationSearch
from sgim.policy.population import MakeDistribution
from sgim.records import Goal, Trial
from sgim.spaces import Choices
from sgim.task import Task

BOTH = pytest.mark.parametrize("make", [CovarianceAdaptation, PathIntegral])
CENTRE = np.array([0.5, 0.5])


@BOTH
@pytest.mark.parametrize("seed", range(3))
def test_a_distribution_moves_to_where_costs_are_low(make: MakeDistribution, seed: int) -> None:
    rng = np.random.default_rng(seed)
    lowest, distribution = rng.random(6), make(np.full(6, 0.5), 0.2, rng)
    best = []
    for _ in range(30):
        points = distribution.ask()
        costs = np.linalg.norm(points - lowest, axis=1)
        distribution.tell(points, costs)
        best.append(costs.min())
    assert best[-1] < 0.25 * best[0]


@BOTH
def test_a_distribution_draws_from_the_stream_it_is_given_alone(make: MakeDistribution) -> None:
    np.random.seed(1)  # noqa: NPY002
    before = np.random.get_state()[1].tolist()  # type: ignore[index] # noqa: NPY002
    populations = []
    for _ in range(2):
        distribution = make(CENTRE, 0.1, np.random.default_rng(5))
        first = distribution.ask()
        distribution.tell(first, first.sum(axis=1))
        populations.append(distribution.ask())
    np.testing.assert_array_equal(*populations)
    assert np.random.get_state()[1].tolist() == before  # type: ignore[index] # noqa: NPY002


@BOTH
def test_the_first_population_lies_around_the_nearest_policy_as_wide_as_its_neighbours(
    make: MakeDistribution,
) -> None:
    for width in (0.01, 0.1):
        around = CENTRE + width * np.array([[0, 0], [1, 0], [0, 1], [-1, 1], [1, -1]])
        model = remember(PLANE, plane, around)
        search = PopulationSearch(model, make, least_global=0.0)
        drawn = []
        for seed in range(100):
            episode = episode_for(model, Goal("place", plane(CENTRE)["place"]), seed=seed)
            search.begin(episode)
            drawn += search.propose([episode])
        np.testing.assert_allclose(np.mean(drawn, axis=0), CENTRE, atol=0.3 * width)
        assert 0.2 * width < np.std(drawn, axis=0).mean() < 1.5 * width


@BOTH
def test_episodes_come_nearer_to_their_goals(make: MakeDistribution) -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 10))
    search = PopulationSearch(model, make)
    before, after = 0.0, 0.0
    for seed in range(15):
        goal = Goal("place", plane(np.random.default_rng(seed).random(2))["place"])
        episode = episode_for(model, goal, seed=seed)
        search.begin(episode)
        for _ in range(40):
            (policy,) = search.propose([episode])
            tell(model, search, episode, Trial(policy, plane(policy)))
        assert episode.before is not None
        assert episode.best is not None
        before, after = before - episode.before, after - episode.best
    assert after < 0.3 * before


@BOTH
def test_a_refused_policy_counts_as_the_worst(make: MakeDistribution) -> None:
    def after(refused: bool) -> list[list[float]]:
        model = remember(PLANE, plane, random_policies(PLANE, 10))
        search = PopulationSearch(model, make, least_global=0.0)
        episode = episode_for(model, Goal("place", plane(CENTRE)["place"]))
        episode.best = 0.0
        search.begin(episode)
        proposed = []
        for number in range(25):
            (policy,) = search.propose([episode])
            proposed.append(policy.tolist())
            if number % 2 and refused:
                search.refuse(episode)
            else:
                search.learn(episode, Trial(policy, {}), -1.0 if number % 2 else -0.1)
        return proposed

    assert after(True) == after(False)


@BOTH
def test_while_nothing_is_known_policies_are_random(make: MakeDistribution) -> None:
    model = remember(PLANE, plane, [])
    search, drawn = PopulationSearch(model, make), []
    for seed in range(200):
        episode = episode_for(model, Goal("place", plane(CENTRE)["place"]), seed=seed)
        search.begin(episode)
        drawn += search.propose([episode])
    np.testing.assert_allclose(np.std(drawn, axis=0), np.sqrt(1 / 12), atol=0.04)


def test_policies_must_be_vectors() -> None:
    task = Task(Choices(["look"]), PLANE.outcome_spaces)
    with pytest.raises(TypeError, match="population search needs policies in a Box"):
        PopulationSearch(remember(task, lambda _: {}, []), PathIntegral)


def test_without_the_package_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cma", None)
    with pytest.raises(SgimError, match=r"pip install 'sgim\[cma\]'"):
        CovarianceAdaptation(CENTRE, 0.1, np.random.default_rng(0))
