"""Many runs side by side, one journal each; what is finished is not repeated."""

from __future__ import annotations

import itertools
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Protocol

from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.runs.run import Interrupted, Run
from sgim.runs.summary import read_run


class Sweepable(Protocol):
    """What a sweep asks of an experiment; `sgim.experiments.Experiment` has it."""

    @property
    def movements(self) -> int:
        """How many movements a run has by default."""
        ...

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
class SweptRun:
    """How one run of a sweep ended.

    Attributes:
        path: Its journal.
        learner: The learner's name.
        seed: The seed.
        status: ``finished``; ``known`` if it was finished before; ``interrupted``; ``failed``.
        error: The traceback of what failed; empty otherwise.
    """

    path: Path
    learner: str
    seed: int
    status: Literal["finished", "known", "interrupted", "failed"]
    error: str = ""


def sweep(
    experiment: Sweepable,
    learners: Iterable[str],
    seeds: Iterable[int],
    *,
    configuration: str = "modern",
    movements: int | None = None,
    batch: int = 1,
    evaluate_every: int = 1000,
    jobs: int = 1,
    out: str | Path = "runs",
    on_end: Callable[[SweptRun], None] | None = None,
) -> list[SweptRun]:
    """Run every learner with every seed, side by side, one BLAS thread each.

    A run whose journal is in ``out`` already is taken as it is if it is finished, and resumed
    if it is not. A run that fails does not stop the others.

    Args:
        experiment: The experiment.
        learners: Names of learners, such as ``sgim-acts`` and ``mimicry:T1``.
        seeds: The seeds.
        configuration: Name of the configuration of all of them.
        movements: Movements of each run; the experiment's if None.
        batch: Plans to carry out side by side within a run.
        evaluate_every: Movements between evaluations.
        jobs: Processes; with 1, all runs are made in this one.
        out: Directory of the journals.
        on_end: Called with each run as it ends, in the order of ending.

    Returns:
        How each run ended, learner by learner and in the order of the seeds.

    Raises:
        SgimError: If a learner cannot be made; nothing has been run then.
        Interrupted: If the user stopped it; all journals are kept, and the same call goes on.
    """
    target = experiment.movements if movements is None else movements
    names = list(dict.fromkeys(learners))
    pairs = list(itertools.product(names, dict.fromkeys(seeds)))
    if not pairs or target < 1 or jobs < 1:
        raise SgimError("a sweep needs one or more learners, seeds, movements and jobs")
    for name in names:
        experiment.learner(name, configuration=configuration, seed=0)
    tasks = [
        _Task(
            experiment,
            learner,
            seed,
            # Workers may have been started in another directory.
            experiment.journal_path(learner, seed, configuration, Path(out).absolute()),
            configuration,
            target,
            batch,
            evaluate_every,
        )
        for learner, seed in pairs
    ]
    ended: dict[Path, SweptRun] = {}
    try:
        for result in _results(tasks, jobs):
            ended[result.path] = result
            if on_end is not None:
                on_end(result)
            if result.status == "interrupted":
                raise KeyboardInterrupt
    except KeyboardInterrupt:
        done = sum(r.status in ("finished", "known") for r in ended.values())
        raise Interrupted(f"stopped; {done} of {len(tasks)} runs are finished") from None
    return [ended[task.path] for task in tasks]


@dataclass(frozen=True)
class _Task:
    experiment: Sweepable
    learner: str
    seed: int
    path: Path
    configuration: str
    target: int
    batch: int
    evaluate_every: int


def _results(tasks: list[_Task], jobs: int) -> Iterator[SweptRun]:
    """The results, in the order in which they come."""
    from joblib import Parallel, delayed, parallel_config

    if jobs == 1:
        yield from map(_run_one, tasks)
        return
    with parallel_config(backend="loky", inner_max_num_threads=1):
        parallel = Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)
        results = parallel(delayed(_run_one)(task) for task in tasks)
    yield from results


def _run_one(task: _Task) -> SweptRun:
    """Make one run, in whatever process."""

    def ended(status: Any, error: str = "") -> SweptRun:
        return SweptRun(task.path, task.learner, task.seed, status, error)

    experiment, path = task.experiment, task.path
    try:
        if path.exists():
            learner = experiment.learner(
                task.learner, configuration=task.configuration, seed=task.seed
            )
            experiment.require_same(path, learner, task.batch)
            if read_run(path).reached(task.target):
                return ended("known")
        with experiment.start(
            task.learner,
            path,
            configuration=task.configuration,
            seed=task.seed,
            batch=task.batch,
            evaluate_every=task.evaluate_every,
        ) as run:
            run.go(task.target)
    except Interrupted:
        return ended("interrupted")
    except Exception:
        return ended("failed", traceback.format_exc())
    return ended("finished")
