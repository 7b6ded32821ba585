"""Goal-directed optimisation: when it is global, what local search starts from, how it goes on."""

import numpy as np
import pytest
from tests.helpers import PLANE, episode_for, plane, random_policies, remember, tell

from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.records import Goal, Trial
from sgim.spaces import Choices
from sgim.task import Task

CENTRE = np.array([0.5, 0.5])
AROUND = CENTRE + 0.02 * np.array([[0, 0], [1, 0], [0, 1], [-1, 1], [1, -1], [-1, -1]])


def goal_at(policy: np.ndarray) -> Goal:
    return Goal("place", plane(policy)["place"])


def local(model: NearestModel) -> NelderMeadSearch:
    """A search that never tries a random policy when the goal seems reached."""
    return NelderMeadSearch(model, least_global=0.0)


def test_local_search_starts_from_a_guess_and_does_not_repeat_what_is_remembered() -> None:
    model = remember(PLANE, plane, AROUND)
    search, episode = local(model), episode_for(model, goal_at(CENTRE + 0.001))
    episode.best = 0.0
    search.begin(episode)
    points, values = search.local_data(episode)
    assert values[0] is None
    assert all(value is not None for value in values[1:])
    remembered = {tuple(policy) for policy in AROUND}
    assert all(tuple(point) in remembered for point in points[1:])
    for _ in range(10):
        (policy,) = search.propose([episode])
        assert tuple(policy) not in remembered
        tell(model, search, episode, Trial(policy, plane(policy)))


def test_remembered_vertices_keep_their_cost() -> None:
    model = remember(PLANE, plane, AROUND)
    goal = goal_at(CENTRE + 0.01)
    points, values = local(model).local_data(episode_for(model, goal))
    for point, value in zip(points[1:], values[1:], strict=True):
        cost = np.linalg.norm(plane(point)["place"] - goal.point) / 10
        assert value == pytest.approx(cost, abs=1e-12)


def test_the_guess_is_a_gaussian_weighted_mean_of_the_locality() -> None:
    model = remember(PLANE, plane, AROUND[:3])
    goal = goal_at(AROUND[1])
    points, _ = local(model).local_data(episode_for(model, goal))
    costs = np.array([np.linalg.norm(plane(b)["place"] - goal.point) / 10 for b in AROUND[:3]])
    weights = np.exp(-0.5 * (costs / costs.mean()) ** 2)
    np.testing.assert_allclose(points[0], weights @ AROUND[:3] / weights.sum(), atol=1e-12)


def test_vertices_that_memory_cannot_give_are_small_perturbations_and_are_executed() -> None:
    model = remember(PLANE, plane, [CENTRE])
    search, episode = local(model), episode_for(model, goal_at(CENTRE))
    points, values = search.local_data(episode)
    assert len(points) == 3
    assert values.count(None) >= 1
    unknown = [p for p, value in zip(points, values, strict=True) if value is None]
    assert all(np.abs(p - CENTRE).max() <= search.perturbation + 1e-12 for p in unknown)
    search.begin(episode)
    for expected in unknown:
        (policy,) = search.propose([episode])
        np.testing.assert_allclose(policy, expected, atol=1e-12)
        tell(model, search, episode, Trial(policy, plane(policy)))


def test_far_policies_are_no_part_of_the_locality() -> None:
    far = np.array([0.99, 0.99])
    model = remember(PLANE, plane, [CENTRE, far])
    points, _ = local(model).local_data(episode_for(model, goal_at(CENTRE)))
    assert all(np.linalg.norm(p - far) > 0.5 for p in points)


def test_the_same_policy_is_proposed_until_something_is_told_of_it() -> None:
    model = remember(PLANE, plane, AROUND)
    search, episode = NelderMeadSearch(model), episode_for(model, goal_at(CENTRE))
    search.begin(episode)
    for _ in range(8):
        (policy,) = search.propose([episode])
        assert (search.propose([episode])[0] == policy).all()
        assert (search.propose([episode])[0] == policy).all()
        tell(model, search, episode, Trial(policy, plane(policy)))
        assert (search.propose([episode])[0] != policy).any()


