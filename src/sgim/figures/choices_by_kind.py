"""Which mode is chosen for which kind of goal: whether a learner asks the one who can show it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.figures.shares import draw_legend, draw_shares, windows
from sgim.figures.style import (
    NothingToDrawError,
    kind_colours,
    mode_colours,
    new_figure,
    read_runs,
    tidy,
)
from sgim.runs.measured import by_learner
from sgim.runs.summary import Openings, RecordedRun

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def choices_by_kind(
    journals: Iterable[str | Path | RecordedRun], *, columns: int | None = None
) -> Figure:
    """Draw shares of modes over movements for each kind of goal, and of both over the whole run.

    Each learner that chooses among modes and kinds has a row, with the episodes of all its runs
    together; its last panel is figure 4.3.11 of the thesis.

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        columns: Panels in a row: all of a learner if None, or 1.

    Raises:
        NothingToDrawError: If no learner chooses both.
        SgimError: If they are of different experiments.
        JournalError: If one cannot be read.
    """
    runs = read_runs(journals)
    groups = {name: members for name, members in by_learner(runs).items() if _chooses(members)}
    if not groups:
        raise NothingToDrawError("no learner chose among several modes and several kinds of goal")
    openings = {n: Openings.pooled(r.openings for r in members) for n, members in groups.items()}
    kinds = kind_colours({k for one in openings.values() for k in one.kinds if k is not None})
    modes = mode_colours({mode for one in openings.values() for mode in one.modes})
    end = max(run.movements for members in groups.values() for run in members)
    height = max(1.7, 0.5 + 0.24 * len(modes))
    across = columns or len(kinds) + 1
    down = (len(kinds) + 1) // across
    legends = [0.4] if across > 1 else [0.1 + 0.17 * -(-len(modes) // 2), 0.3]
    heights = [height] * (down * len(groups)) + legends
    figure = new_figure(3.0 * across + 0.6 + (across == 1), 0.5 + sum(heights))
    grid = figure.add_gridspec(len(heights), across, height_ratios=heights)
    for number, (name, members) in enumerate(groups.items()):
        edges, chosen = windows(members), openings[name]
        spots = (
            grid[place // across, place % across] for place in count(number * (len(kinds) + 1))
        )
        many = f"\n({len(members)} runs)" if len(members) > 1 else ""
        for i, kind in enumerate(kinds):
            axes = figure.add_subplot(next(spots))
            of_kind = chosen.of_kind(kind)
            draw_shares(axes, of_kind, edges, "modes", modes, end)
            share = len(of_kind.modes) / len(chosen.modes)
            axes.set_title(f"mode when the goal is {kind}\n({share:.0%} of the episodes)")
            axes.set_xlabel("movements")
            if i == 0 or across == 1:
                axes.set_ylabel(name + many)
            tidy(axes)
        axes = figure.add_subplot(next(spots))
        _draw_whole(axes, chosen, list(modes), kinds)
        tidy(axes)
    below = (grid[-1, :-1], grid[-1, -1]) if across > 1 else (grid[-2, 0], grid[-1, 0])
    draw_legend(figure.add_subplot(below[0]), modes, columns=4 if across > 1 else 2)
    draw_legend(figure.add_subplot(below[1]), kinds)
    return figure


def _chooses(runs: Sequence[RecordedRun]) -> bool:
    modes = {mode for run in runs for mode in run.openings.modes}
    kinds = {kind for run in runs for kind in run.openings.kinds if kind is not None}
    return len(modes) > 1 and len(kinds) > 1


def _draw_whole(
    axes: Axes, openings: Openings, modes: Sequence[str], kinds: Mapping[str, str]
) -> None:
    """Bars of the shares of each mode and kind among all episodes, with their numbers."""
    counts = Counter(zip(openings.modes, openings.kinds, strict=True))
    places, thick = np.arange(len(modes)), 0.8 / len(kinds)
    for i, (kind, colour) in enumerate(kinds.items()):
        shares = [counts[mode, kind] / len(openings.modes) for mode in modes]
        bars = axes.barh(places + (i - (len(kinds) - 1) / 2) * thick, shares, thick, color=colour)
        axes.bar_label(bars, [f"{share:.1%}" for share in shares], fontsize=6, padding=2)
    axes.set_yticks(places, modes)
    axes.invert_yaxis()
    axes.margins(x=0.2)
    axes.xaxis.set_major_formatter(lambda share, _: f"{share:.0%}")
    axes.set_xlabel("share of all episodes")
    axes.set_title("mode and kind together,\nthe whole run")
