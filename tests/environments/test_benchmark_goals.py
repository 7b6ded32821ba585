import numpy as np
import pytest
from scipy.optimize import least_squares

from sgim.environments import ARMS, ThrowingArm, reachable_goals, throwing_goals
from sgim.environments.make_data import ARM_GOALS, one_point_per_tile
from sgim.errors import UnknownNameError
from sgim.spaces import FloatArray


def points(goals: list, kind: str) -> FloatArray:  # type: ignore[type-arg]
    return np.array([goal.point for goal in goals if goal.kind == kind])


def test_throwing_goals_are_throws_in_different_tiles_of_the_box() -> None:
    throws = points(throwing_goals(), "throw")
    scaled = ThrowingArm().task.outcome_spaces["throw"].encode(throws)
    assert ((scaled >= 0) & (scaled < 1)).all()
    tiles = {(int(x), int(y)) for x, y in scaled * (20, 15)}
    assert len(tiles) == len(throws)
    assert 250 <= len(throws) <= 300


def test_throwing_goals_end_with_a_hundred_even_angles() -> None:
    angles = points(throwing_goals(), "place")[:, 0]
    assert len(angles) == 100
    np.testing.assert_allclose(np.diff(angles), 2 * np.pi / 100)
    assert angles[0] + np.pi == pytest.approx(np.pi - angles[-1])


@pytest.mark.parametrize("name", ARMS)
def test_about_a_hundred_goals_spread_over_what_the_arm_reaches(name: str) -> None:
    arm = ARMS[name]
    goals = points(reachable_goals(name), "hand")
    assert abs(len(goals) - ARM_GOALS) <= 10
    assert all(arm.task.outcome_spaces["hand"].contains(goal) for goal in goals)
    assert np.hypot(*goals.T).max() <= 1 + 1e-6
    postures = np.random.default_rng(5).uniform(-arm.limit, arm.limit, (2000, arm.joints))
    reached = arm.hands(postures)
    inside = reached[[arm.goal_box.contains(hand) for hand in reached]]
    gaps = np.linalg.norm(inside[:, None] - goals, axis=2).min(axis=1)
    assert np.quantile(gaps, 0.99) < 0.2


@pytest.mark.parametrize("name", ["2-tight", "7-tight"])
def test_goals_of_an_arm_can_be_reached_within_its_limits(name: str) -> None:
    arm = ARMS[name].without_noise()
    starts = np.random.default_rng(0).uniform(-arm.limit, arm.limit, (3000, arm.joints))
    hands = arm.hands(starts)
    for goal in points(reachable_goals(name), "hand")[::5]:

        def miss(posture: FloatArray, goal: FloatArray = goal) -> FloatArray:
            gap: FloatArray = arm.hands([posture])[0] - goal
            return gap

        nearest = starts[np.linalg.norm(hands - goal, axis=1).argsort()[:4]]
        found = [least_squares(miss, start, bounds=(-arm.limit, arm.limit)) for start in nearest]
        assert min(np.abs(result.fun).max() for result in found) < 1e-4


def test_goals_of_an_unknown_arm_are_refused_with_the_nearest_name() -> None:
    with pytest.raises(UnknownNameError, match="Did you mean '7-tight'"):
        reachable_goals("7-tigth")


def test_a_tile_gives_its_middlemost_point_if_reached_twice() -> None:
    pool = np.array([[0.1, 0.1], [0.4, 0.6], [1.5, 0.5], [2.5, 0.5], [-0.5, 0.5], [0.9, 0.9]])
    chosen = one_point_per_tile(pool, np.zeros(2), np.ones(2), (2, 1), 2)
    np.testing.assert_array_equal(chosen, [[0.4, 0.6]])
