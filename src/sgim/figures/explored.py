"""What a run has explored: the outcomes that its movements produced, and when."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.errors import SgimError
from sgim.figures.style import new_figure, tidy
from sgim.runs.content import outcomes_of
from sgim.runs.summary import read_run
from sgim.spaces import Box, Choices, FloatArray, Space
from sgim.task import Task

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_POINTS = 20_000
"""Points drawn in a panel; of more, every so manieth is."""

_COLOURS = "viridis"
_PARTS = 4
_BINS = 60


def explored(path: str | Path, task: Task | None = None) -> Figure:
    """Draw the outcomes of a run, coloured by when they were produced: a panel for each kind.

    Points of two coordinates are scattered, one coordinate is a histogram, labels are bars. Of
    more than two coordinates, the first two are shown.

    Args:
        path: The journal.
        task: Its task; needed only if its spaces are not part of the library.

    Raises:
        SgimError: If no kind of outcome can be drawn, or none was produced.
        JournalError: If it cannot be read.
    """
    run = read_run(path, task)
    spaces = {
        kind: space
        for kind, space in run.task.outcome_spaces.items()
        if isinstance(space, Box | Choices)
    }
    found = outcomes_of(path, run.task)
    if not any(found[kind][0] for kind in spaces):
        raise SgimError(f"{path} has no outcome that can be drawn")
    widths = [_width(space) for space in spaces.values()]
    figure = new_figure(0.9 + sum(widths), 3.4)
    panels = figure.subplots(1, len(spaces), squeeze=False, width_ratios=widths)[0]
    end = max(1, run.movements)
    for panel, (kind, space) in zip(panels, spaces.items(), strict=True):
        when, points = np.array(found[kind][0]), found[kind][1]
        share = f"{len(when) / end:.0%}" if 0.01 * end <= len(when) else f"{len(when)}"
        panel.set_title(f"{kind}: {share} of {run.movements} movements")
        if len(when):
            _draw(panel, space, when, points, end)
        tidy(panel)
    title = [run.experiment, run.learner, None if run.seed is None else f"seed {run.seed}"]
    figure.suptitle(", ".join(name for name in title if name) or run.path.stem, fontsize=11)
    _colour_bar(figure, list(panels), end)
    return figure


def _draw(axes: Axes, space: Space, when: Any, points: list[Any], end: int) -> None:
    part = np.minimum(when * _PARTS // end, _PARTS - 1)
    if isinstance(space, Choices):
        labels = [label for label in space.labels if label in points]
        counts = [[0] * len(labels) for _ in range(_PARTS)]
        for p, label in zip(part.tolist(), points, strict=True):
            counts[p][labels.index(label)] += 1
        base = np.zeros(len(labels))
        for p, row in enumerate(counts):
            axes.bar(labels, row, bottom=base, color=_colour(p), width=0.8)
            base = base + row
        axes.set_ylabel("movements")
        axes.tick_params(axis="x", rotation=30 if len(labels) > 4 else 0)
        return
    from matplotlib.ticker import MaxNLocator

    assert isinstance(space, Box)
    values = np.array(points)
    names = [f"{n} ({u})" if u else n for n, u in zip(space.names, space.units, strict=True)]
    axes.set_xlabel(names[0])
    if space.dimension == 1:
        groups = [values[part == p, 0] for p in range(_PARTS)]
        span = (float(space.low[0]), float(space.high[0]))
        colours = [_colour(p) for p in range(_PARTS)]
        axes.hist(groups, bins=_BINS, range=span, stacked=True, color=colours)
        axes.set_ylabel("movements")
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_xlim(*span)
        return
    axes.set_ylabel(names[1])
    every = -(-len(values) // MOST_POINTS)
    # The latest would hide the earliest if they were drawn in order.
    order = np.random.default_rng(0).permutation(len(values))[::every]
    axes.scatter(
        values[order, 0],
        values[order, 1],
        c=when[order],
        cmap=_COLOURS,
        vmin=0,
        vmax=end,
        s=float(np.clip(8000 / len(order), 2, 12)),
        linewidths=0,
        alpha=0.8,
        rasterized=True,
    )
    _limit(axes, space, values)


def _is_plane(space: Space) -> bool:
    """Whether both coordinates have the same unit and similar ranges, to be drawn to scale."""
    if not isinstance(space, Box) or space.dimension < 2 or space.units[0] != space.units[1]:
        return False
    return bool(0.5 <= space.range[0] / space.range[1] <= 2)


def _width(space: Space) -> float:
    """Width of a kind's panel in inches."""
    if isinstance(space, Box) and _is_plane(space):
        return max(2.9, 0.9 + 2.5 * float(space.range[0] / space.range[1]))
    return 3.8


def _limit(axes: Axes, space: Box, values: FloatArray) -> None:
    """Show the box with a margin, and say how much lies outside of what is shown."""
    margin = 0.04 * space.range[:2]
    low, high = space.low[:2] - margin, space.high[:2] + margin
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    if _is_plane(space):
        axes.set_aspect("equal")
    outside = float(((values[:, :2] < low) | (values[:, :2] > high)).any(axis=1).mean())
    if outside >= 0.005:
        axes.text(
            0.99,
            0.99,
            f"{outside:.0%} lie beyond",
            transform=axes.transAxes,
            ha="right",
            va="top",
            fontsize=8,
            bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1.5},
        )


def _colour(part: int) -> Any:
    from matplotlib import colormaps

    return colormaps[_COLOURS]((part + 0.5) / _PARTS)


def _colour_bar(figure: Figure, panels: list[Axes], end: int) -> None:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    colours = ScalarMappable(Normalize(0, end), _COLOURS)
    bar = figure.colorbar(colours, ax=panels, fraction=0.04, pad=0.02)
    bar.set_label("movement", fontsize=9)
    bar.ax.tick_params(labelsize=8)
