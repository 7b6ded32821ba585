"""What a teacher is: somebody who can be asked to show how a goal is reached."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from sgim.records import Demonstration, Goal


class Teacher(Protocol):
    """Shows movements on request. A teacher keeps no state between requests."""

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
        """Show a movement.

        Args:
            goal: What the learner would like to see reached; None to leave it to the teacher.
            rng: This request's own generator.

        Returns:
            The demonstration, or None to decline.
        """
        ...
