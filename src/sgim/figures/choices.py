"""What learners choose over time: how to learn, and what to aim at."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from sgim.errors import SgimError
from sgim.figures.shares import draw_legend, draw_shares, windows
from sgim.figures.style import kind_colours, mode_colours, new_figure, read_runs, tidy
from sgim.runs.measured import by_learner
from sgim.runs.summary import Openings, RecordedRun

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_COLUMNS = (("modes", "how to learn (mode)"), ("kinds", "what to aim at (kind of goal)"))


def choices(journals: Iterable[str | Path | RecordedRun]) -> Figure:
    """Draw shares of modes and of goal kinds among the episodes begun, over movements.

    Each learner has a row of two panels, with the episodes of all its runs together (figures
    4.3.9 and 4.3.10 of the thesis).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.

    Raises:
        SgimError: If they are of different experiments, or no episode was begun.
        JournalError: If one cannot be read.
    """
    runs = [run for run in read_runs(journals) if run.openings.modes]
    if not runs:
        raise SgimError("no run has begun an episode: there are no choices to draw")
    groups = by_learner(runs)
    colours = {
        "modes": mode_colours({mode for run in runs for mode in run.openings.modes}),
        "kinds": kind_colours({k for run in runs for k in run.openings.kinds if k is not None}),
    }
    end = max(run.movements for run in runs)
    legend_rows = max(-(-len(names) // 3) for names in colours.values())
    figure = new_figure(8.0, 0.75 + 1.45 * len(groups) + 0.17 * legend_rows)
    grid = figure.add_gridspec(
        len(groups) + 1, 2, height_ratios=[*[1.45] * len(groups), 0.05 + 0.17 * legend_rows]
    )
    for row, (name, members) in enumerate(groups.items()):
        openings, edges = Openings.pooled(run.openings for run in members), windows(members)
        for column, (what, title) in enumerate(_COLUMNS):
            axes = figure.add_subplot(grid[row, column])
            draw_shares(axes, openings, edges, what, colours[what], end)
            if row == 0:
                axes.set_title(title)
            if row == len(groups) - 1:
                axes.set_xlabel("movements")
            else:
                axes.set_xticklabels([])
            if column == 0:
                many = f"\n({len(members)} runs)" if len(members) > 1 else ""
                axes.set_ylabel(name + many)
            tidy(axes)
    for column, (what, _) in enumerate(_COLUMNS):
        draw_legend(figure.add_subplot(grid[-1, column]), colours[what])
    return figure
