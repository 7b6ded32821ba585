"""Giving a learner its journal: a new one, or one that it goes on with."""

from __future__ import annotations

import json
import platform
import sys
import time
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from sgim.errors import JournalError, SgimError
from sgim.events import Session
from sgim.learner import Learner
from sgim.runs.journal import Journal
from sgim.runs.journal_reading import first_difference
from sgim.runs.recipes import completed
from sgim.runs.replay import Replayed, replay
from sgim.runs.rows import to_json


class KeptJournal:
    """A learner with its journal; entered with ``with``, it gives the learner and closes after.

    Attributes:
        learner: The learner to go on with: the one that was passed, unless decisions had to be
            adopted.
        journal: Its journal, which records every event of the learner.
        replayed: What the recorded events came to.
    """

    def __init__(self, journal: Journal, replayed: Replayed) -> None:
        self.journal = journal
        self.replayed = replayed
        self.learner = replayed.learner

    def close(self) -> None:
        """Let the learner go on without a journal, and close that."""
        self.learner.record = None
        self.journal.close()

    def __enter__(self) -> Learner:
        return self.learner

    def __exit__(self, *exception: object) -> None:
        self.close()


def keep_journal(
    learner: Learner,
    path: str | Path,
    *,
    real: bool = False,
    adopt: bool = False,
    about: Mapping[str, Any] | None = None,
) -> KeptJournal:
    """Let a learner that has done nothing yet keep a journal, going on with it if it exists.

    Args:
        learner: A fresh learner, made as the recorded one was.
        path: The journal's path.
        real: Whether the world is a real one: every event is on disk before the next thing
            happens, decisions that come out differently after a change of the library are
            adopted at once, and plans that were out when the process died are given up as lost
            instead of being repeated; requests to teachers stay out.
        adopt: Whether to adopt such decisions in a simulated world too, instead of refusing.
        about: What to write in a new journal's header; an existing one must have the same.

    Returns:
        Learner and journal: ``with keep_journal(…) as learner`` goes on where the record ends.
        The learner's ``pending`` plans are still to be carried out.

    Raises:
        JournalError: If the journal cannot be used, or is of another run.
        MismatchError: If a decision comes out differently, and is not adopted.
        SgimError: If the learner has acted already.
    """
    if not learner.fresh:
        raise SgimError(
            "a journal begins with its learner, but this one has acted already: pass a learner "
            "just made, as the recorded one was if the journal exists"
        )
    header = {**learner.describe(), **(about or {})}
    if not Path(path).exists():
        journal = Journal.create(path, header, learner.task, durable=real)
        replayed = Replayed(learner)
    else:
        journal = Journal.open(path, learner.task, append=True, durable=real)
        try:
            _check(path, journal.header, header)
            replayed = replay(learner, journal.events(), adopt=adopt or real)
        except BaseException:
            journal.close()
            raise
    for event in replayed.unwritten:
        journal.append(event)
    journal.append(Session(session_facts(adopted=replayed.difference)))
    replayed.learner.record = journal.append
    if real:
        for plan in replayed.learner.pending:
            if plan.request is None:
                replayed.learner.lose(plan)
    return KeptJournal(journal, replayed)


def session_facts(**more: Any) -> dict[str, Any]:
    """Which process writes: the time, versions and processor, and whatever else is given."""
    facts = {
        "time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "sgim": version("sgim"),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": version("scipy"),
        "processor": platform.machine(),
        "platform": sys.platform,
    }
    return facts | more


def _check(path: str | Path, recorded: Mapping[str, Any], mine: Mapping[str, Any]) -> None:
    given = json.loads(to_json(dict(mine)))
    for key, value in given.items():
        there = completed(recorded.get(key)) if key == "recipe" else recorded.get(key)
        if difference := first_difference(there, value, key):
            raise JournalError(
                f"{path} is of another run: {difference}; resume it as it was begun, or choose "
                "another path"
            )
