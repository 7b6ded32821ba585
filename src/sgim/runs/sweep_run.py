"""One run of a sweep, made wherever a worker takes it up."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import traceback
import uuid
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from sgim.learner import Learner
from sgim.runs.journal_mode import network_file_system
from sgim.runs.run import Interrupted, Run
from sgim.runs.summary import read_run
from sgim.runs.sweep_notes import Ending, Notes, Status


class Sweepable(Protocol):
    """What a sweep asks of an experiment; `sgim.experiments.Experiment` has it."""

    def learner(self, name: str, *, configuration: str = ..., seed: int = ...) -> Learner:
        """Make a learner by its name."""
        ...

    def journal_path(self, learner: str, seed: int, configuration: str, folder: str | Path) -> Path:
        """Where the journal of one run is."""
        ...

    def require_same(self, journal: str | Path, learner: Learner, batch: int) -> None:
        """Raise `JournalError` if a journal has the run of another learner."""
        ...

    def start(
        self,
        name: str,
        journal: str | Path,
        *,
        configuration: str = ...,
        seed: int = ...,
        batch: int = ...,
        evaluate_every: int = ...,
    ) -> Run:
        """Begin a run, or go on with it."""
        ...


@dataclass(frozen=True)
class PlannedRun:
    """A run that a sweep is to make.

    Attributes:
        experiment: The experiment.
        learner: The learner's name, such as ``mimicry:T1``.
        seed: The seed.
        movements: How many movements it makes.
        configuration: Name of the learner's configuration.
        batch: Plans to carry out side by side within it.
        evaluate_every: Movements between evaluations.
    """

    experiment: Sweepable
    learner: str
    seed: int
    movements: int
    configuration: str = "modern"
    batch: int = 1
    evaluate_every: int = 1000

    def path(self, folder: str | Path) -> Path:
        """Where its journal is."""
        return self.experiment.journal_path(self.learner, self.seed, self.configuration, folder)


def seed_words(seeds: Sequence[int]) -> str:
    """Seeds as they are written: ``0-19``, or ``0,3,5-7``; each once, in order."""
    words: list[list[int]] = []
    for seed in sorted({*seeds}):
        if words and seed == words[-1][-1] + 1:
            words[-1].append(seed)
        else:
            words.append([seed])
    return ",".join(f"{w[0]}-{w[-1]}" if len(w) > 1 else str(w[0]) for w in words)


@dataclass(frozen=True)
class Job:
    """A planned run with what a worker must know of the sweep.

    Attributes:
        run: The run.
        path: Where its journal is to be, on storage that all workers share.
        notes: Where to note what becomes of it.
        limit: How often it may be begun.
        scratch: Where the journal is written meanwhile; None to choose.
    """

    run: PlannedRun
    path: Path
    notes: Path
    limit: int
    scratch: Path | None


def run_job(job: Job) -> Status:
    """Make a run, in whatever process, and note how it ended."""
    notes, name = Notes(job.notes), job.path.name
    if notes.attempts(name) >= job.limit:  # a cluster took it up again after its worker had died
        notes.end(name, lost(job.limit))
        return "failed"
    attempt = notes.begin(name)
    error = ""
    try:
        status = _make(job)
        if status == "known" and attempt > 1:
            status = "finished"  # by the attempt before, which died at its very end
    except Interrupted:
        status = "interrupted"
    except Exception:
        status, error = "failed", traceback.format_exc()
    notes.end(name, Ending(status, attempt, error))
    return status


def lost(attempts: int, cause: BaseException | None = None) -> Ending:
    """The ending of a run whose worker died in each of so many attempts."""
    times = f"each of {attempts} times that it was tried" if attempts > 1 else "while it ran"
    lines = [
        f"the process that made this run died {times}: it was killed (a signal, or by the system "
        "for want of memory), it crashed outside of Python, or its machine was lost"
    ]
    if cause is not None:
        lines.append(f"{type(cause).__name__}: {str(cause).strip()}")
    return Ending("failed", attempts, "\n".join(lines))


def _make(job: Job) -> Status:
    run = job.run
    if job.path.exists():
        learner = run.experiment.learner(
            run.learner, configuration=run.configuration, seed=run.seed
        )
        run.experiment.require_same(job.path, learner, run.batch)
        if read_run(job.path).reached(run.movements):
            return "known"
    with (
        _written(job) as path,
        run.experiment.start(
            run.learner,
            path,
            configuration=run.configuration,
            seed=run.seed,
            batch=run.batch,
            evaluate_every=run.evaluate_every,
        ) as going,
    ):
        going.go(run.movements)
    return "finished"


@contextmanager
def _written(job: Job) -> Iterator[Path]:
    """Where to write the journal: in its place, or on this machine, and then brought there."""
    scratch = job.scratch
    if scratch is None and network_file_system(job.path.parent):
        scratch = Path(tempfile.gettempdir()) / f"sgim-{os.getuid()}"
    if scratch is None:
        yield job.path
        return
    digest = hashlib.blake2b(str(job.path).encode(), digest_size=8).hexdigest()
    here = scratch / digest / job.path.name
    here.parent.mkdir(parents=True, exist_ok=True)
    if job.path.exists():  # a run that was brought there goes on; what is here is older
        shutil.copyfile(job.path, here)
    try:
        yield here
    finally:
        if here.exists():
            part = job.path.with_name(f".{uuid.uuid4().hex}.part")
            part.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(here, part)
            os.replace(part, job.path)
            shutil.rmtree(here.parent, ignore_errors=True)
