import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.errors import SpaceError, TeacherError
from sgim.records import Demonstration, Goal, Trajectory
from sgim.spaces import Box, Choices
from sgim.task import Task
from sgim.teachers import DemonstrationSet

TASK = Task(
    Box(-1, 1),
    {
        "wide": Box([-100, 0], [100, 1]),
        "label": Choices(["red", "green", "blue"]),
        "never": Box(0, 1),
    },
)


def shown(policy: float, **outcome: object) -> Demonstration:
    return Demonstration(outcome=outcome, policy=[policy])


TEACHER = DemonstrationSet(
    [
        shown(0.1, label="red"),
        shown(0.2, wide=[-50.0, 0.0]),
        shown(0.3, wide=[-50.0, 0.9], label="blue"),
        shown(0.4, wide=[60.0, 0.5]),
    ],
    TASK,
)


def answer(goal: Goal | None, seed: int = 0) -> float:
    return float(TEACHER.demonstrate(goal, np.random.default_rng(seed)).policy[0])


def test_the_nearest_outcome_is_shown() -> None:
    assert answer(Goal("wide", np.array([-50.0, 0.2]))) == 0.2
    assert answer(Goal("wide", np.array([55.0, 0.5]))) == 0.4


def test_nearest_is_measured_in_the_unit_box() -> None:
    # In metres the second demonstration is nearer; in the unit box the third is.
    assert answer(Goal("wide", np.array([-49.0, 0.8]))) == 0.3
    assert answer(Goal("wide", np.array([-40.0, 0.8]))) == 0.3


def test_of_equally_near_outcomes_the_first_is_shown() -> None:
    twice = DemonstrationSet([shown(0.1, never=[0.4]), shown(0.2, never=[0.6])], TASK)
    shown_first = twice.demonstrate(Goal("never", np.array([0.5])), np.random.default_rng(0))
    assert shown_first.policy == [0.1]


def test_labels_are_matched() -> None:
    assert answer(Goal("label", "blue")) == 0.3
    assert answer(Goal("label", "red")) == 0.1


@given(st.lists(st.floats(-100, 100), min_size=1, max_size=10), st.floats(-100, 100))
def test_no_demonstration_is_nearer_than_the_one_shown(places: list[float], goal: float) -> None:
    teacher = DemonstrationSet([shown(0.0, wide=[x, 0.5]) for x in places], TASK)
    given_one = teacher.demonstrate(Goal("wide", np.array([goal, 0.5])), np.random.default_rng(0))
    gap = abs(given_one.outcome["wide"][0] - goal)
    assert gap <= min(abs(x - goal) for x in places) + 1e-9


@pytest.mark.parametrize("goal", [None, Goal("never", np.array([0.5])), Goal("unheard", 3)])
def test_without_a_demonstration_of_the_kind_one_is_drawn_at_random(goal: Goal | None) -> None:
    answers = [answer(goal, seed) for seed in range(40)]
    assert set(answers) == {0.1, 0.2, 0.3, 0.4}
    assert answers == [answer(goal, seed) for seed in range(40)]


def test_points_are_checked_when_the_set_is_made() -> None:
    assert TEACHER.demonstrations[1].outcome["wide"].dtype == np.float64
    assert len(TEACHER) == 4


@pytest.mark.parametrize(
    ("demonstration", "message"),
    [
        (shown(0.0, wide=[1.0]), r"demonstration 1: outcome 'wide' has shape \(1,\)"),
        (shown(0.0, wilde=[1.0, 0.0]), "demonstration 1: .*Did you mean 'wide'"),
        (shown(2.0, wide=[1.0, 0.0]), "demonstration 1: .*outside the bounds"),
        (Demonstration(outcome={}), "demonstration 1 has neither"),
    ],
)
def test_a_malformed_demonstration_is_refused_by_its_number(
    demonstration: Demonstration, message: str
) -> None:
    with pytest.raises(TeacherError, match=message):
        DemonstrationSet([shown(0.0), demonstration], TASK)


def test_an_empty_set_is_refused() -> None:
    with pytest.raises(TeacherError, match="one or more"):
        DemonstrationSet([], TASK)


def test_a_malformed_goal_is_refused() -> None:
    with pytest.raises(SpaceError, match="goal 'wide' has shape"):
        answer(Goal("wide", np.zeros(3)))


def test_a_trajectory_can_be_shown_instead_of_a_policy() -> None:
    trajectory = Trajectory([0, 1], [[0], [1]], ["elbow"])
    teacher = DemonstrationSet([Demonstration(outcome={}, trajectory=trajectory)], TASK)
    assert teacher.demonstrate(None, np.random.default_rng(0)).trajectory is trajectory
