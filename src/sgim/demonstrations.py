"""What a teacher gave, made usable or refused."""

from __future__ import annotations

from typing import Any

from sgim.errors import SgimError, TeacherError
from sgim.records import Demonstration
from sgim.spaces import Box
from sgim.task import Task


def checked(
    task: Task, given: Demonstration, teacher: str, *, needing: str | None = None
) -> Demonstration:
    """Return the demonstration as the learner can use it.

    A trajectory without a policy is mapped to one by the task's primitive (the correspondence,
    thesis eq. 3.7). A policy that exceeds the bounds of its `Box` is clipped to them: it is the
    closest the learner can do; other spaces refuse it.

    Args:
        task: The task.
        given: What the teacher gave.
        teacher: The teacher's name, for the record and for messages.
        needing: Name of the mode that asked for it, if that needs a policy.

    Raises:
        TeacherError: If it is not a demonstration, shows no outcome that could be a goal, has
            no policy where one is needed, or holds a value that is malformed or not finite.
    """
    if not isinstance(given, Demonstration):
        raise TeacherError(
            f"teacher {teacher!r} answered with a {type(given).__name__}, "
            "expected a Demonstration, or None to decline"
        )
    try:
        outcome = task.check_outcome(given.outcome)
        context = None if given.context is None else task.check_context(given.context)
        policy = _policy(task, given)
    except SgimError as error:
        raise TeacherError(
            f"teacher {teacher!r} gave an unusable demonstration: {error}"
        ) from error
    if not outcome:
        raise TeacherError(f"teacher {teacher!r} gave a demonstration without an outcome")
    if needing is not None and policy is None:
        raise TeacherError(
            f"mode {needing!r} needs a demonstration with a policy or a trajectory; this one has "
            "only an outcome"
        )
    return Demonstration(outcome, policy, given.trajectory, teacher, context)


def _policy(task: Task, given: Demonstration) -> Any:
    if given.policy is None:
        if given.trajectory is None:
            return None
        if task.primitive is None:
            raise TeacherError(
                "it is a trajectory, but the task has no primitive to map it to a policy; "
                "pass primitive=… to the task"
            )
        policy, _ = task.primitive.fit(given.trajectory)
    else:
        policy = given.policy
    point = task.policy_space.check(policy, "demonstrated policy")
    if isinstance(task.policy_space, Box):
        return task.policy_space.clip(point)
    return task.check_policy(point)
