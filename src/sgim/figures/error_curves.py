"""How the errors of learners fall: medians and interquartile bands over seeds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.errors import SgimError
from sgim.experiments import EXPERIMENTS
from sgim.figures.style import MARKERS, OKABE_ITO, by_learner, new_figure, read_runs, tidy
from sgim.runs.summary import RecordedRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LOGARITHMIC = 10.0
"""Ratio of the largest to the smallest median from which the scale is logarithmic."""

_MOST_MARKERS = 20
"""Markers on a line; between them it has none."""

_LEGEND_SIZE = 8.0  # points


def error_curves(paths: Iterable[str | Path]) -> Figure:
    """Draw errors over movements: a panel for each kind of goal, and one for their mean.

    Each learner has a line, the median over its runs, and a band between the quartiles.

    Args:
        paths: Journals of runs of one experiment.

    Raises:
        SgimError: If they are of different experiments, or none was ever evaluated.
        JournalError: If one cannot be read.
    """
    runs = [run for run in read_runs(paths) if run.evaluations]
    if not runs:
        raise SgimError("no run was evaluated: there are no errors to draw")
    groups = by_learner(runs)
    kinds = list(runs[0].evaluations[-1].errors)
    if all(e.errors["total"] == e.errors[kinds[0]] for run in runs for e in run.evaluations):
        kinds.remove("total")  # there is one kind only
    labels = [
        name if len(members) == 1 else f"{name} ({len(members)} runs)"
        for name, members in groups.items()
    ]
    width = max(4.0, 3.1 * len(kinds))
    columns = _legend_columns(labels, 72 * width)
    figure = new_figure(width, 3.2 + 0.18 * ceil(len(labels) / columns))
    panels = figure.subplots(1, len(kinds), squeeze=False)[0]
    for panel, kind in zip(panels, kinds, strict=True):
        medians = []
        for i, (label, members) in enumerate(zip(labels, groups.values(), strict=True)):
            movements, quartiles = _quartiles(members, kind)
            colour = OKABE_ITO[i % len(OKABE_ITO)]
            line, marker = ("-", "--", ":")[i // len(OKABE_ITO) % 3], MARKERS[i % len(MARKERS)]
            panel.fill_between(
                movements, quartiles[0], quartiles[2], color=colour, alpha=0.18, linewidth=0
            )
            panel.plot(
                movements,
                quartiles[1],
                line + marker,
                color=colour,
                label=label,
                markersize=3.5,
                markevery=ceil(len(movements) / _MOST_MARKERS) or 1,
                linewidth=1.4,
            )
            medians.append(quartiles[1])
        panel.set_title("total (mean of the kinds)" if kind == "total" else kind)
        panel.set_xlabel("movements")
        panel.set_xlim(left=0)
        _scale(panel, np.concatenate(medians))
        panel.grid(axis="y", color="#E5E5E5", linewidth=0.6)
        tidy(panel)
    experiment = EXPERIMENTS.get(runs[0].experiment or "")
    panels[0].set_ylabel(f"error ({experiment.unit})" if experiment else "error")
    figure.legend(
        *panels[0].get_legend_handles_labels(),
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        fontsize=_LEGEND_SIZE,
    )
    return figure


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


def _scale(axes: Axes, values: FloatArray) -> None:
    """Choose a linear or a logarithmic scale for these errors, with plain numbers as labels."""
    from matplotlib.ticker import LogLocator, NullFormatter

    low, high = float(values.min()), float(values.max())
    if low <= 0 or high <= _LOGARITHMIC * low:
        axes.set_ylim(bottom=0)
        return
    axes.set_yscale("log")
    steps = (1.0,) if high > 100 * low else (1.0, 2.0, 5.0)
    axes.yaxis.set_major_locator(LogLocator(subs=steps))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())


def _quartiles(runs: Sequence[RecordedRun], kind: str) -> tuple[FloatArray, FloatArray]:
    """Quartiles of the errors wherever half of the runs or more were evaluated.

    Returns:
        Movements, shape ``(n,)``, and lower quartiles, medians and upper quartiles, ``(3, n)``.
    """
    errors: dict[int, list[float]] = {}
    for run in runs:
        for evaluation in run.evaluations:
            if kind in evaluation.errors:
                errors.setdefault(evaluation.movements, []).append(evaluation.errors[kind])
    shown = sorted(m for m, values in errors.items() if 2 * len(values) >= len(runs))
    columns = [np.percentile(errors[m], [25, 50, 75]) for m in shown]
    return np.array(shown, dtype=np.float64), np.array(columns).reshape(-1, 3).T
