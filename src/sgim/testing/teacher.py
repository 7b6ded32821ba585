"""The suite for teachers."""

from __future__ import annotations

from sgim.demonstrations import checked
from sgim.errors import SgimError
from sgim.records import Demonstration, Goal
from sgim.streams import Streams
from sgim.task import Task
from sgim.teachers.base import Teacher
from sgim.testing.promises import Packed, packed_demonstration, require, succeeds


def check_teacher(teacher: Teacher, task: Task, *, requests: int = 20, seed: int = 0) -> None:
    """Check that a teacher keeps the promises of `sgim.teachers.Teacher`.

    Args:
        teacher: The teacher.
        task: The task it teaches.
        requests: How many demonstrations to ask for; every request is made twice.
        seed: Of the goals, and of the requests' generators.

    Raises:
        AssertionError: If a promise is broken.
    """
    streams = Streams(seed)
    kinds = list(task.goal_spaces)
    goals: list[Goal | None] = []
    for number in range(requests):
        kind = kinds[number % len(kinds)]
        point = task.goal_spaces[kind].sample(streams("testing/goal", number))
        goals.append(None if number % 5 == 0 else Goal(kind, point))
    answers, first = [], []
    for number, goal in enumerate(goals):
        answers.append(_ask(teacher, task, goal, streams, number))
        first.append(_packed(task, answers[number]))
    for number, answer in enumerate(answers):
        require(
            _packed(task, answer) == first[number],
            "a demonstration stays as it was when it was given",
            f"the answer to request {number} changed during later requests",
            "Give a copy, not an array that is written to again",
        )
    # In another order, so that what one request leaves behind for the next one shows.
    for number in streams("testing/order").permutation(requests).tolist():
        again = _packed(task, _ask(teacher, task, goals[number], streams, number))
        require(
            first[number] == again,
            "the same goal and the same generator get the same answer",
            f"request {number}, for {goals[number]!r:.80}, was answered otherwise the second time",
            "Draw random numbers from the request's rng only, and keep no state between requests",
        )


def _ask(
    teacher: Teacher, task: Task, goal: Goal | None, streams: Streams, number: int
) -> Demonstration | None:
    before = _packed_goal(task, goal)
    advice = "Return None to decline"
    if goal is None:
        advice = "A goal of None leaves the choice to the teacher; return None to decline"
    with succeeds(f"a teacher answers every request, also for {goal!r:.80}", advice):
        answer = teacher.demonstrate(goal, streams("testing/request", number))
    require(
        _packed_goal(task, goal) == before,
        "a teacher leaves the goal as it is",
        f"it changed {goal!r:.80}",
        "Work on a copy of goal.point",
    )
    return answer


def _packed(task: Task, answer: Demonstration | None) -> Packed | None:
    if answer is None:
        return None
    try:
        return packed_demonstration(task, checked(task, answer, "under test"))
    except SgimError as error:
        raise AssertionError(
            f"a teacher answers with a Demonstration that the learner can use, or with None, "
            f"but {error}. Make its outcome and its policy or trajectory fit the task."
        ) from error


def _packed_goal(task: Task, goal: Goal | None) -> Packed | None:
    return None if goal is None else (goal.kind, task.goal_spaces[goal.kind].pack(goal.point))
