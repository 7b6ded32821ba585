"""All claims over a folder of journals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sgim.claims.answered import Answered
from sgim.claims.claim import Chapter, Verdicts, decide
from sgim.claims.plausible import Plausible, count_worlds
from sgim.claims.world import (
    Chooser,
    ReadRun,
    base_of,
    linked,
    main_experiment,
    read_runs,
    worlds_of,
)
from sgim.errors import SgimError, unknown
from sgim.runs.measured import MeasuredRun


@dataclass(frozen=True)
class Report:
    """Verdicts world by world, and over worlds.

    Attributes:
        verdicts: One table for each chapter, experiment and configuration.
        plausible: The counts over plausible worlds.
        seed: Of the bootstrap.
        notes: What was left out.
    """

    verdicts: tuple[Verdicts, ...]
    plausible: tuple[Plausible, ...]
    seed: int
    notes: tuple[str, ...]

    def as_json(self, *, details: bool) -> dict[str, Any]:
        """Tables and counts, JSON-compatible; with details, also all tests and their numbers."""
        return {
            "seed": self.seed,
            "tables": [verdicts.as_json(details=details) for verdicts in self.verdicts],
            "plausible": [plausible.as_json() for plausible in self.plausible],
            "notes": list(self.notes),
        }


def report(
    paths: Iterable[Path],
    chapters: Sequence[Chapter],
    *,
    configuration: str | None = None,
    at: int | None = None,
    by: str | None = None,
    seed: int = 0,
) -> Report:
    """Decide the claims of chapters by the runs of a sweep.

    Args:
        paths: The journals.
        chapters: The chapters.
        configuration: Only runs of this configuration, and of those that differ from it by
            settings; of all if None.
        at: The evaluation to compare at, in movements; the last that all runs of a world have if
            None.
        by: Measure all runs again by this way of answering, and decide by that; by their own
            evaluations if None. See `Answered`.
        seed: Of the bootstrap.

    Raises:
        JournalError: If a journal cannot be read.
        SgimError: If no run is of these chapters, or runs of one world cannot be compared.
        UnknownNameError: If no run has that configuration.
    """
    if seed < 0:
        raise SgimError(f"seed is {seed}, expected 0 or more")
    choosers: dict[Chooser, ReadRun] = {
        (chapter.experiment, learner): chapter.read_chooser
        for chapter in chapters
        for learner in chapter.choosers
    }
    known = {chapter.experiment for chapter in chapters}
    runs = read_runs(paths, choosers)
    about = [run for run in runs if main_experiment(run) in known]
    others = Counter(str(run.experiment) for run in runs if main_experiment(run) not in known)
    if not about:
        raise SgimError(
            f"there are only runs of {', '.join(sorted(others))}, and claims about "
            f"{', '.join(sorted(known))}; make some with sgim sweep"
        )
    kept = _configured(about, configuration)
    if by is not None:
        kept = _answered(kept, by, {moment for one in chapters for moment in one.moments}, at)
    tables: list[Verdicts] = []
    for chapter in chapters:
        worlds = worlds_of([run for run in kept if main_experiment(run) == chapter.experiment], at)
        several = [decide(chapter, w, seed) for w in linked(worlds, chapter.experiment)]
        # Some worlds are there only to be compared with another.
        decided = [verdicts for verdicts in several if any(v.findings for v in verdicts.verdicts)]
        tables += decided or several
    notes = [
        f"no claims are about {name}: left out {count} run{'s' * (count > 1)}"
        for name, count in sorted(others.items())
    ]
    if by is not None:
        notes.append(f"errors are those of answering by {by}, measured again from the journals")
    return Report(tuple(tables), tuple(count_worlds(tables)), seed, tuple(notes))


def _configured(runs: Sequence[MeasuredRun], configuration: str | None) -> Sequence[MeasuredRun]:
    if configuration is None:
        return runs
    kept = [
        run for run in runs if configuration in (run.configuration, base_of(str(run.configuration)))
    ]
    if not kept:
        known = {str(run.configuration) for run in runs}
        raise unknown("configuration of these runs", configuration, known)
    return kept


def _answered(
    runs: Sequence[MeasuredRun], way: str, moments: set[int], at: int | None
) -> Sequence[MeasuredRun]:
    """The runs measured again: at their last evaluation or ``at``, and at those claims name."""
    measure = Answered(way).measure
    return [
        measure(run, {*moments, run.evaluations[-1].movements if at is None else at})
        for run in runs
        if run.evaluations
    ]
