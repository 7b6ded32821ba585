"""What learners choose over time: how to learn, and what to aim at."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.errors import SgimError
from sgim.figures.style import (
    kind_colours,
    mode_colours,
    new_figure,
    read_runs,
    tidy,
)
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_EPISODES = 40
"""Episodes that a window should hold, all runs together, before windows get narrower."""

_COLUMNS = (("modes", "how to learn (mode)"), ("kinds", "what to aim at (kind of goal)"))


def choices(paths: Iterable[str | Path]) -> Figure:
    """Draw shares of modes and of goal kinds among the episodes begun, over movements.

    Each learner has a row of two panels; shares are averaged over its runs.

    Args:
        paths: Journals of runs of one experiment.

    Raises:
        SgimError: If they are of different experiments, or no episode was begun.
        JournalError: If one cannot be read.
    """
    runs = [run for run in read_runs(paths) if run.openings.modes]
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
        edges = _edges(members)
        for column, (key, title) in enumerate(_COLUMNS):
            axes = figure.add_subplot(grid[row, column])
            shares = _mean_shares(members, edges, key, list(colours[key]))
            _stack(axes, edges, shares, colours[key])
            if not shares.any():
                axes.text(0.5, 0.5, "no goals", transform=axes.transAxes, ha="center", fontsize=8)
            axes.set_xlim(0, end)
            axes.set_ylim(0, 1)
            axes.set_yticks([0, 0.5, 1], ["0", "50%", "100%"])
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
    for column, (key, _) in enumerate(_COLUMNS):
        _legend(figure.add_subplot(grid[-1, column]), colours[key])
    return figure


def _edges(runs: Sequence[RecordedRun]) -> FloatArray:
    episodes = sum(len(run.openings.modes) for run in runs)
    windows = int(np.clip(episodes // _EPISODES, 4, 24))
    return np.linspace(0, max(1, *(run.movements for run in runs)), windows + 1)


def _mean_shares(
    runs: Sequence[RecordedRun], edges: FloatArray, key: str, names: Sequence[str]
) -> FloatArray:
    """Mean shares over runs, shape ``(names, windows)``; 0 where no run began an episode."""
    table = np.full((len(runs), len(names), len(edges) - 1), np.nan)
    for i, run in enumerate(runs):
        for w, shares in enumerate(run.openings.shares(edges)):
            if shares["modes"]:
                table[i, :, w] = [shares[key].get(name, 0.0) for name in names]
    known = ~np.isnan(table)
    return np.asarray(np.where(known, table, 0).sum(axis=0) / np.maximum(1, known.sum(axis=0)))


def _stack(axes: Axes, edges: FloatArray, shares: FloatArray, colours: Mapping[str, str]) -> None:
    base = np.zeros(shares.shape[1])
    for colour, share in zip(colours.values(), shares, strict=True):
        axes.stairs(base + share, edges, baseline=base, fill=True, color=colour, linewidth=0)
        base = base + share


def _legend(axes: Axes, colours: Mapping[str, str]) -> None:
    from matplotlib.patches import Patch

    axes.axis("off")
    handles = [Patch(color=colour, label=name) for name, colour in colours.items()]
    if not handles:
        return
    axes.legend(
        handles=handles,
        loc="upper center",
        ncols=min(3, len(handles)),
        frameon=False,
        fontsize=8,
        handlelength=1.2,
        columnspacing=1.2,
    )
