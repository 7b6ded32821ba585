"""What a reproduction came to: its runs, verdicts and figures, and what failed."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sgim.claims.claim import Verdicts
from sgim.claims.plausible import Plausible
from sgim.claims.report import report
from sgim.errors import SgimError
from sgim.experiments.sweep_plan import Part
from sgim.reproductions.declaration import Drawing, Reproduction
from sgim.reproductions.svg import standalone
from sgim.runs.comparison import Comparison, compare
from sgim.runs.journal_file import open_file
from sgim.runs.journal_reading import read_columns
from sgim.runs.summary import RecordedRun, read_run
from sgim.runs.sweep import SweptRun


@dataclass(frozen=True)
class Picture:
    """A figure, drawn.

    Attributes:
        drawing: What it is.
        wide: The SVG file.
        narrow: The same with its panels one below the other; None if it cannot be.
        trouble: Why it could not be drawn, instead.
    """

    drawing: Drawing
    wide: str = ""
    narrow: str | None = None
    trouble: str = ""


@dataclass(frozen=True)
class Section:
    """What there is to say of one experiment in one configuration.

    Attributes:
        experiment: The experiment's name.
        configuration: The configuration's name.
        verdicts: Of the claims about it, a table a chapter.
        comparison: Its learners side by side; None if they cannot be compared.
        pictures: Its figures.
        notes: What could not be done, and why.
    """

    experiment: str
    configuration: str
    verdicts: tuple[Verdicts, ...]
    comparison: Comparison | None
    pictures: tuple[Picture, ...]
    notes: tuple[str, ...]

    @property
    def title(self) -> str:
        """Experiment and configuration."""
        return f"{self.experiment}, {self.configuration}"


@dataclass(frozen=True)
class Result:
    """A reproduction that was made.

    Attributes:
        reproduction: Its declaration.
        command: The command that made it.
        quick: Whether it is only a first look.
        parts: What was run.
        runs: How each run ended.
        sections: What there is to say of each experiment and configuration.
        plausible: Counts over plausible worlds.
        claims: All verdicts, JSON-compatible; empty if none could be decided.
        versions: Facts of the processes that made the runs → in how many of them.
    """

    reproduction: Reproduction
    command: str
    quick: bool
    parts: tuple[Part, ...]
    runs: tuple[SweptRun, ...]
    sections: tuple[Section, ...]
    plausible: tuple[Plausible, ...]
    claims: dict[str, Any]
    versions: dict[str, int]

    @property
    def failed(self) -> list[SweptRun]:
        """The runs that failed."""
        return [run for run in self.runs if run.status == "failed"]


def conclude(
    reproduction: Reproduction,
    swept: Sequence[SweptRun],
    main: Sequence[Part],
    worlds: Sequence[Part],
    *,
    command: str,
    quick: bool,
) -> Result:
    """Decide, compare and draw what was run. Runs that failed are left out.

    Args:
        reproduction: The declaration.
        swept: How each run ended.
        main: What was run, each experiment and configuration a section.
        worlds: What was run besides, without a section.
        command: The command that made it.
        quick: Whether it is only a first look.
    """
    paths = [run.path for run in swept if run.status in ("finished", "known")]
    verdicts: tuple[Verdicts, ...] = ()
    plausible: tuple[Plausible, ...] = ()
    claims: dict[str, Any] = {}
    notes: list[str] = []
    if reproduction.chapters and paths:
        try:
            decided = report(paths, reproduction.chapters)
        except SgimError as error:
            notes.append(f"no claim could be decided: {error}")
        else:
            verdicts, plausible = decided.verdicts, decided.plausible
            claims, notes = decided.as_json(details=False), [*decided.notes]
    places = dict.fromkeys(
        (e, c) for part in main for e in part.experiments for c in part.configurations
    )
    runs = [read_run(path) for path in paths]
    sections = []
    for experiment, configuration in places:
        members = [
            run
            for run in runs
            if (run.experiment, run.configuration) == (experiment, configuration)
        ]
        its = tuple(
            v
            for v in verdicts
            if (v.world.experiment, v.world.configuration) == (experiment, configuration)
        )
        sections.append(_section(reproduction, experiment, configuration, members, its, notes))
        notes = []
    return Result(
        reproduction,
        command,
        quick,
        (*main, *worlds),
        tuple(swept),
        tuple(sections),
        plausible,
        claims,
        _versions(paths),
    )


def _section(
    reproduction: Reproduction,
    experiment: str,
    configuration: str,
    runs: Sequence[RecordedRun],
    verdicts: tuple[Verdicts, ...],
    notes: Sequence[str],
) -> Section:
    said = [*notes]
    comparison = None
    if not runs:
        said.append("no run is finished: there is nothing to show")
    else:
        try:
            comparison = compare(runs)
        except SgimError as error:
            said.append(f"the learners cannot be compared: {error}")
        else:
            said += comparison.notes
    drawings = reproduction.drawings if runs else ()
    pictures = tuple(_picture(drawing, runs) for drawing in drawings)
    return Section(experiment, configuration, verdicts, comparison, pictures, tuple(said))


def _picture(drawing: Drawing, runs: Sequence[RecordedRun]) -> Picture:
    chosen = [run for run in runs if not drawing.learners or run.learner in drawing.learners]
    try:
        if not chosen:
            raise SgimError("no run of the learners that it shows is finished")
        wide = standalone(drawing.draw(chosen))
        stacked = drawing.draw_stacked
        narrow = None if stacked is None else standalone(stacked(chosen, columns=1))
    except SgimError as error:
        return Picture(drawing, trouble=str(error))
    return Picture(drawing, wide, narrow)


_FACTS = ("sgim", "python", "numpy", "scipy", "processor", "platform")


def _versions(paths: Sequence[Path]) -> dict[str, int]:
    """Versions and processors of those who made the runs, the most frequent first."""
    found: Counter[str] = Counter()
    for path in paths:
        with closing(open_file(path, append=False, durable=False)) as db:
            for (detail,) in read_columns(db, path, "session", ["detail"]):
                facts = json.loads(detail)
                if "sgim" in facts:
                    known = [f"{name} {facts[name]}" for name in _FACTS if name in facts]
                    found[", ".join(known)] += 1
    return dict(found.most_common())
