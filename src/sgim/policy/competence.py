"""What strategies ask of what a learner knows: competence for goals, and policies for them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, runtime_checkable

from sgim.errors import SgimError
from sgim.records import Goal, Solution, Trial


class NoAnswerError(SgimError, LookupError):
    """Nothing has been learned that could answer for this goal."""


class CompetenceModel(Protocol):
    """Learns from trials and says how competent the learner is for a goal (the thesis's 𝓛)."""

    def update(self, trial: Trial) -> None:
        """Learn from one more checked trial."""
        ...

    def competence(self, goal: Goal, context: Any) -> float:
        """Competence for a goal in a context; higher is better, the range is the model's."""
        ...

    def shown_by(self, trial: Trial, goal: Goal, context: Any) -> float | None:
        """Competence for a goal that one trial alone shows.

        None if trials do not show competence one by one; an episode's progress is then
        measured by asking `competence` again at its end.
        """
        ...


def learn_all(
    model: CompetenceModel,
    trials: Sequence[Trial],
    goals: Sequence[Goal | None],
    contexts: Sequence[Any],
) -> list[float | None] | None:
    """Learn from several trials at once, if the model can: if it has a ``learn_all`` of its own.

    Args:
        model: The model.
        trials: The trials, in order.
        goals: The goal that each one's episode pursues; None where nothing is to be said.
        contexts: The context that each one's episode measures in.

    Returns:
        What `CompetenceModel.shown_by` says of each, or None if the model learns one by one.
    """
    together = getattr(model, "learn_all", None)
    if together is None:
        return None
    shown: list[float | None] = together(trials, goals, contexts)
    return shown


def competences(
    model: CompetenceModel, goals: Sequence[Goal], contexts: Sequence[Any]
) -> list[float]:
    """`CompetenceModel.competence` for several goals: by the model's ``competences`` if it can."""
    together = getattr(model, "competences", None)
    if together is None or len(goals) < 2:
        pairs = zip(goals, contexts, strict=True)
        return [float(model.competence(goal, context)) for goal, context in pairs]
    values: list[float] = together(goals, contexts)
    return values


@runtime_checkable
class InverseModel(Protocol):
    """Gives the best policy for a goal."""

    def best_policy(self, goal: Goal, context: Any) -> Any:
        """The policy to execute for a goal; raises `NoAnswerError` if nothing is known."""
        ...

    def best_policies(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[Any]:
        """As `best_policy` for many goals of one kind at once; None where nothing is known."""
        ...

    def solve(self, goal: Goal, context: Any, radius: float | None = None) -> Solution:
        """The policy with what it should produce, its spread, and whether that reaches.

        Args:
            goal: The goal.
            context: The context, if the task has contexts.
            radius: How near, in the unit box, counts as reached; the model's choice if not said.
        """
        ...
