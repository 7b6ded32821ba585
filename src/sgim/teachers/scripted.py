"""Teachers made from a function: a script, or another teacher as the learner misperceives it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sgim.errors import TeacherError
from sgim.records import Demonstration, Goal, Outcome
from sgim.teachers.base import Teacher, let_observe


@dataclass(frozen=True)
class ScriptedTeacher:
    """A teacher programmed by a function.

    Attributes:
        function: From a goal, or None, to a demonstration, or None to decline.
    """

    function: Callable[[Goal | None], Demonstration | None]

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
        """What the function gives for the goal.

        Raises:
            TeacherError: If it gives something other than a demonstration or None.
        """
        shown: Any = self.function(goal)
        if shown is not None and not isinstance(shown, Demonstration):
            raise TeacherError(
                f"a scripted teacher gave a {type(shown).__name__}, "
                "expected a Demonstration, or None to decline"
            )
        return shown


@dataclass(frozen=True)
class CorrespondenceError:
    """A teacher whose movements the learner misperceives, while the outcomes it sees are right.

    Attributes:
        teacher: The teacher who is watched.
        distort: From the policy shown to the policy perceived.
    """

    teacher: Teacher
    distort: Callable[[Any], Any]

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
        """The teacher's demonstration, with its policy distorted.

        Raises:
            TeacherError: If the teacher shows a recorded trajectory instead of a policy.
        """
        shown = self.teacher.demonstrate(goal, rng)
        if shown is None:
            return None
        if shown.policy is None:
            raise TeacherError("only a demonstrated policy can be distorted, got a trajectory")
        return replace(shown, policy=self.distort(shown.policy))

    def observe(self, outcome: Outcome) -> None:
        """Let the teacher see it, if it watches."""
        let_observe(self.teacher, outcome)
