"""A teacher with a fixed repertoire, who shows what comes nearest to the goal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sgim.errors import SgimError, TeacherError
from sgim.records import Demonstration, Goal
from sgim.spaces import FloatArray
from sgim.task import Task


class DemonstrationSet:
    """A set of demonstrations, answered from by nearest outcome (section 4.3.3.3).

    Asked for a goal, it shows the demonstration whose outcome is nearest to it in the unit box,
    the first of those equally near. Asked for nothing in particular, for a kind of which it has
    no demonstration, or of which the points cannot be encoded, it shows one at random.

    Args:
        demonstrations: One or more.
        task: The task they are for; outcomes and policies are checked by it.

    Attributes:
        demonstrations: The demonstrations, as checked.

    Raises:
        TeacherError: If there is no demonstration, one has neither policy nor trajectory, or
            one does not belong to the task.
    """

    def __init__(self, demonstrations: Sequence[Demonstration], task: Task) -> None:
        if not demonstrations:
            raise TeacherError("a demonstration set needs one or more demonstrations, got none")
        self.demonstrations = tuple(_checked(d, i, task) for i, d in enumerate(demonstrations))
        self._spaces = task.outcome_spaces
        self._indices: dict[str, list[int]] = {}
        self._outcomes: dict[str, FloatArray] = {}
        for kind, space in self._spaces.items():
            having = [i for i, d in enumerate(self.demonstrations) if kind in d.outcome]
            if having and space.dimension is not None:
                points = [space.encode(self.demonstrations[i].outcome[kind]) for i in having]
                self._indices[kind] = having
                self._outcomes[kind] = np.array(points)

    def __len__(self) -> int:
        return len(self.demonstrations)

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration:
        """The demonstration nearest to the goal, or a random one; see the class."""
        if goal is None or goal.kind not in self._outcomes:
            return self.demonstrations[int(rng.integers(len(self.demonstrations)))]
        space = self._spaces[goal.kind]
        target = space.encode(space.check(goal.point, f"goal {goal.kind!r}"))
        distances = ((self._outcomes[goal.kind] - target) ** 2).sum(axis=1)
        return self.demonstrations[self._indices[goal.kind][int(distances.argmin())]]


def _checked(demonstration: Demonstration, index: int, task: Task) -> Demonstration:
    if demonstration.policy is None and demonstration.trajectory is None:
        raise TeacherError(f"demonstration {index} has neither a policy nor a trajectory")
    policy = demonstration.policy
    try:
        return replace(
            demonstration,
            outcome=task.check_outcome(demonstration.outcome),
            policy=None if policy is None else task.check_policy(policy),
        )
    except SgimError as error:
        raise TeacherError(f"demonstration {index}: {error}") from error
