"""What a run has learned so far, for the goals that somebody points at on the page."""

from __future__ import annotations

from pathlib import Path

from sgim import algorithms
from sgim.events import Ended, Observed, Told
from sgim.learner import Learner
from sgim.records import Trial
from sgim.runs.journal import Journal
from sgim.runs.replay import says_deterministic
from sgim.runs.rows import RecordedPlan
from sgim.task import Task


class Repertoire:
    """A learner that remembers every trial of a journal, and reads on when it is asked.

    Args:
        path: The journal.
        task: Its task.
        recipe: How its learner is made.

    Raises:
        SgimError: If the recipe is not the library's.
    """

    def __init__(self, path: Path, task: Task, recipe: dict[str, object]) -> None:
        self._path = path
        self._task = task
        self._learner = algorithms.from_recipe(task, recipe)
        self._plans: dict[int, RecordedPlan] = {}
        self._after = 0

    def learner(self) -> Learner:
        """The learner, as far as the journal goes now."""
        with Journal.open(self._path, self._task, append=False) as journal:
            only = ("session", "planned", "told", "ended", "observed")
            for row, event in journal.entries(self._after, only):
                self._after = row
                if isinstance(event, RecordedPlan):
                    self._plans[event.id] = event
                elif isinstance(event, Told):
                    plan = self._plans.pop(event.plan)
                    self._learner.observe(Trial(plan.policy, event.outcome, plan.context))
                elif isinstance(event, Ended):
                    self._plans.pop(event.plan, None)
                elif isinstance(event, Observed):
                    self._learner.observe(event.trial)
                elif says_deterministic(event):
                    self._learner.declare_deterministic()
        return self._learner
