import numpy as np
import pytest

from sgim.errors import TeacherError
from sgim.records import Demonstration, Goal, Outcome, Trajectory
from sgim.teachers import CorrespondenceError, ScriptedTeacher

RNG = np.random.default_rng(0)


def script(goal: Goal | None) -> Demonstration | None:
    if goal is None:
        return None
    return Demonstration(outcome={"place": goal.point}, policy=2 * goal.point)


def test_a_scripted_teacher_shows_what_its_function_gives() -> None:
    shown = ScriptedTeacher(script).demonstrate(Goal("place", np.array([0.5])), RNG)
    assert shown is not None
    assert shown.policy == [1.0]


def test_a_scripted_teacher_may_decline() -> None:
    assert ScriptedTeacher(script).demonstrate(None, RNG) is None


def test_a_script_that_gives_something_else_is_named() -> None:
    teacher = ScriptedTeacher(lambda goal: np.zeros(2))  # type: ignore[arg-type, return-value]
    with pytest.raises(TeacherError, match="gave a ndarray, expected a Demonstration"):
        teacher.demonstrate(None, RNG)


def test_a_correspondence_error_distorts_the_policy_and_leaves_the_outcome() -> None:
    teacher = CorrespondenceError(ScriptedTeacher(script), lambda policy: -policy)
    shown = teacher.demonstrate(Goal("place", np.array([0.5])), RNG)
    assert shown is not None
    assert shown.policy == [-1.0]
    assert shown.outcome["place"] == [0.5]


def test_a_misperceived_teacher_may_decline() -> None:
    teacher = CorrespondenceError(ScriptedTeacher(script), lambda policy: -policy)
    assert teacher.demonstrate(None, RNG) is None


def test_a_trajectory_cannot_be_distorted() -> None:
    trajectory = Trajectory([0, 1], [[0], [1]], ["elbow"])
    films = ScriptedTeacher(lambda goal: Demonstration(outcome={}, trajectory=trajectory))
    with pytest.raises(TeacherError, match="got a trajectory"):
        CorrespondenceError(films, lambda policy: policy).demonstrate(None, RNG)


def test_a_misperceived_teacher_still_watches_the_learner() -> None:
    seen = []

    class Watching(ScriptedTeacher):
        def observe(self, outcome: Outcome) -> None:
            seen.append(outcome)

    CorrespondenceError(Watching(script), lambda policy: policy).observe({"place": 0.5})
    CorrespondenceError(ScriptedTeacher(script), lambda policy: policy).observe({"place": 0.7})
    assert seen == [{"place": 0.5}]
