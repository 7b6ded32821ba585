"""Using what was learned: the questions that a learner answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sgim.errors import SgimError
from sgim.policy.model import CompetenceModel, InverseModel
from sgim.records import Solution
from sgim.task import Task


class Answers:
    """Asks a model on behalf of whoever uses what was learned.

    Attributes:
        task: The spaces of the world.
        model: What has been learned.
    """

    task: Task
    model: CompetenceModel

    def competence(self, kind: str, point: Any, context: Any = None) -> float:
        """Competence for a goal, in the model's range ([−1, 0] for memories)."""
        goal = self.task.check_goal(kind, point)
        return self.model.competence(goal, self.task.check_context(context))

    def best_policy(self, kind: str, point: Any, context: Any = None) -> Any:
        """The policy to execute for a goal; `NoAnswerError` if nothing is known."""
        goal = self.task.check_goal(kind, point)
        return self._inverse.best_policy(goal, self.task.check_context(context))

    def best_policies(
        self, kind: str, points: Sequence[Any], contexts: Sequence[Any] | None = None
    ) -> list[Any]:
        """As `best_policy` for many goals of a kind at once; None where nothing is known."""
        goals = self.task.check_goals(kind, points)
        checked: list[Any] = [None] * len(goals)
        if contexts is not None or self.task.context_space is not None:
            given = checked if contexts is None else contexts
            checked = [self.task.check_context(context) for context in given]
        return self._inverse.best_policies(goals, checked)

    def solve(self, kind: str, point: Any, context: Any = None) -> Solution:
        """The policy for a goal, what it should produce, and how sure that is."""
        goal = self.task.check_goal(kind, point)
        return self._inverse.solve(goal, self.task.check_context(context))

    @property
    def _inverse(self) -> InverseModel:
        if not isinstance(self.model, InverseModel):
            raise SgimError(f"{type(self.model).__name__} does not answer with policies")
        return self.model
