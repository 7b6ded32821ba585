"""How the errors of learners fall, over movements or over what they cost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.errors import SgimError
from sgim.experiments import EXPERIMENTS
from sgim.figures.curves import BANDS, Band, Curve, curve
from sgim.figures.panels import (
    add_legend,
    error_kinds,
    kind_title,
    learner_labels,
    new_panels,
    scale,
)
from sgim.figures.style import MARKERS, OKABE_ITO, NothingToDrawError, read_runs, tidy
from sgim.runs.costs import Prices, Spending, read_spending
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_MARKERS = 20
"""Markers on a line; between them it has none."""

_UNITS = ((3600.0, "h"), (60.0, "min"), (1.0, "s"))


def error_curves(
    journals: Iterable[str | Path | RecordedRun],
    *,
    band: Band = "interval",
    prices: Prices | None = None,
    columns: int | None = None,
) -> Figure:
    """Draw errors of learners: a panel for each kind of goal, and one for their mean.

    Each learner has a line and a band over its runs (figures 4.3.7 and 4.3.8 of the thesis).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        band: ``"interval"``: the line is the interquartile mean, the band its pointwise bootstrap
            interval; ``"quartiles"``: the median, and the quartiles.
        prices: Draw over the time of robot and persons instead of over movements: as recorded,
            and at these prices where nothing is recorded.
        columns: Panels in a row; all if None.

    Raises:
        SgimError: If they are of different experiments, or none was ever evaluated.
        NothingToDrawError: If prices are given, but nobody was asked, and no time is recorded:
            there is no cost but the movements.
        JournalError: If one cannot be read.
    """
    runs = [run for run in read_runs(journals) if run.evaluations]
    if not runs:
        raise SgimError("no run was evaluated: there are no errors to draw")
    groups = by_learner(runs)
    kinds = error_kinds(runs)
    spent = None if prices is None else _spending(groups)
    labels = learner_labels(groups)
    figure, panels, legend_columns = new_panels(len(kinds), columns, labels)
    for panel, kind in zip(panels, kinds, strict=True):
        curves = []
        for name, members in groups.items():
            costs = None
            if spent is not None and prices is not None:
                costs = [one.cost(prices) for one in spent[name]]
            curves.append(curve(members, kind, band, costs))
        unit, label = _axis(curves, spent, prices)
        for i, (name, drawn) in enumerate(zip(labels, curves, strict=True)):
            draw_curve(panel, drawn, unit, name, i)
        panel.set_title(kind_title(kind))
        panel.set_xlabel(label)
        panel.set_xlim(left=0)
        scale(panel, "y", np.concatenate([drawn.middle for drawn in curves]))
        panel.grid(axis="y", color="#E5E5E5", linewidth=0.6)
        tidy(panel)
    experiment = EXPERIMENTS.get(runs[0].experiment or "")
    panels[0].set_ylabel(f"error ({experiment.unit})" if experiment else "error")
    add_legend(figure, panels[0], legend_columns, BANDS[band] if len(runs) > len(groups) else None)
    return figure


def _spending(groups: Mapping[str, Sequence[RecordedRun]]) -> dict[str, list[Spending]]:
    spent = {name: [read_spending(run.path) for run in runs] for name, runs in groups.items()}
    if not any(one.recorded or one.asked.any() for runs in spent.values() for one in runs):
        raise NothingToDrawError("nobody was asked, and no time is recorded")
    return spent


def draw_curve(axes: Axes, drawn: Curve, unit: float, label: str, number: int) -> None:
    """Draw the curve of one learner, unlike those of the others in colour, line and marker."""
    colour = OKABE_ITO[number % len(OKABE_ITO)]
    line = ("-", "--", ":")[number // len(OKABE_ITO) % 3]
    axes.fill_between(drawn.x / unit, drawn.low, drawn.high, color=colour, alpha=0.18, linewidth=0)
    axes.plot(
        drawn.x / unit,
        drawn.middle,
        line + MARKERS[number % len(MARKERS)],
        color=colour,
        label=label,
        markersize=3.5,
        markevery=ceil(len(drawn.x) / _MOST_MARKERS) or 1,
        linewidth=1.4,
    )


def _axis(
    curves: Sequence[Curve],
    spent: Mapping[str, Sequence[Spending]] | None,
    prices: Prices | None,
) -> tuple[float, str]:
    """The unit of the axis, in what curves have, and its label."""
    if spent is None or prices is None:
        return 1.0, "movements"
    end = max(float(drawn.x[-1]) for drawn in curves if len(drawn.x))
    unit, name = next((u, n) for u, n in _UNITS if end >= 2 * u or u == 1)
    all_spent = [one for members in spent.values() for one in members]
    if all(not (s.movements.any() or s.requests.any()) for s in all_spent):
        return unit, f"time of robot and persons ({name})"
    at = f"{prices.robot_seconds:g} s a movement, {prices.person_seconds:g} s a request"
    unless = ",\nwhere not recorded" if any(s.recorded for s in all_spent) else ""
    return unit, f"time of robot and persons ({name})\n{at}{unless}"
