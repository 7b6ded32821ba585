"""What a run requires of its world and its teachers."""

from __future__ import annotations

from collections.abc import Mapping

from sgim.environments.base import MinimalEnvironment
from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.runs.journal_reading import first_difference
from sgim.teachers import RemoteTeacher, Teacher


def checked_teachers(
    teachers: Mapping[str, Teacher | RemoteTeacher] | None, learner: Learner
) -> tuple[dict[str, Teacher], dict[str, RemoteTeacher]]:
    """The teachers who answer at once, and the persons who answer later, by their names.

    Raises:
        SgimError: If one of them is not a teacher, or one is missing whom the learner asks.
    """
    if not isinstance(teachers or {}, Mapping):
        raise SgimError(
            f"teachers are a {type(teachers).__name__}, expected teachers={{name: teacher}}"
        )
    prompt: dict[str, Teacher] = {}
    persons: dict[str, RemoteTeacher] = {}
    for name, teacher in (teachers or {}).items():
        if isinstance(teacher, RemoteTeacher):
            persons[name] = teacher
            continue
        if isinstance(teacher, type) or not callable(getattr(teacher, "demonstrate", None)):
            raise SgimError(
                f"teacher {name!r} is {teacher!r:.80}, expected an object with "
                "demonstrate(goal, rng); wrap a function of the goal in ScriptedTeacher"
            )
        prompt[name] = teacher
    missing = [name for name in learner.teachers if name not in (teachers or {})]
    if missing:
        raise SgimError(
            f"the learner asks {', '.join(missing)}, but the run has "
            f"{', '.join(teachers or {}) or 'no teachers'}; pass teachers={{name: teacher}}"
        )
    return prompt, persons


def check_world(environment: MinimalEnvironment, learner: Learner) -> None:
    """Require a world of the learner's task.

    Raises:
        SgimError: If it is not one.
    """
    missing = [n for n in ("task", "deterministic", "execute") if not hasattr(environment, n)]
    if missing or isinstance(environment, type):
        raise SgimError(
            f"the world is {environment!r:.80}, expected an object with task, deterministic and "
            "execute(policy, context, rng)"
            + (f"; it lacks {', '.join(missing)}" if missing else "")
        )
    mine, its = learner.task.describe(), environment.task.describe()
    if difference := first_difference(its, mine):
        raise SgimError(
            f"the learner's task is not the world's, taken as recorded: {difference}; make the "
            "learner with the world's task"
        )
