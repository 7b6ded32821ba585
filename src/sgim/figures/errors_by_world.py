"""How the errors of learners fall in many worlds, a panel each."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.errors import SgimError
from sgim.experiments import EXPERIMENTS
from sgim.figures.curves import BANDS, Band, Curve, curve
from sgim.figures.error_curves import draw_curve
from sgim.figures.panels import add_legend, new_panels, scale
from sgim.figures.style import tidy
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun, read_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = 4


def errors_by_world(
    journals: Iterable[str | Path | RecordedRun], *, band: Band = "interval", columns: int = COLUMNS
) -> Figure:
    """Draw the total error over movements: a panel for each experiment, a line for each learner.

    Runs of one learner may have been evaluated at different times, few often and others late: a
    line has every time at which half of its runs were, from the first movement on.

    Args:
        journals: Journals of runs, or the runs read already.
        band: What lines and bands are, as in `error_curves`.
        columns: Panels in a row.

    Raises:
        SgimError: If none was ever evaluated.
        JournalError: If one cannot be read.
    """
    worlds: dict[str, list[RecordedRun]] = {}
    for run in (one if isinstance(one, RecordedRun) else read_run(one) for one in journals):
        if run.evaluations:
            worlds.setdefault(run.experiment or "runs", []).append(run)
    if not worlds:
        raise SgimError("no run was evaluated: there are no errors to draw")
    order = list(EXPERIMENTS)
    names = sorted(worlds, key=lambda name: order.index(name) if name in order else len(order))
    groups = {name: by_learner(worlds[name]) for name in names}
    learners = list(dict.fromkeys(learner for group in groups.values() for learner in group))
    figure, panels, legend_columns = new_panels(len(names), columns, learners)
    for panel, name in zip(panels, names, strict=True):
        curves = {
            learner: _begun(curve(runs, "total", band)) for learner, runs in groups[name].items()
        }
        for i, learner in enumerate(learners):
            if learner in curves:
                draw_curve(panel, curves[learner], 1.0, learner, i)
        unit = EXPERIMENTS[name].unit if name in EXPERIMENTS else ""
        panel.set_title(f"{name} ({unit})" if unit else name)
        scale(panel, "x", np.concatenate([drawn.x for drawn in curves.values()]))
        scale(panel, "y", np.concatenate([drawn.middle for drawn in curves.values()]))
        panel.grid(axis="y", color="#E5E5E5", linewidth=0.6)
        tidy(panel)
    for panel in panels[-columns:]:  # those that have none beneath
        panel.set_xlabel("movements")
    for panel in panels[::columns]:
        panel.set_ylabel("error")
    fullest = max(range(len(names)), key=lambda i: len(groups[names[i]]))
    add_legend(figure, panels[fullest], legend_columns, BANDS[band])
    return figure


def _begun(whole: Curve) -> Curve:
    """A curve without what was measured before the first movement, which has no logarithm."""
    made = whole.x > 0
    return Curve(whole.x[made], whole.low[made], whole.middle[made], whole.high[made])
