"""Using what was learned: a journal opened for its answers, without going on."""

from __future__ import annotations

from pathlib import Path

from sgim import algorithms
from sgim.errors import JournalError, SgimError
from sgim.learner import Learner
from sgim.runs.journal import Journal
from sgim.runs.replay import iterate_trials
from sgim.task import Task


def open_repertoire(
    path: str | Path, task: Task | None = None, *, learner: Learner | None = None
) -> Learner:
    """Open what a run has learned so far, for `Learner.solve` and `Learner.best_policy`.

    Args:
        path: The journal; the run may be going on.
        task: Its task; needed only if its spaces are not part of the library.
        learner: A fresh learner that knows how to answer, if the journal has no recipe.

    Returns:
        A learner that remembers every trial; it keeps no journal.

    Raises:
        JournalError: If the journal cannot be read, or says not how to make its learner.
    """
    with Journal.open(path, task, append=False) as journal:
        if learner is None:
            try:
                learner = algorithms.from_recipe(journal.task, journal.header.get("recipe") or {})
            except SgimError as error:
                raise JournalError(
                    f"{path} does not say how its learner is made ({error}); open it from Python "
                    "with sgim.open(path, learner=…), with a learner made as it was"
                ) from error
        for trial in iterate_trials(journal.events()):
            learner.observe(trial)
    return learner
