"""Using what was learned: the questions that a learner answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sgim.errors import SgimError
from sgim.policy.answering import Answering
from sgim.policy.competence import CompetenceModel, InverseModel
from sgim.policy.model import NearestModel
from sgim.policy.ways import answering_of
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

    def solve(
        self, kind: str, point: Any, context: Any = None, *, radius: float | None = None
    ) -> Solution:
        """The policy for a goal, what it should produce, and how sure that is.

        Args:
            kind: The goal's kind.
            point: The goal.
            context: The context, if the task has contexts.
            radius: How near, as a distance in the unit box, counts as reached; the model's choice
                if not said.

        Raises:
            NoAnswerError: If nothing is known.
        """
        goal = self.task.check_goal(kind, point)
        return self._inverse.solve(goal, self.task.check_context(context), radius)

    def declare_deterministic(self) -> None:
        """Rely on it that a policy always has the outcome that it had: the world says so.

        A `Run` says it for worlds that are ``deterministic``. Otherwise whether there is noise is
        told from the trials, where jumps may look like it. Both what is tried and what is answered
        may depend on it, so it is said before the first trial: see `GuidedSearch`, `LocalModel`.
        """
        if isinstance(self.model, NearestModel):
            self.model.memory.declare_deterministic()

    def by(self, way: str | Answering) -> Repertoire:
        """The same repertoire, asked in another way of answering; the memory is shared.

        Args:
            way: ``"nearest"``, ``"reliable"``, ``"kernel"``, ``"local"``, or one of one's own.

        Raises:
            SgimError: If what was learned is not a memory of trials, or there is no such way.
        """
        if not isinstance(self.model, NearestModel):
            raise SgimError(
                f"{type(self.model).__name__} has one way of answering; only a memory of trials "
                "can be asked in several"
            )
        return Repertoire(self.task, NearestModel(self.model.memory, answering_of(way)))

    @property
    def _inverse(self) -> InverseModel:
        if not isinstance(self.model, InverseModel):
            raise SgimError(f"{type(self.model).__name__} does not answer with policies")
        return self.model


class Repertoire(Answers):
    """What was learned, to be asked.

    Args:
        task: The spaces of the world.
        model: What has been learned.
    """

    def __init__(self, task: Task, model: CompetenceModel) -> None:
        self.task = task
        self.model = model
