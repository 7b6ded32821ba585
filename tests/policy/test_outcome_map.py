"""The map over all trials: what it foresees, and that it may be kept up to date in any way."""

import numpy as np
import pytest
from tests.helpers import random_policies

from sgim.environments import PlanarArm
from sgim.policy.learned_smoothness import learned
from sgim.policy.outcome_map import OutcomeMap, with_context
from sgim.policy.smoothness import Smoothness

ARM = PlanarArm(4, noise=0.01)
FIRST, ALL = 64, 110


def trials(count: int = ALL, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Policies and outcomes in the unit box."""
    rng = np.random.default_rng(seed)
    policies = random_policies(ARM.task, count, seed)
    hands = np.array([ARM.execute(policy, None, rng)["hand"] for policy in policies])
    return ARM.task.policy_space.encode(np.array(policies)), ARM.goal_box.encode(hands)


@pytest.fixture(scope="module")
def smoothness() -> Smoothness:
    policies, outcomes = trials(FIRST)
    found = learned(policies, outcomes)
    assert found is not None
    return found


def made(smoothness: Smoothness, *steps: int) -> OutcomeMap:
    """A map of the first trials, extended to so many in turn."""
    policies, outcomes = trials()
    known = OutcomeMap(smoothness, policies[:FIRST], outcomes[:FIRST], 2 * FIRST)
    for step in steps:
        known.extend(policies[known.count : step], outcomes[known.count : step])
    return known


def test_adding_trials_is_the_same_as_knowing_them_from_the_start(smoothness: Smoothness) -> None:
    policies, outcomes = trials()
    known = OutcomeMap(smoothness, policies, outcomes, ALL)
    grown = made(smoothness, ALL)
    asked = trials(20, seed=1)[0]
    for one, other in zip(known.expected(asked), grown.expected(asked), strict=True):
        np.testing.assert_allclose(one, other, atol=2e-3)  # means are those of the first trials


def test_it_makes_no_difference_to_the_last_bit_when_trials_are_added(
    smoothness: Smoothness,
) -> None:
    asked = trials(20, seed=1)[0]
    at_once = made(smoothness, ALL).expected(asked)
    for steps in (tuple(range(FIRST + 1, ALL + 1)), (70, 71, 99, ALL)):
        for one, other in zip(made(smoothness, *steps).expected(asked), at_once, strict=True):
            assert (one == other).all()


def test_it_foresees_outcomes_about_as_well_as_it_says(smoothness: Smoothness) -> None:
    policies, _ = trials(300, seed=2)
    hands = ARM.goal_box.encode(ARM.hands(ARM.task.policy_space.decode(policies)))
    outcomes, unknown = made(smoothness, ALL).expected(policies)
    misses = ((outcomes - hands) ** 2).sum(axis=1)
    assert np.sqrt(misses.mean()) < 0.25 * np.sqrt(hands.var(axis=0).sum())
    said = unknown * smoothness.variance.sum()
    assert 0.2 < misses.mean() / said.mean() < 5
    least = said < np.median(said)
    assert misses[least].mean() < misses[~least].mean()


def test_where_trials_are_it_is_sure_and_far_away_it_is_not(smoothness: Smoothness) -> None:
    policies, _ = trials()
    known = made(smoothness, ALL)
    _, at_trials = known.expected(policies)
    _, away = known.expected(policies + 30 * smoothness.length)
    assert at_trials.max() < 0.2
    assert away.min() > 0.9


def test_it_comes_nearer_to_goals_than_the_policies_that_it_starts_from(
    smoothness: Smoothness,
) -> None:
    policies, outcomes = trials()
    known = made(smoothness, ALL)
    box = ARM.task.policy_space
    ratios = []
    for goal in trials(40, seed=3)[1]:
        near = np.argsort(((outcomes - goal) ** 2).sum(axis=1))[:8]
        policy, expected = known.nearing(goal, np.empty(0), policies[near])
        assert (policy >= 0).all()
        assert (policy <= 1).all()
        hand, first = (
            ARM.goal_box.encode(ARM.hands(box.decode(p[None]))[0])
            for p in (policy, policies[near[0]])
        )
        ratios.append(np.linalg.norm(hand - goal) / np.linalg.norm(first - goal))
        np.testing.assert_allclose(expected, known.expected(policy[None])[0][0])
    assert np.median(ratios) < 0.5


def test_contexts_follow_policies() -> None:
    policies = np.arange(6.0).reshape(3, 2)
    assert with_context(policies, np.empty(0)) is policies
    np.testing.assert_array_equal(with_context(policies, np.array([7.0]))[:, 2], [7, 7, 7])


def test_of_outcomes_that_are_all_the_same_nothing_is_learned() -> None:
    policies = np.random.default_rng(0).random((300, 2))
    assert learned(policies, np.full((300, 2), 0.01)) is None


@pytest.mark.parametrize("constant", [0.5, 0.01])
def test_a_coordinate_that_never_changes_says_nothing_of_the_noise_of_others(
    constant: float,
) -> None:
    rng = np.random.default_rng(0)
    policies = rng.random((300, 2))
    varying = 0.3 + 0.4 * policies[:, :1] + rng.normal(0, 0.02, (300, 1))
    alone = learned(policies, varying)
    beside = learned(policies, np.column_stack((varying, np.full(300, constant))))
    assert alone is not None
    assert beside is not None
    assert alone.trusted
    assert beside.trusted
    assert (beside.noise, beside.even) == (alone.noise, alone.even)
    assert beside.variance.tolist() == [alone.variance[0], 0.0]
