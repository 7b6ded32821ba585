"""The joint mixture of policies and outcomes: it learns to reach, and never proposes nonsense."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.helpers import PLANE, plane

from sgim.memory import Memory
from sgim.policy import (
    AroundRest,
    Episode,
    Learning,
    MixtureModel,
    MixtureSearch,
    NearestModel,
    NoAnswerError,
)
from sgim.policy.mixture_search import Bounds, within
from sgim.records import Goal, Trial
from sgim.spaces import Box, Choices
from sgim.streams import Streams
from sgim.task import Task

SMALL = Learning(components=4, every=50, lifetime=1000)


def learned(trials: int, seed: int = 0, *, task: Task = PLANE) -> MixtureModel:
    model = MixtureModel(task, Streams(seed), SMALL)
    rng = np.random.default_rng(seed)
    for _ in range(trials):
        policy = task.policy_space.sample(rng)
        model.update(Trial(policy, plane(policy)))
    return model


def test_a_linear_world_is_inverted_after_a_few_updates() -> None:
    model = learned(200)
    for point in ([4.0, 5.0], [5.0, 6.0], [3.0, 4.0]):
        goal = Goal("place", np.array(point))
        reached = plane(model.best_policy(goal, None))["place"]
        assert np.abs(reached - point).max() < 0.3
        solution = model.solve(goal, None)
        assert np.abs(solution.expected - point).max() < 0.3
        assert solution.reachable
    assert not model.solve(Goal("place", np.array([9.9, 0.1])), None).reachable


def test_a_mixture_is_learned_at_every_so_manieth_trial_and_not_between() -> None:
    assert learned(49).inverse("place") is None
    with pytest.raises(NoAnswerError, match="no mixture has been learned"):
        learned(49).best_policy(Goal("place", np.array([1.0, 1.0])), None)
    model = learned(99)
    before = model.kinds["place"].mixture
    policy = np.array([0.5, 0.5])
    model.update(Trial(policy, {}))  # Produced nothing, and counts.
    assert model.kinds["place"].mixture is not before
    assert len(model.recent("place")) == 49


def test_competence_is_what_a_trial_shows() -> None:
    model = learned(100)
    goal = Goal("place", np.array([4.0, 5.0]))
    trial = Trial(np.zeros(2), {"place": np.array([4.0, 7.0])})
    assert model.shown_by(trial, goal, None) == pytest.approx(math.exp(-2) - 1)
    assert model.shown_by(Trial(np.zeros(2), {}), goal, None) == -1.0
    assert model.competence(goal, None) == -1.0
    scaled = MixtureModel(PLANE, Streams(0), SMALL, scaled=True)
    assert scaled.shown_by(trial, goal, None) == pytest.approx(math.exp(-0.4) - 1)


def test_answers_may_come_from_the_nearest_remembered_trial() -> None:
    nearest = NearestModel(Memory(PLANE))
    model = MixtureModel(PLANE, Streams(0), SMALL, nearest=nearest)
    policy = np.array([0.2, 0.9])
    model.update(Trial(policy, plane(policy)))
    goal = Goal("place", plane(policy)["place"])
    assert model.best_policy(goal, None).tolist() == policy.tolist()
    assert model.solve(goal, None).cost == 0.0


def test_a_world_that_stays_silent_gives_policies_all_the_same() -> None:
    model = MixtureModel(PLANE, Streams(0), SMALL)
    around = AroundRest(PLANE, 0.05)
    search = MixtureSearch(model, around)
    for number in range(300):
        episode = Episode(number, Goal("place", np.zeros(2)), None, np.random.default_rng(number))
        policy = PLANE.check_policy(search.propose([episode])[0])
        model.update(Trial(policy, {"place": np.zeros(2)}))
    far = Goal("place", np.array([10.0, 10.0]))
    PLANE.check_policy(model.best_policy(far, None))
    assert np.isfinite(model.solve(far, None).spread).all()


def test_outcomes_of_a_world_that_diverged_do_not_spoil_what_is_learned() -> None:
    model = learned(100)
    for number in range(50):
        point = np.array([1e100, -1e90]) if number % 2 else np.array([4.0, 5.0])
        model.update(Trial(np.array([0.5, 0.5]), {"place": point}))
    PLANE.check_policy(model.best_policy(Goal("place", np.array([4.0, 5.0])), None))


def test_first_trials_are_drawn_around_the_policy_at_rest() -> None:
    task = Task(Box([-3, 0], [3, 1]), {"place": Box(0, 1)}, rest=[1.5, 0.25])
    episodes = [Episode(i, None, None, np.random.default_rng(i)) for i in range(2000)]
    policies = np.array(AroundRest(task, 0.1).propose(episodes))
    np.testing.assert_allclose(policies.mean(axis=0), [1.5, 0.25], atol=0.05)
    np.testing.assert_allclose(policies.std(axis=0), [0.6, 0.1], rtol=0.1)
    middle = np.array(AroundRest(PLANE, 0.1).propose(episodes)).mean(axis=0)
    np.testing.assert_allclose(middle, 0.5, atol=0.02)


@pytest.mark.parametrize("bounds", ["clip", "reflect"])
def test_what_is_drawn_outside_is_brought_within(bounds: Bounds) -> None:
    vectors = np.array([-1e90, -2.3, -0.2, 0.0, 0.4, 1.0, 1.3, 2.0, 5.1, 1e18, 1e90])
    brought = within(vectors, bounds)
    assert ((brought >= 0) & (brought <= 1)).all()
    np.testing.assert_array_equal(brought[3:6], vectors[3:6])
    expected = [0.0, 1.0] if bounds == "clip" else [0.2, 0.7]
    np.testing.assert_allclose(brought[[2, 6]], expected)


def test_what_is_no_vector_is_refused() -> None:
    with pytest.raises(TypeError, match="outcome 'word' space that is a Box"):
        MixtureModel(Task(Box(0, 1), {"word": Choices(["a"])}), Streams(0))
    with pytest.raises(TypeError, match="a space that is a Box"):
        AroundRest(Task(Choices(["a"]), {"place": Box(0, 1)}), 0.1)
