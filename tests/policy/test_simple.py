from typing import Any

import numpy as np
import pytest
from tests.helpers import PLANE, episode_for, plane, random_policies, remember

from sgim.errors import TeacherError
from sgim.policy.explorer import Episode
from sgim.policy.simple import Mimicry, NoisyNearest, RandomPolicies, in_ball
from sgim.records import Demonstration, Goal, Trajectory
from sgim.spaces import Box, Choices
from sgim.task import Task

WIDE = Box([0, 0, 0], [100, 1, 1])
CENTRE = np.array([50.0, 0.5, 0.5])


def shown(policy: Any, seed: int = 0) -> Episode:
    episode = Episode(0, None, None, np.random.default_rng(seed))
    episode.demonstration = Demonstration({"place": np.zeros(2)}, policy)
    return episode


def variations(explorer: Mimicry, policy: Any, count: int) -> np.ndarray:
    episode = shown(policy)
    explorer.begin(episode)
    return np.array([explorer.propose([episode])[0] for _ in range(count)])


def test_variations_lie_in_a_ball_around_the_demonstrated_policy() -> None:
    drawn = variations(Mimicry(WIDE, 0.2), CENTRE, 2000)
    distances = np.linalg.norm(drawn - CENTRE, axis=1)
    assert distances.max() <= 0.2
    assert distances.max() > 0.19


def test_variations_fill_the_ball_uniformly() -> None:
    distances = np.linalg.norm(variations(Mimicry(WIDE, 0.2), CENTRE, 4000) - CENTRE, axis=1)
    # In three dimensions, half the ball's volume lies within the cube root of a half.
    assert np.mean(distances < 0.2 * 0.5 ** (1 / 3)) == pytest.approx(0.5, abs=0.03)
    assert np.mean(distances < 0.1) == pytest.approx(1 / 8, abs=0.02)


@pytest.mark.parametrize("dimension", [1, 2, 14])
def test_draws_in_the_unit_ball_have_the_right_radii_and_no_direction(dimension: int) -> None:
    rng = np.random.default_rng(0)
    drawn = np.array([in_ball(rng, dimension) for _ in range(3000)])
    radii = np.linalg.norm(drawn, axis=1)
    assert radii.max() <= 1.0
    assert np.quantile(radii**dimension, [0.25, 0.5, 0.75]) == pytest.approx(
        [0.25, 0.5, 0.75], abs=0.04
    )
    np.testing.assert_allclose(drawn.mean(axis=0), 0, atol=0.05)


def test_a_scaled_radius_is_a_share_of_each_range() -> None:
    drawn = (variations(Mimicry(WIDE, 0.2, scaled=True), CENTRE, 2000) - CENTRE) / WIDE.range
    distances = np.linalg.norm(drawn, axis=1)
    assert 0.19 < distances.max() <= 0.2 + 1e-12
    assert np.ptp(drawn[:, 0]) == pytest.approx(0.4, abs=0.04)


def test_variations_are_clipped_to_the_bounds() -> None:
    corner = np.array([0.0, 1.0, 0.0])
    drawn = variations(Mimicry(WIDE, 0.2), corner, 100)
    assert all(WIDE.contains(policy) for policy in drawn)
    assert (drawn[:, 1] == 1.0).any()


def test_the_first_repetition_can_be_exact() -> None:
    explorer = Mimicry(WIDE, 0.2, exact_first=True)
    episode = shown(CENTRE)
    explorer.begin(episode)
    assert (explorer.propose([episode])[0] == CENTRE).all()
    episode.attempts = 1
    assert (explorer.propose([episode])[0] != CENTRE).any()


def test_without_a_radius_repetitions_are_exact() -> None:
    assert (variations(Mimicry(WIDE, 0.0), CENTRE, 3) == CENTRE).all()


def test_mimicry_changes_no_demonstration() -> None:
    policy = CENTRE.copy()
    variations(Mimicry(WIDE, 0.2), policy, 10)
    assert (policy == CENTRE).all()


