"""What the modes of a learner have gained, beside how often it chose them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.figures.shares import draw_shares, windows
from sgim.figures.style import NothingToDrawError, mode_colours, new_figure, read_runs, tidy
from sgim.runs.content import progress_of
from sgim.runs.measured import by_learner
from sgim.runs.summary import Openings, RecordedRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def progress(journals: Iterable[str | Path | RecordedRun]) -> Figure:
    """Draw shares of modes over movements, and each mode's mean gain per movement.

    A row for each learner that has several modes, all its runs together (figure 4.2.6 of the
    thesis, and the right of figure 4.2.9).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.

    Raises:
        NothingToDrawError: If no learner chose among several modes.
        SgimError: If the runs are of different experiments.
        JournalError: If one cannot be read.
    """
    groups = {
        name: members
        for name, members in by_learner(read_runs(journals)).items()
        if len({mode for run in members for mode in run.openings.modes}) > 1
    }
    if not groups:
        raise NothingToDrawError("no learner chose among several modes")
    everyone = [run for members in groups.values() for run in members]
    colours = mode_colours({mode for run in everyone for mode in run.openings.modes})
    end = max(run.movements for run in everyone)
    figure = new_figure(8.0, 0.7 + 2.1 * len(groups) + 0.1 * len(colours))
    panels = figure.subplots(len(groups), 2, squeeze=False)
    for (left, right), (name, members) in zip(panels, groups.items(), strict=True):
        edges = windows(members)
        openings = Openings.pooled(run.openings for run in members)
        draw_shares(left, openings, edges, "modes", colours, end)
        many = f", {len(members)} runs" if len(members) > 1 else ""
        left.set_title(name + many, loc="left", fontsize=9)
        left.set_ylabel("share of episodes")
        right.set_ylabel("competence gained\nper movement")
        _draw_gains(right, members, edges, colours, end)
        tidy(left)
        tidy(right)
    for axes in panels[-1]:
        axes.set_xlabel("movements")
    from matplotlib.patches import Patch

    figure.legend(
        handles=[Patch(color=colour, label=mode) for mode, colour in colours.items()],
        loc="outside lower center",
        ncols=min(4, len(colours)),
        frameon=False,
        fontsize=8,
    )
    return figure


def _draw_gains(
    axes: Axes,
    members: Sequence[RecordedRun],
    edges: FloatArray,
    colours: dict[str, str],
    end: float,
) -> None:
    found = [progress_of(run.path, run.task) for run in members]
    least = np.inf
    for mode, colour in colours.items():
        parts = [gains[mode] for gains in found if mode in gains]
        if not parts:
            continue
        when, gained = (np.concatenate([part[i] for part in parts]) for i in range(2))
        window = np.clip(np.searchsorted(edges, when, "right") - 1, 0, len(edges) - 2)
        counts = np.bincount(window, minlength=len(edges) - 1)
        sums = np.bincount(window, gained, len(edges) - 1)
        means = np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)
        axes.stairs(means, edges, color=colour, linewidth=1.5, baseline=None)
        positive = means[np.isfinite(means) & (means > 0)]
        least = min(least, positive.min()) if len(positive) else least
    if np.isfinite(least):
        axes.set_yscale("log")
        axes.set_ylim(bottom=least / 2)
    axes.set_xlim(0, end)
