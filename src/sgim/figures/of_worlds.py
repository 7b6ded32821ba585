"""Figures that only the runs of some worlds have, beside those that all runs have."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from sgim.experiments.vocal_history import VocalRun, with_history
from sgim.figures.vocal_classes import vocal_classes, vocal_stages
from sgim.figures.vocal_densities import vocal_densities
from sgim.figures.vocal_sounds import vocal_sounds
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
    if runs[0].experiment != "vocal":
        return []

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
    if len(runs) > 1:
        found.insert(0, (f"{stem}-classes", lambda: vocal_classes([*map(read, by_path)])))
    return found
