"""Many runs side by side, one journal each; what is finished is not repeated."""

from __future__ import annotations

import shutil
import threading
import uuid
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from sgim.errors import SgimError
from sgim.runs.backends import BackendName, Execute, workers
from sgim.runs.run import Interrupted
from sgim.runs.sweep_notes import Ending, Notes, Status
from sgim.runs.sweep_run import Job, PlannedRun, lost, run_job


@dataclass(frozen=True)
class SweptRun:
    """How one run of a sweep ended.

    Attributes:
        path: Its journal.
        learner: The learner's name.
        seed: The seed.
        status: ``finished``; ``known`` if it was finished before; ``interrupted``; ``failed``.
        attempts: How often it was tried.
        error: The traceback of what failed; empty otherwise.
    """

    path: Path
    learner: str
    seed: int
    status: Status
    attempts: int = 1
    error: str = ""


def sweep(
    planned: Sequence[PlannedRun],
    *,
    out: str | Path = "runs",
    backend: BackendName = "loky",
    address: str | None = None,
    jobs: int | None = 1,
    retries: int = 2,
    scratch: str | Path | None = None,
    on_end: Callable[[SweptRun], None] | None = None,
) -> list[SweptRun]:
    """Make runs side by side, one BLAS thread each.

    A run whose journal is in ``out`` already is taken as it is if it is finished, and resumed
    if it is not. A run that raises an error, or whose worker dies, is tried again, from where its
    journal is, and does not stop the others.

    Args:
        planned: The runs, no two with the same journal.
        out: Directory of the journals; on a cluster, on storage that all workers share.
        backend: Where the runs execute, as `sgim.runs.backends.workers` says.
        address: Of the cluster.
        jobs: How many at once; with ``loky`` and 1, all runs are made in this process.
        retries: How often a run is tried again.
        scratch: Directory, on the machine that makes a run, where its journal is written before
            it is brought to ``out``. If None, that is ``out`` itself, or where it is on a network
            file system, the machine's directory for temporary files.
        on_end: Called with each run as it ends, in the order of ending, from another thread.

    Returns:
        How each run ended, in the order planned.

    Raises:
        SgimError: If there is nothing to run, or the back end cannot be used.
        Interrupted: If the user stopped it; all journals are kept, and the same call goes on.
    """
    if not planned or retries < 0 or (jobs is not None and jobs < 1):
        raise SgimError("a sweep needs one or more runs and jobs, and 0 or more retries")
    # Workers may have been started in another directory.
    folder = Path(out).absolute()
    notes = Notes(folder / f".sweep-{uuid.uuid4().hex[:12]}")
    paths = [run.path(folder) for run in planned]
    jobs_of = {
        path.name: Job(
            run, path, notes.folder, retries + 1, None if scratch is None else Path(scratch)
        )
        for run, path in zip(planned, paths, strict=True)
    }
    if len(jobs_of) < len(planned):
        raise SgimError("two planned runs have the same journal; plan each once")
    swept = _Sweep(jobs_of, notes, retries + 1)
    try:
        with _Watch(swept, on_end), workers(backend, address, jobs) as execute:
            swept.go(execute)
    except KeyboardInterrupt:
        swept.interrupted = True
    finally:
        shutil.rmtree(notes.folder, ignore_errors=True)
    if swept.interrupted:
        done = sum(e.status in ("finished", "known") for e in swept.endings.values())
        raise Interrupted(f"stopped; {done} of {len(planned)} runs are finished")
    return [swept.result(path.name) for path in paths]


class _Sweep:
    """A sweep that goes on: which runs are still to be made, and how the others ended."""

    def __init__(self, jobs: Mapping[str, Job], notes: Notes, limit: int) -> None:
        self.jobs = jobs
        self.notes = notes
        self.limit = limit
        self.endings: dict[str, Ending] = {}
        self.interrupted = False

    def go(self, execute: Execute) -> None:
        """Make all runs; again those that failed, and alone those that died together.

        Where a worker's death takes others along, the runs that were under way are made one at a
        time afterwards, so that only the one which brings it about is found guilty of it.
        """
        waiting, suspects = [*self.jobs], list[str]()
        while (waiting or suspects) and not self.interrupted:
            group = [suspects.pop()] if suspects else waiting
            begun = {name: self.notes.attempts(name) for name in group}
            self.notes.forget(group)
            cause: Exception | None = None
            try:
                execute(run_job, [self.jobs[name] for name in group])
            except Exception as error:
                cause = error
            finally:
                self.collect()
            left = [name for name in group if name not in self.endings]
            died = [name for name in left if self.notes.ending(name) is None]
            guilty = [name for name in died if self.notes.attempts(name) > begun[name]]
            if cause is not None and left and not guilty and len(left) == len(group):
                raise SgimError(
                    f"no worker could begin a run: {type(cause).__name__}: {cause}"
                ) from cause
            for name in guilty:
                if self.notes.attempts(name) >= self.limit:
                    self.notes.end(name, lost(self.limit, cause))
                else:
                    suspects.append(name)
            self.collect()
            known = {*self.endings, *suspects}
            waiting = [name for name in self.jobs if name not in known]

    def collect(self) -> list[str]:
        """Take in what has ended for good; the names of those that were not known to have."""
        new = []
        for name in self.notes.ended():
            ending = None if name in self.endings else self.notes.ending(name)
            if ending is None or (ending.status == "failed" and ending.attempt < self.limit):
                continue
            if ending.status == "interrupted":
                self.interrupted = True
            self.endings[name] = ending
            new.append(name)
        return new

    def result(self, name: str) -> SweptRun:
        """How a run ended."""
        job, ending = self.jobs[name], self.endings[name]
        return SweptRun(
            job.path, job.run.learner, job.run.seed, ending.status, ending.attempt, ending.error
        )


class _Watch:
    """A thread that tells of runs as they end, wherever they are made."""

    seconds = 0.2

    def __init__(self, swept: _Sweep, on_end: Callable[[SweptRun], None] | None) -> None:
        self._swept = swept
        self._on_end = on_end
        self._told: set[str] = set()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)

    def __enter__(self) -> None:
        if self._on_end is not None:
            self._thread.start()

    def _watch(self) -> None:
        while not self._stop.wait(self.seconds):
            self._swept.collect()
            self._tell()

    def _tell(self) -> None:
        for name in [*self._swept.endings]:  # copied at once: the sweep goes on adding to it
            if name not in self._told and self._on_end is not None:
                self._told.add(name)
                self._on_end(self._swept.result(name))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._on_end is not None:
            self._stop.set()
            self._thread.join()
            self._tell()
