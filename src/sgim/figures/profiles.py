"""How many of a learner's runs are how good: performance profiles of their errors."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.experiments import EXPERIMENTS
from sgim.figures.panels import (
    add_legend,
    error_kinds,
    kind_title,
    learner_labels,
    new_panels,
    scale,
)
from sgim.figures.style import OKABE_ITO, read_runs, tidy
from sgim.runs.comparable import select
from sgim.runs.summary import RecordedRun
from sgim.statistics import profile_estimate
from sgim.streams import Streams

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_THRESHOLDS = 200


def performance_profiles(
    journals: Iterable[str | Path | RecordedRun],
    *,
    at: int | None = None,
    columns: int | None = None,
) -> Figure:
    """Draw, for each learner, the share of its runs whose error is at most what the axis says.

    A panel for each kind of goal, and one for their mean, at one evaluation. The band is the 95 %
    bootstrap interval at each threshold. Of two learners, one is better throughout if its line is
    nowhere below the other's (Agarwal et al. 2021).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        at: The evaluation, in movements; the last that all have if None.
        columns: Panels in a row; all if None.

    Raises:
        SgimError: If the runs cannot be compared; the message says which, and what to do.
        JournalError: If one cannot be read.
    """
    runs = read_runs(journals)
    kinds = error_kinds([run for run in runs if run.evaluations] or runs)
    chosen = {kind: select(runs, kind, at) for kind in kinds}
    groups = chosen[kinds[0]].groups
    labels = learner_labels(groups)
    figure, panels, legend_columns = new_panels(len(kinds), columns, labels)
    experiment = EXPERIMENTS.get(runs[0].experiment or "")
    unit = f"\n({experiment.unit})" if experiment else ""
    for panel, kind in zip(panels, kinds, strict=True):
        errors = [chosen[kind].errors(members)[:, -1] for members in groups.values()]
        everything = np.concatenate(errors)
        low, high = everything.min(), everything.max()
        space = np.geomspace if 0 < 10 * low < high else np.linspace
        thresholds = np.unique(np.concatenate([space(low, high, _THRESHOLDS), everything]))
        for i, (label, values) in enumerate(zip(labels, errors, strict=True)):
            found = profile_estimate(values, thresholds, Streams(0)(f"bootstrap/profile/{kind}"))
            colour = OKABE_ITO[i % len(OKABE_ITO)]
            line = ("-", "--", ":")[i // len(OKABE_ITO) % 3]
            panel.fill_between(
                thresholds,
                found.low,
                found.high,
                color=colour,
                alpha=0.12,
                linewidth=0,
                step="post",
            )
            panel.step(
                thresholds,
                found.value,
                line,
                where="post",
                color=colour,
                label=label,
                linewidth=1.4,
            )
        panel.set_title(kind_title(kind))
        panel.set_xlabel(f"error at most{unit}")
        panel.set_ylim(0, 1.02)
        panel.set_yticks([0, 0.5, 1], ["0", "50%", "100%"])
        scale(panel, "x", everything)
        panel.grid(axis="y", color="#E5E5E5", linewidth=0.6)
        tidy(panel)
    panels[0].set_ylabel("share of the runs")
    add_legend(figure, panels[0], legend_columns, None)
    return figure
