"""What a teacher is: somebody who can be asked to show how a goal is reached."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from sgim.records import Demonstration, Goal, Outcome


class Teacher(Protocol):
    """Shows movements on request. A teacher keeps no state between requests.

    One that watches the learner has a second method, `WatchingTeacher.observe`; what it shows
    then depends on what it has observed, and on nothing else that went before.
    """

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
        """Show a movement.

        Args:
            goal: What the learner would like to see reached; None to leave it to the teacher.
            rng: This request's own generator.

        Returns:
            The demonstration, or None to decline.
        """
        ...


class WatchingTeacher(Teacher, Protocol):
    """A teacher who sees what the learner's own movements produce."""

    def observe(self, outcome: Outcome) -> None:
        """See what a movement of the learner produced.

        A run calls it for every movement that it tells the learner of, in that order; on resume
        for those recorded, before anything else is asked.
        """
        ...


def let_observe(teacher: Teacher, outcome: Outcome) -> None:
    """Let a teacher see an outcome, if it is a `WatchingTeacher`."""
    observe = getattr(teacher, "observe", None)
    if observe is not None:
        observe(outcome)