def test_policies_that_are_no_vectors_are_repeated_as_they_are() -> None:
    explorer = Mimicry(Choices(["push", "lift"]), 0.2)
    episode = shown("lift")
    explorer.begin(episode)
    assert explorer.propose([episode, episode]) == ["lift", "lift"]


@pytest.mark.parametrize(
    "demonstration",
    [
        None,
        Demonstration({"place": np.zeros(2)}),
        Demonstration({"place": np.zeros(2)}, trajectory=Trajectory([0, 1], [[0], [1]], ["a"])),
    ],
)
def test_mimicry_needs_a_policy(demonstration: Demonstration | None) -> None:
    episode = shown(None)
    episode.demonstration = demonstration
    with pytest.raises(TeacherError, match="needs a demonstration with a policy"):
        Mimicry(WIDE, 0.2).begin(episode)


def test_mimicry_and_random_policies_never_end_early() -> None:
    episode = shown(CENTRE)
    episode.best = 0.0
    assert not Mimicry(WIDE, 0.2).finished(episode)
    assert not RandomPolicies(WIDE).finished(episode)


def test_random_policies_are_drawn_from_the_whole_space() -> None:
    episode = Episode(0, None, None, np.random.default_rng(0))
    drawn = np.array(RandomPolicies(WIDE).propose([episode] * 2000))
    np.testing.assert_allclose(WIDE.encode(drawn).mean(axis=0), 0.5, atol=0.03)
    assert np.ptp(drawn[:, 0]) > 99
    assert set(RandomPolicies(Choices("ab")).propose([episode] * 50)) == {"a", "b"}


def test_noise_around_the_nearest_policy_is_a_share_of_each_range() -> None:
    task = Task(WIDE, {"place": Box([0, 0], [10, 10])})
    remembered = [CENTRE] + [np.array([90.0, 0.9, 0.9])] * 20
    model = remember(task, lambda b: {"place": b[1:] * 10}, remembered)
    goal = Goal("place", np.array([5.1, 5.1]))
    explorer, episode = NoisyNearest(model, noise=0.05, bootstrap=0), episode_for(model, goal)
    drawn = WIDE.encode(np.array(explorer.propose([episode] * 2000)))
    np.testing.assert_allclose(drawn.mean(axis=0), [0.5, 0.5, 0.5], atol=0.01)
    np.testing.assert_allclose(drawn.std(axis=0), 0.05, atol=0.005)


def test_noise_around_the_nearest_policy_is_clipped_to_the_bounds() -> None:
    model = remember(PLANE, plane, [np.array([1.0, 0.0])] * 20)
    explorer = NoisyNearest(model, noise=0.3)
    episode = episode_for(model, Goal("place", np.array([5.0, 5.0])))
    assert all(PLANE.policy_space.contains(b) for b in explorer.propose([episode] * 100))


def test_until_the_kind_was_produced_policies_are_random() -> None:
    model = remember(PLANE, lambda b: {}, random_policies(PLANE, 30))
    episode = episode_for(model, Goal("place", np.array([5.0, 5.0])))
    drawn = np.array(NoisyNearest(model).propose([episode] * 500))
    np.testing.assert_allclose(drawn.std(axis=0), np.sqrt(1 / 12), atol=0.03)


def test_labels_are_kept_mostly_and_sometimes_drawn_anew() -> None:
    task = Task(Choices(["a", "b", "c"]), {"place": Box(0, 1)})
    model = remember(task, lambda b: {"place": np.array([0.5])}, ["b"] * 30)
    explorer = NoisyNearest(model, noise=0.3)
    drawn = explorer.propose([episode_for(model, Goal("place", np.array([0.5])))] * 1000)
    assert drawn.count("b") / 1000 == pytest.approx(0.8, abs=0.04)
    assert set(drawn) == {"a", "b", "c"}
