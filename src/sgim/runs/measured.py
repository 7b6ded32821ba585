"""What a journal says of how its run was measured, read quickly and without knowing its task."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from sgim.events import Evaluated, Session
from sgim.runs.codec import unreadable
from sgim.runs.decoders import Stored, evaluated, session
from sgim.runs.journal_file import open_file
from sgim.runs.journal_reading import read_header, read_rows
from sgim.runs.recipes import completed

_DECODERS: Mapping[str, Callable[[Stored], Evaluated | Session]] = {
    "evaluated": evaluated,
    "session": session,
}


@dataclass(frozen=True)
class MeasuredRun:
    """Whose run it is, and its errors.

    Attributes:
        path: The journal.
        header: Its header.
        target: How many movements the run was last asked for; None if it never began.
        benchmark: What it was last measured by, as `Benchmark.describe` says; None if its journal
            does not say.
        evaluations: Its evaluations, in order.
    """

    path: Path
    header: Mapping[str, Any]
    target: int | None
    benchmark: Mapping[str, Any] | None
    evaluations: tuple[Evaluated, ...]

    @property
    def experiment(self) -> str | None:
        """Name of the experiment; None for a run that is not of one."""
        name: str | None = self.header.get("experiment")
        return name

    @property
    def learner(self) -> str | None:
        """Name of the learner, such as ``mimicry:T1``; None if it has no name."""
        name: str | None = self.header.get("learner") or self.recipe.get("learner")
        return name

    @property
    def configuration(self) -> str | None:
        """Name of the learner's configuration, if known."""
        configuration = self.recipe.get("configuration") or {}
        name: str | None = configuration.get("name")
        return name

    @property
    def seed(self) -> int | None:
        """The seed, if known."""
        seed: int | None = self.recipe.get("seed")
        return seed

    @cached_property
    def recipe(self) -> dict[str, Any]:
        """How the learner was made; empty if unknown."""
        recipe: dict[str, Any] = completed(self.header.get("recipe") or {})
        return recipe


Measured = TypeVar("Measured", bound=MeasuredRun)


def read_measured(path: str | Path) -> MeasuredRun:
    """Read how a run was measured, from its evaluations alone; also while it goes on.

    Raises:
        JournalError: If it cannot be read.
    """
    path = Path(path)
    events: list[Evaluated | Session] = []
    with closing(open_file(path, append=False, durable=False)) as db:
        header = read_header(db, path)
        for row in read_rows(db, path, 0, _DECODERS):
            try:
                events.append(_DECODERS[row[1]](row))
            except (AttributeError, KeyError, TypeError, ValueError) as error:
                raise unreadable(row, error) from error
    return MeasuredRun(path, header, **measures(events))


def measures(events: Iterable[object]) -> dict[str, Any]:
    """The ``target``, ``benchmark`` and ``evaluations`` of a run, from its events."""
    target = benchmark = None
    evaluations: list[Evaluated] = []
    for event in events:
        match event:
            case Evaluated():
                evaluations.append(event)
            case Session(facts):
                target = facts.get("target", target)
                benchmark = facts.get("benchmark", benchmark)
    return {"target": target, "benchmark": benchmark, "evaluations": tuple(evaluations)}


def by_learner(runs: Sequence[Measured]) -> dict[str, list[Measured]]:
    """Runs by the name of their learner, in the order of the names.

    Where configurations, batches or warm starts differ, the name has them too.
    """
    several = len({run.configuration for run in runs}) > 1
    varied = [
        (key, word)
        for key, word in (("batch", "batch"), ("warm_start", "after"))
        if len({run.header.get(key) for run in runs}) > 1
    ]
    groups: dict[str, list[Measured]] = {}
    for run in runs:
        more = [str(run.configuration)] if several else []
        more += [f"{word} {run.header[key]}" for key, word in varied if key in run.header]
        name = run.learner or run.path.stem
        groups.setdefault(f"{name} ({', '.join(more)})" if more else name, []).append(run)
    return dict(sorted(groups.items()))
