import numpy as np
import pytest

from sgim.environments import ThrowingArm, throwing_teachers
from sgim.environments.throwing import swing
from sgim.environments.throwing_teachers import (
    misread,
    placing_demonstrations,
    select_throws,
    throwing_demonstrations,
)
from sgim.errors import TeacherError
from sgim.records import Goal
from sgim.spaces import FloatArray
from sgim.teachers import DemonstrationSet

ARM = ThrowingArm()


def cells(policies: FloatArray) -> list[tuple[int, int]]:
    throws = np.array([outcome["throw"] for outcome in ARM.execute_batch(policies)])
    scaled = ARM.task.outcome_spaces["throw"].encode(throws)
    assert ((scaled >= 0) & (scaled <= 1)).all()
    return [(int(x), int(y)) for x, y in np.minimum(scaled * (16, 12), (15, 11))]


@pytest.mark.parametrize("count", [1, 10, 30])
def test_t2_comes_to_rest_at_evenly_spread_angles(count: int) -> None:
    demonstrations = placing_demonstrations(count)
    angles = [d.outcome["place"][0] for d in demonstrations]
    expected = [-np.pi + (k + 0.5) * 2 * np.pi / count for k in range(count)]
    np.testing.assert_allclose(angles, expected, atol=1e-12)
    _, speeds = swing(np.array([d.policy for d in demonstrations]))
    assert np.abs(speeds).max() < 1e-12


def test_t2_follows_the_profile() -> None:
    policy = placing_demonstrations(10)[9].policy
    c = policy[0]
    np.testing.assert_array_equal(policy[::2], [c, c, c, 0, -c, -c, -c])
    np.testing.assert_array_equal(policy[1::2], 0.5)
    assert 3 * c == pytest.approx(0.9 * np.pi)


def test_t2_needs_a_demonstration() -> None:
    with pytest.raises(TeacherError, match="count is 0"):
        placing_demonstrations(0)


def test_misreading_flips_the_sixth_and_seventh_accelerations_of_a_copy() -> None:
    policy = np.arange(1.0, 15.0)
    perceived = misread(policy)
    changed = np.flatnonzero(perceived != policy)
    assert changed.tolist() == [10, 12]
    np.testing.assert_array_equal(perceived[changed], -policy[changed])
    np.testing.assert_array_equal(misread(perceived), policy)


def test_t3_shows_the_outcomes_of_t2_with_policies_that_do_not_place() -> None:
    teachers = throwing_teachers()
    for k in range(10):
        goal = Goal("place", np.array([-3.0 + 0.6 * k]))
        right = teachers["T2"].demonstrate(goal, np.random.default_rng(0))
        wrong = teachers["T3"].demonstrate(goal, np.random.default_rng(0))
        assert right is not None
        assert wrong is not None
        assert wrong.outcome["place"] == right.outcome["place"]
        assert set(ARM.execute(right.policy)) == {"place"}
        assert set(ARM.execute(wrong.policy)) == {"throw"}


def test_t1_shows_thirty_throws_of_different_cells() -> None:
    demonstrations = throwing_demonstrations()
    policies = np.array([d.policy for d in demonstrations])
    assert len(set(cells(policies))) == len(demonstrations) == 30
    for demonstration in demonstrations:
        ARM.task.check_policy(demonstration.policy)
        expected = ARM.execute(demonstration.policy)["throw"]
        np.testing.assert_array_equal(demonstration.outcome["throw"], expected)


def test_the_number_of_placing_demonstrations_is_a_parameter() -> None:
    teacher = throwing_teachers(demonstrations=3)["T2"]
    assert isinstance(teacher, DemonstrationSet)
    assert len(teacher) == 3
    assert list(throwing_teachers()) == ["T1", "T2", "T3"]


def test_a_thrower_shows_one_trial_each_of_thirty_cells() -> None:
    policies = np.random.default_rng(0).random((4000, 14))
    policies[:, ::2] = 10 * policies[:, ::2] - 5
    outcomes = ARM.execute_batch(policies)
    chosen = select_throws(policies, outcomes, np.random.default_rng(1))
    assert len(set(cells(chosen))) == len(chosen) == 30
    assert {tuple(p) for p in chosen} <= {tuple(p) for p in policies}
    again = select_throws(policies, outcomes, np.random.default_rng(1))
    other = select_throws(policies, outcomes, np.random.default_rng(2))
    np.testing.assert_array_equal(chosen, again)
    assert not np.array_equal(chosen, other)


def test_throws_out_of_the_box_and_placings_are_not_chosen() -> None:
    strong = np.tile([5.0, 0.9], 7)
    weak = np.tile([0.1, 0.5], 7)
    policies = [strong, np.zeros(14), weak]
    chosen = select_throws(policies, ARM.execute_batch(policies), np.random.default_rng(0), count=1)
    np.testing.assert_array_equal(chosen, [weak])


def test_too_few_cells_are_an_error_that_says_how_many() -> None:
    with pytest.raises(TeacherError, match=r"30 throws .* only 0 cells"):
        select_throws([np.zeros(14)], ARM.execute_batch([np.zeros(14)]), np.random.default_rng(0))
