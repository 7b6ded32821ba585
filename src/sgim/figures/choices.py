"""What learners choose over time: how to learn, and what to aim at."""

from __future__ import annotations

import itertools
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


def choices(journals: Iterable[str | Path | RecordedRun], *, columns: int = 2) -> Figure:
    """Draw shares of modes and of goal kinds among the episodes begun, over movements.

    Each learner has a row of two panels, with the episodes of all its runs together (figures
    4.3.9 and 4.3.10 of the thesis).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        columns: Panels in a row: 2, or 1 to have a learner's one above the other.

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
    names_a_row = 3 if columns > 1 else 2
    legends = [0.05 + 0.17 * -(-len(names) // names_a_row) for names in colours.values()]
    heights = [1.45] * (len(groups) * 2 // columns)
    heights += [max(legends)] if columns > 1 else legends
    figure = new_figure(4.0 * columns, 0.7 + sum(heights))
    grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    panels = itertools.product(groups.items(), _COLUMNS)
    for place, ((name, members), (what, title)) in enumerate(panels):
        axes = figure.add_subplot(grid[place // columns, place % columns])
        pooled = Openings.pooled(run.openings for run in members)
        draw_shares(axes, pooled, windows(members), what, colours[what], end)
        if place < 2:
            axes.set_title(title)
        if place >= 2 * len(groups) - columns:
            axes.set_xlabel("movements")
        else:
            axes.set_xticklabels([])
        if place % columns == 0:
            many = f"\n({len(members)} runs)" if len(members) > 1 else ""
            axes.set_ylabel(name + many)
        tidy(axes)
    for i, (what, _) in enumerate(_COLUMNS):
        row = -1 if columns > 1 else i - 2
        draw_legend(figure.add_subplot(grid[row, i % columns]), colours[what], names_a_row)
    return figure
