"""Where learners went: the outcomes they produced, or the goals they chose, as histograms."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from sgim.figures.style import OKABE_ITO, NothingToDrawError, new_figure, read_runs, tidy
from sgim.runs.content import shown_outcomes_of
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun
from sgim.spaces import Box, FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Places = Literal["outcomes", "goals"]

_BINS = 40
_COLUMNS = 4
_MARGIN = 0.05


def places(journals: Iterable[str | Path | RecordedRun], what: Places = "outcomes") -> Figure:
    """Draw how often learners went where: a panel a learner, all its runs together.

    Of two coordinates or more, the first two are counted in square bins, on a logarithmic scale,
    and what was demonstrated is marked by crosses; one coordinate is a histogram. The figures
    3.4.2, 3.4.4, 3.5.2, 3.6.3 and 4.2.9a of the thesis are of this sort. Where a task has several
    kinds of outcomes, each has its rows.

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        what: The ``outcomes`` produced, or the ``goals`` chosen.

    Raises:
        NothingToDrawError: If there are none, or none that are boxes.
        SgimError: If the runs are of different experiments.
        JournalError: If one cannot be read.
    """
    runs = read_runs(journals)
    spaces = {k: s for k, s in runs[0].task.outcome_spaces.items() if isinstance(s, Box)}
    found = {
        kind: {
            name: (_points(members, kind, what), members)
            for name, members in by_learner(runs).items()
        }
        for kind in spaces
    }
    panels = [
        (kind, name, points, members)
        for kind, learners in found.items()
        for name, (points, members) in learners.items()
        if len(points)
    ]
    if not panels:
        raise NothingToDrawError(f"no run has {what} that are boxes")
    rows = -(-len(panels) // _COLUMNS)
    columns = min(_COLUMNS, len(panels))
    figure = new_figure(0.6 + 2.2 * columns, 0.2 + 2.2 * rows)
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes in grid.ravel()[len(panels) :]:
        axes.axis("off")
    views = {
        kind: _view(space, [points for its, _, points, _ in panels if its == kind])
        for kind, space in spaces.items()
    }
    for axes, (kind, name, points, members) in zip(grid.ravel(), panels, strict=False):
        space, view = spaces[kind], views[kind]
        if space.dimension == 1:
            axes.hist(points[:, 0], bins=_BINS, range=(view[0, 0], view[1, 0]), color=OKABE_ITO[0])
            axes.set_yscale("log")
        else:
            _count(axes, points, view)
            if what == "outcomes":
                _mark(axes, kind, members)
            axes.set_ylabel(space.names[1])
        axes.set_xlabel(space.names[0] if len(spaces) == 1 else f"{kind}: {space.names[0]}")
        axes.set_title(name)
        inside = ((points >= space.low) & (points <= space.high)).all(axis=1).mean()
        if inside < 0.995:
            axes.set_title(f"{name}\n{inside:.0%} in the box")
        tidy(axes)
    return figure


def _points(members: Sequence[RecordedRun], kind: str, what: Places) -> FloatArray:
    parts = [run.produced(kind) if what == "outcomes" else run.aimed_at(kind)[1] for run in members]
    parts = [part for part in parts if len(part)]
    return np.concatenate(parts) if parts else np.empty((0, 1))


def _view(space: Box, several: Sequence[FloatArray]) -> FloatArray:
    """What is shown of a space: the box, or less of it if nothing lies further out."""
    if not several:
        return np.stack([space.low, space.high])
    points = np.concatenate(several)
    points = points[((points >= space.low) & (points <= space.high)).all(axis=1)]
    if not len(points):
        return np.stack([space.low, space.high])
    margin = _MARGIN * np.ptp(points, axis=0)
    low = np.maximum(space.low, points.min(axis=0) - margin)
    high = np.minimum(space.high, points.max(axis=0) + margin)
    return np.stack([low, np.maximum(high, low + 1e-9)])


def _count(axes: Axes, points: FloatArray, view: FloatArray) -> None:
    from matplotlib.colors import LogNorm

    span = view[1, :2] - view[0, :2]
    equal = 0.5 <= span[0] / span[1] <= 2
    side = span.max() / _BINS if equal else None
    bins = [
        np.arange(view[0, i], view[1, i] + side, side)
        if side
        else np.linspace(view[0, i], view[1, i], _BINS + 1)
        for i in range(2)
    ]
    axes.hist2d(
        points[:, 0], points[:, 1], bins=bins, cmap="viridis", norm=LogNorm(), rasterized=True
    )
    if equal:
        axes.set_aspect("equal")


def _mark(axes: Axes, kind: str, members: Sequence[RecordedRun]) -> None:
    """Crosses where demonstrations ended."""
    shown = [shown_outcomes_of(run.path, run.task, kind) for run in members]
    shown = [part for part in shown if len(part)]
    if shown:
        places = np.unique(np.concatenate(shown), axis=0)
        axes.plot(
            places[:, 0], places[:, 1], "x", color="black", markersize=2.5, markeredgewidth=0.6
        )
