"""Panels side by side, one for each kind of goal, with one legend of learners below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil
from typing import TYPE_CHECKING, Literal

import numpy as np

from sgim.experiments.recognition_benchmark import TAKEN_FOR
from sgim.figures.style import new_figure
from sgim.runs.measured import MeasuredRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LOGARITHMIC = 10.0
"""Ratio of the largest to the smallest value from which a scale is logarithmic."""

_LEGEND_SIZE = 8.0  # points


def error_kinds(runs: Sequence[MeasuredRun]) -> list[str]:
    """Kinds of goal whose errors are drawn: with their mean, ``total``, if there are several."""
    kinds = [k for k in runs[0].evaluations[-1].errors if not k.startswith(TAKEN_FOR)]
    if all(e.errors["total"] == e.errors[kinds[0]] for run in runs for e in run.evaluations):
        kinds.remove("total")  # there is one kind only
    return kinds


def kind_title(kind: str) -> str:
    """The title of a panel for a kind of goal."""
    return "total (mean of the kinds)" if kind == "total" else kind


def learner_labels(groups: Mapping[str, Sequence[object]]) -> list[str]:
    """Names of learners, with how many runs they have if they are several."""
    return [
        name if len(members) == 1 else f"{name} ({len(members)} runs)"
        for name, members in groups.items()
    ]


def new_panels(
    count: int, columns: int | None, labels: Sequence[str]
) -> tuple[Figure, list[Axes], int]:
    """A figure with so many panels, and room for a legend below.

    Args:
        count: How many panels.
        columns: How many of them in a row; all if None.
        labels: Of the legend.

    Returns:
        The figure, its panels, and how many columns its legend has room for.
    """
    columns = min(count, columns or count)
    rows = ceil(count / columns)
    width = max(4.0, 3.1 * columns)
    legend_columns = _legend_columns(labels, 72 * width)
    legend = 0.5 + 0.18 * ceil(len(labels) / legend_columns)
    figure = new_figure(width, 2.9 * rows + legend)
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for panel in panels[count:]:
        panel.set_axis_off()
    return figure, panels[:count], legend_columns


def add_legend(figure: Figure, panel: Axes, columns: int, title: str | None) -> None:
    """Put the legend of one panel's lines below all panels."""
    figure.legend(
        *panel.get_legend_handles_labels(),
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        fontsize=_LEGEND_SIZE,
        title=title,
        title_fontsize=_LEGEND_SIZE,
    )


def scale(panel: Axes, which: Literal["x", "y"], values: FloatArray) -> None:
    """Choose a linear or a logarithmic scale for these values, with plain numbers as labels."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axis = panel.yaxis if which == "y" else panel.xaxis
    low, high = float(np.min(values)), float(np.max(values))
    if low <= 0 or high <= _LOGARITHMIC * low:
        panel.set(**{f"{which}lim": (0, None)})
        return
    panel.set(**{f"{which}scale": "log"})
    steps = (1.0,) if high > 100 * low else (1.0, 2.0, 5.0)
    axis.set_major_locator(LogLocator(subs=steps))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_formatter(NullFormatter())


def _legend_columns(labels: Sequence[str], width: float) -> int:
    """How many columns of a legend, at most 4, fit into so many points."""
    from matplotlib.textpath import TextPath

    handle = 5 * _LEGEND_SIZE  # with the gaps beside it
    widths = [
        TextPath((0, 0), label, size=_LEGEND_SIZE).get_extents().width + handle for label in labels
    ]
    for columns in range(min(4, len(labels)), 1, -1):
        if sum(part.max() for part in np.array_split(widths, columns)) < 0.95 * width:
            return columns
    return 1
