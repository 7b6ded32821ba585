"""Which classes of sounds a vocal learner makes over time, and its stages (figure 5.3.1)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.vocal.classes import CLASSES, TYPES
from sgim.experiments.vocal_history import VocalRun
from sgim.experiments.vocal_stages import LABELS, WINDOWS, Stage, stages_of
from sgim.figures.shares import draw_legend
from sgim.figures.style import new_figure, tidy
from sgim.runs.measured import by_learner

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = dict(zip(CLASSES, ("#BDBDBD", "#56B4E9", "#0072B2"), strict=True))

_ROMAN = ("I", "II", "III", "IV")
_MOST_COLUMNS = 5


def vocal_stages(run: VocalRun) -> Figure:
    """Draw the shares of classes over one run, with its stages and the types in each.

    Figure 5.3.1 of the thesis, and its tables 5.3.2 to 5.3.4.

    Args:
        run: The run.

    Raises:
        JournalError: If it has fewer vocalisations than there are windows.
    """
    found = stages_of(run.history)
    figure = new_figure(7.4, 3.6 + 0.22 * len(found))
    grid = figure.add_gridspec(3, 1, height_ratios=[2.6, 0.3, 0.4 + 0.22 * len(found)])
    axes = figure.add_subplot(grid[0])
    _draw_shares(axes, run, found)
    for number, stage in zip(_ROMAN, found, strict=False):
        middle = (stage.start + stage.end) / 2
        axes.text(middle, 1.02, number, ha="center", va="bottom", fontsize=9)
    axes.set_xlabel("vocalisations")
    axes.set_ylabel("share of vocalisations")
    axes.set_title(_title(run), pad=18)
    tidy(axes)
    draw_legend(figure.add_subplot(grid[1]), COLOURS)
    rows = [[f"{share:.1%}" for share in stage.types] for stage in found]
    names = [f"{n}  {s.label}" for n, s in zip(_ROMAN, found, strict=False)]
    _draw_table(figure.add_subplot(grid[2]), rows, names, list(TYPES))
    return figure


def vocal_classes(runs: Sequence[VocalRun]) -> Figure:
    """Draw the shares of classes for many runs, and count their stages (table 5.3.1).

    Args:
        runs: The runs; each learner has a row of panels, or several, in the order of the seeds.

    Raises:
        JournalError: If one has fewer vocalisations than there are windows.
    """
    groups = by_learner(runs)
    stages = {id(run): stages_of(run.history) for run in runs}
    columns = min(_MOST_COLUMNS, max(map(len, groups.values())))
    rows = {name: -(-len(members) // columns) for name, members in groups.items()}
    heights = [height for name in groups for height in (*[1.3] * rows[name], 1.25)]
    figure = new_figure(max(5.5, 0.6 + 1.8 * columns), 0.5 + sum(heights))
    grid = figure.add_gridspec(len(heights) + 1, columns, height_ratios=[*heights, 0.3])
    row = 0
    for name, members in groups.items():
        for i, run in enumerate(members):
            axes = figure.add_subplot(grid[row + i // columns, i % columns])
            _draw_shares(axes, run, stages[id(run)])
            axes.set_title(f"seed {run.seed}")
            axes.set_xticks([0, len(run.history)])
            tidy(axes)
            if i % columns == 0:
                axes.set_ylabel(name)
            else:
                axes.set_yticklabels([])
        row += rows[name]
        counts = count_stages([stages[id(run)] for run in members])
        cells = [[str(count) for count in line] for line in counts]
        heads = [f"stage {n}" for n in _ROMAN]
        _draw_table(figure.add_subplot(grid[row, :]), cells, list(LABELS), heads)
        row += 1
    draw_legend(figure.add_subplot(grid[-1, :]), COLOURS)
    return figure


def count_stages(several: Sequence[Sequence[Stage]]) -> list[list[int]]:
    """How often each label is that of the first, second, third and fourth stage of a run."""
    counts = Counter((i, stage.label) for found in several for i, stage in enumerate(found))
    return [[counts[i, label] for i in range(len(_ROMAN))] for label in LABELS]


def _draw_shares(axes: Axes, run: VocalRun, stages: Sequence[Stage]) -> None:
    edges = np.linspace(0, len(run.history), WINDOWS + 1)
    base = np.zeros(WINDOWS)
    for shares, colour in zip(run.history.shares(WINDOWS).T, COLOURS.values(), strict=True):
        axes.stairs(base + shares, edges, baseline=base, fill=True, color=colour, linewidth=0)
        base = base + shares
    for stage in stages[1:]:
        axes.axvline(stage.start, color="black", linewidth=1)
    axes.set_xlim(0, len(run.history))
    axes.set_ylim(0, 1)
    axes.set_yticks([0, 0.5, 1], ["0", "50%", "100%"])


def _draw_table(axes: Axes, cells: Any, rows: Sequence[str], columns: Sequence[str]) -> None:
    axes.set_axis_off()
    table = axes.table(cells, rowLabels=list(rows), colLabels=list(columns), loc="center", edges="")
    table.auto_set_font_size(False)
    table.set_fontsize(8)


def _title(run: VocalRun) -> str:
    parts = (run.learner, None if run.seed is None else f"seed {run.seed}")
    return ", ".join(part for part in parts if part) or run.path.stem
