"""Using what was learned: a journal opened for its answers, without going on."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path

from sgim import algorithms
from sgim.answers import Answers
from sgim.errors import JournalError, SgimError
from sgim.events import Ended, Told
from sgim.learner import Learner
from sgim.policy.answering import Answering
from sgim.runs.benchmark import Benchmark
from sgim.runs.journal import Journal
from sgim.runs.replay import iterate_trials, says_deterministic
from sgim.runs.rows import RecordedEvent
from sgim.streams import Streams
from sgim.task import Task


def open_repertoire(
    path: str | Path,
    task: Task | None = None,
    *,
    learner: Learner | None = None,
    movements: int | None = None,
) -> Learner:
    """Open what a run has learned so far, for `Learner.solve` and `Learner.best_policy`.

    Args:
        path: The journal; the run may be going on.
        task: Its task; needed only if its spaces are not part of the library.
        learner: A fresh learner that knows how to answer, if the journal has no recipe.
        movements: How many of its movements to remember; all if not said.

    Returns:
        A learner that remembers these trials; it keeps no journal. Ask ``.by(way)`` for the same
        in another way of answering.

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
        heeded = _heeded(learner, _first(journal.events(), movements))
        for trial in iterate_trials(heeded):
            learner.observe(trial)
    return learner


def _heeded(learner: Learner, events: Iterable[RecordedEvent]) -> Iterator[RecordedEvent]:
    """The events; a learner is told on the way if one says that the world is deterministic."""
    for event in events:
        if says_deterministic(event):
            learner.declare_deterministic()
        yield event


def _first(events: Iterable[RecordedEvent], movements: int | None) -> Iterator[RecordedEvent]:
    """The events up to the last of so many movements; failed ones count."""
    left = math.inf if movements is None else movements
    for event in events:
        if isinstance(event, Told) or (isinstance(event, Ended) and event.how == "failed"):
            if left <= 0:
                return
            left -= 1
        yield event


def evaluate(
    repertoire: Answers,
    benchmark: Benchmark,
    *,
    by: str | Answering | None = None,
    seed: int = 0,
    index: int = 0,
) -> dict[str, float]:
    """Measure what was learned, without learning, in any way of answering.

    Ways that are given the same seed and index meet the same contexts, and draw noise from the
    same stream.

    Args:
        repertoire: A learner, or what `open_repertoire` gave.
        benchmark: What to measure by.
        by: The way of answering (see `Answers.by`); the repertoire's own if not said.
        seed: Of the world's noise and contexts; that of the run for its own numbers.
        index: Number of the evaluation; the run's own are numbered by the movements before.

    Returns:
        Mean error per goal kind, and ``total``, the mean of the kinds.
    """
    asked = repertoire if by is None else repertoire.by(by)
    return benchmark.evaluate(asked, Streams(seed), index)
