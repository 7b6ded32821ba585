"""Figures that only the runs of some worlds have, beside those that all runs have."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from sgim.experiments.vocal_history import VocalRun, with_history
from sgim.figures.recognition import f_measures, recognised
from sgim.figures.toys import contact_sheet, database
from sgim.figures.vocal_classes import vocal_classes, vocal_stages
from sgim.figures.vocal_densities import vocal_densities
from sgim.figures.vocal_sounds import vocal_sounds
from sgim.figures.vocal_strategies import vocal_strategies
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Drawing = tuple[str, Callable[[], "Figure"]]
"""The end of a figure's name, after that of the experiment or of the run; and what draws it."""


def drawings(stem: str, runs: Sequence[RecordedRun], chosen: Collection[Path]) -> list[Drawing]:
    """The further figures of runs of one experiment; none for most.

    Args:
        stem: What figures of all runs are named after.
        runs: The runs.
        chosen: Journals of which figures of single runs are wanted.
    """
    if runs[0].experiment == "objects":
        by_path = {run.path: run for run in runs}
        told_apart = [(f"{p.stem}-f-measures", partial(f_measures, by_path[p])) for p in chosen]
        return [
            (f"{stem}-recognised", partial(recognised, runs)),
            *told_apart,
            (f"{stem}-toys", contact_sheet),
            (f"{stem}-pictures", database),
        ]
    return _vocal(stem, runs, chosen) if runs[0].experiment == "vocal" else []


def _vocal(stem: str, runs: Sequence[RecordedRun], chosen: Collection[Path]) -> list[Drawing]:
    by_path = {run.path: run for run in runs}

    @cache
    def read(path: Path) -> VocalRun:
        return with_history(by_path[path])

    def of_one(draw: Callable[[VocalRun], Figure], path: Path) -> Figure:
        return draw(read(path))

    single = {"stages": vocal_stages, "densities": vocal_densities, "sounds": vocal_sounds}
    found: list[Drawing] = [
        (f"{path.stem}-{name}", partial(of_one, draw, path))
        for path in chosen
        for name, draw in single.items()
    ]
    for name, members in by_learner(runs).items():
        paths = [run.path for run in members]
        title = f"{stem}-{name.replace(':', '-')}-by-strategy"
        found.append((title, partial(_of_all, vocal_strategies, read, paths)))
    if len(runs) > 1:
        found.insert(0, (f"{stem}-classes", lambda: vocal_classes([*map(read, by_path)])))
    return found


def _of_all(
    draw: Callable[[Sequence[VocalRun]], Figure],
    read: Callable[[Path], VocalRun],
    paths: Sequence[Path],
) -> Figure:
    return draw([read(path) for path in paths])