def test_a_refused_policy_counts_as_the_worst() -> None:
    def after(told: str) -> list[list[float]]:
        model = remember(PLANE, plane, AROUND)
        far = Goal("place", plane(CENTRE)["place"] - [0.0, 8.0])  # What is remembered costs 0.8.
        search, episode = local(model), episode_for(model, far)
        episode.best = 0.0
        search.begin(episode)
        proposed = []
        for _ in range(6):
            (policy,) = search.propose([episode])
            proposed.append(policy.tolist())
            if told == "refused":
                search.refuse(episode)
            else:
                search.learn(episode, Trial(policy, {}), -1.0)
        return proposed

    assert after("refused") == after("worst")


def test_while_nothing_is_known_policies_are_random() -> None:
    model = remember(PLANE, plane, [])
    search = NelderMeadSearch(model)
    drawn = []
    for seed in range(200):
        episode = episode_for(model, goal_at(CENTRE), seed=seed)
        search.begin(episode)
        drawn += search.propose([episode])
    np.testing.assert_allclose(np.mean(drawn, axis=0), [0.5, 0.5], atol=0.07)
    np.testing.assert_allclose(np.std(drawn, axis=0), np.sqrt(1 / 12), atol=0.04)


@pytest.mark.parametrize(("best", "share"), [(-0.7, 0.7), (-0.3, 0.3), (0.0, 0.05), (-1.0, 1.0)])
def test_the_share_of_random_policies_is_the_cost_of_the_goal(best: float, share: float) -> None:
    model = remember(PLANE, plane, AROUND)
    search = NelderMeadSearch(model)
    guess = search.local_data(episode_for(model, goal_at(CENTRE)))[0][0]
    count = 0
    for seed in range(400):
        episode = episode_for(model, goal_at(CENTRE), seed=seed)
        episode.best = best
        search.begin(episode)
        count += bool((search.propose([episode])[0] != guess).any())
    assert count / 400 == pytest.approx(share, abs=0.07)


def test_local_search_goes_on_until_the_episode_ends() -> None:
    model = remember(PLANE, plane, AROUND)
    search, episode = local(model), episode_for(model, goal_at(CENTRE + 0.01))
    episode.best = 0.0
    search.begin(episode)
    (policy,) = search.propose([episode])
    episode.best = -1.0  # A new draw would be global for sure.
    for _ in range(15):
        tell(model, search, episode, Trial(policy, plane(policy)))
        episode.best = -1.0
        (policy,) = search.propose([episode])
        assert np.linalg.norm(policy - CENTRE) < 0.1


def test_what_is_proposed_lies_within_the_bounds_even_for_goals_beyond_reach() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 20))
    search, episode = local(model), episode_for(model, Goal("place", np.array([30.0, 30.0])))
    episode.best = 0.0
    search.begin(episode)
    for _ in range(60):
        (policy,) = search.propose([episode])
        PLANE.check_policy(policy)
        tell(model, search, episode, Trial(policy, plane(policy)))


def test_a_goal_is_reached_within_its_tolerance() -> None:
    model = remember(PLANE, plane, AROUND)
    search, episode = local(model), episode_for(model, goal_at(CENTRE))
    for best, reached in ((-0.02, False), (-0.01, True), (0.0, True)):
        episode.best = best
        assert search.finished(episode) is reached


def test_episodes_from_memory_come_ever_closer_to_their_goals() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 10))
    search = NelderMeadSearch(model)
    before, after = [], []
    for seed in range(15):
        goal = goal_at(np.random.default_rng(seed).random(2))
        episode = episode_for(model, goal, seed=seed)
        search.begin(episode)
        for _ in range(20):
            (policy,) = search.propose([episode])
            tell(model, search, episode, Trial(policy, plane(policy)))
        before.append(episode.before)
        after.append(episode.best)
    assert np.mean(after) > 0.4 * np.mean(before)


def test_policies_must_be_vectors() -> None:
    task = Task(Choices(["look"]), PLANE.outcome_spaces)
    with pytest.raises(TypeError, match="Nelder-Mead needs a policy space that is a Box"):
        NelderMeadSearch(remember(task, lambda _: {}, []))
