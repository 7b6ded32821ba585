import json

import numpy as np
import pytest

from sgim.errors import SpaceError, UnknownNameError
from sgim.spaces import Box, Choices
from sgim.task import Task, task_from_description

THROW = Box([-10, 0], [10, 6], names=["distance", "height"], unit="m")
TASK = Task(
    Box(-1, 1, names=["a", "b"]),
    {"throw": THROW, "word": Choices(["ba", "da"])},
    context_space=Box(0, 5, names=["wind"]),
    tolerances={"throw": 0.05},
    sizes={"word": 6},
)


def test_goals_are_outcomes_unless_said_otherwise() -> None:
    assert TASK.goal_spaces == TASK.outcome_spaces
    labelled = Task(Choices(["look"]), {"picture": THROW}, goal_spaces={"toy": Choices(["dog"])})
    assert list(labelled.goal_spaces) == ["toy"]
    assert labelled.check_goal("toy", "dog").point == "dog"
    assert labelled.check_outcome({"picture": [0, 0]})["picture"].tolist() == [0, 0]


def test_tolerances_and_sizes_have_defaults_for_every_goal_kind() -> None:
    assert TASK.tolerances == {"throw": 0.05, "word": 0.01}
    assert TASK.sizes == {"throw": 1.0, "word": 6.0}


@pytest.mark.parametrize("value", [0, -1, float("nan")])
def test_tolerances_and_sizes_must_be_positive(value: float) -> None:
    with pytest.raises(SpaceError, match=r"tolerance of 'throw' is .*, expected a positive number"):
        Task(THROW, {"throw": THROW}, tolerances={"throw": value})
    with pytest.raises(SpaceError, match=r"size of 'throw' is .*, expected a positive number"):
        Task(THROW, {"throw": THROW}, sizes={"throw": value})


def test_a_tolerance_for_an_unknown_kind_suggests_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match=r"tolerance.*Did you mean 'throw'"):
        Task(THROW, {"throw": THROW}, tolerances={"thrown": 0.1})


def test_a_task_needs_an_outcome() -> None:
    with pytest.raises(SpaceError, match="one or more outcome spaces"):
        Task(THROW, {})


def test_policies_must_lie_within_their_bounds() -> None:
    assert TASK.check_policy([1, -1]).tolist() == [1.0, -1.0]
    with pytest.raises(SpaceError, match="outside the bounds"):
        TASK.check_policy([1.1, 0])
    with pytest.raises(SpaceError, match=r"policy has shape \(1,\), expected \(2,\)"):
        TASK.check_policy([1.0])


def test_outcomes_may_lie_outside_their_box_and_kinds_may_be_missing() -> None:
    outcome = TASK.check_outcome({"throw": [50, 99]})
    assert outcome["throw"].tolist() == [50.0, 99.0]
    assert TASK.check_outcome({}) == {}
    assert TASK.check_outcome({"word": "ba", "throw": (1, 2)})["word"] == "ba"


@pytest.mark.parametrize("outcome", [None, 3, [1.0, 2.0], np.zeros(2)])
def test_an_outcome_that_is_no_mapping_is_refused_with_the_kinds(outcome: object) -> None:
    with pytest.raises(SpaceError, match=r"expected a mapping kind → point .* throw, word"):
        TASK.check_outcome(outcome)  # type: ignore[arg-type]


def test_an_unknown_kind_suggests_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match=r"outcome kind 'thro'\. Did you mean 'throw'"):
        TASK.check_outcome({"thro": [0, 0]})
    with pytest.raises(UnknownNameError, match="goal kind 'word '"):
        TASK.check_goal("word ", "ba")


def test_a_malformed_point_is_refused_by_its_kind() -> None:
    with pytest.raises(SpaceError, match=r"outcome 'throw' has shape \(3,\)"):
        TASK.check_outcome({"word": "ba", "throw": [0, 0, 0]})
    with pytest.raises(SpaceError, match="goal 'word': unknown label"):
        TASK.check_goal("word", "do")
    with pytest.raises(SpaceError, match="outcome 'throw' has nan at 'height'"):
        TASK.check_outcome({"throw": [0, np.nan]})


def test_a_context_must_come_exactly_where_the_task_has_one() -> None:
    assert TASK.check_context([2]).tolist() == [2.0]
    with pytest.raises(SpaceError, match="pass context="):
        TASK.check_context(None)
    without = Task(THROW, {"throw": THROW})
    assert without.check_context(None) is None
    with pytest.raises(SpaceError, match="no context space"):
        without.check_context([2.0])


@pytest.mark.parametrize(
    "task",
    [TASK, Task(THROW, {"throw": THROW}), Task(THROW, {"a": THROW}, goal_spaces={"b": Box(0, 1)})],
)
def test_a_task_is_made_again_from_its_description(task: Task) -> None:
    description = json.loads(json.dumps(task.describe()))
    again = task_from_description(description)
    assert again.describe() == task.describe()
    assert list(again.goal_spaces) == list(task.goal_spaces)
    assert (again.context_space is None) == (task.context_space is None)


def test_tasks_that_differ_are_described_differently() -> None:
    spaces = {"throw": THROW}
    tasks = [
        Task(THROW, spaces),
        Task(Box(0, 1), spaces),
        Task(THROW, {"place": THROW}),
        Task(THROW, spaces, goal_spaces={"throw": Box([0, 0], [1, 1])}),
        Task(THROW, spaces, context_space=Box(0, 1)),
        Task(THROW, spaces, tolerances={"throw": 0.1}),
        Task(THROW, spaces, sizes={"throw": 6}),
    ]
    assert len({json.dumps(t.describe()) for t in tasks}) == len(tasks)


def test_a_policy_at_rest_is_part_of_the_task() -> None:
    resting = Task(TASK.policy_space, {"throw": THROW}, rest=[0.1, -0.25])
    assert resting.rest.tolist() == [0.1, -0.25]
    again = task_from_description(json.loads(json.dumps(resting.describe())))
    assert again.rest.tolist() == [0.1, -0.25]
    assert again.describe() == resting.describe()
    assert "rest" not in TASK.describe()
    with pytest.raises(SpaceError, match="outside the bounds"):
        Task(TASK.policy_space, {"throw": THROW}, rest=[0.1, -2.0])
