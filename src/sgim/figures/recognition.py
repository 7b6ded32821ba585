"""What is recognised while objects are manipulated (figures 2.3.2 and 2.3.3 of the thesis)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sgim.experiments.recognition_benchmark import TAKEN_FOR
from sgim.figures.curves import BANDS, Band, curve
from sgim.figures.style import MARKERS, OKABE_ITO, NothingToDrawError, new_figure, read_runs, tidy
from sgim.runs.measured import by_learner
from sgim.runs.summary import RecordedRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def recognised(journals: Iterable[str | Path | RecordedRun], *, band: Band = "interval") -> Figure:
    """Draw how many pictures of an object are recognised, in the mean of the objects.

    Each caregiver has a panel, and each learner a line and a band over its runs (figure 2.3.2).

    Args:
        journals: Journals of runs of one experiment, or the runs read already.
        band: What line and band are, a key of `BANDS`.

    Raises:
        NothingToDrawError: If no run was measured by pictures.
        SgimError: If they are of different experiments.
        JournalError: If one cannot be read.
    """
    runs = _measured_by_pictures(read_runs(journals))
    groups = by_learner(runs)
    panels: dict[str, list[str]] = {}
    for name in groups:
        panels.setdefault(name.partition(":")[2], []).append(name)
    learners = list(dict.fromkeys(name.partition(":")[0] for name in groups))
    presented, least = _labels(runs[0]), float(_each(runs[0]))
    figure = new_figure(1.0 + 3.6 * len(panels), 3.4)
    drawn = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
    for axes, (asked, names) in zip(drawn, panels.items(), strict=True):
        for name in names:
            learner, several = name.partition(":")[0], groups[name]
            each, found = _each(several[0]), curve(several, "total", band)
            style = learners.index(learner)
            colour = OKABE_ITO[style % len(OKABE_ITO)]
            low, middle, high = (each * (1 - x) for x in (found.high, found.middle, found.low))
            least = min([least, *low[found.x >= len(presented)].tolist()])
            many = f" ({len(several)} runs)" if len(several) > 1 else ""
            axes.fill_between(found.x, low, high, color=colour, alpha=0.18, linewidth=0)
            axes.plot(
                found.x,
                middle,
                "-" + MARKERS[style % len(MARKERS)],
                color=colour,
                label=learner + many,
                linewidth=1.4,
                markersize=3.5,
                markevery=10,
            )
        axes.set_title(f"caregiver: {asked}" if asked else "")
        axes.set_xlabel("episodes")
        axes.set_xlim(left=0)
        axes.grid(axis="y", color="#E5E5E5", linewidth=0.6)
        axes.legend(frameon=False, fontsize=8, loc="lower right")
        tidy(axes)
    # From where every object has been presented on; before, all curves are alike.
    drawn[0].set_ylim(np.floor(least) - 1, _each(runs[0]))
    drawn[0].set_ylabel(f"pictures recognised, of {_each(runs[0])}")
    if len(runs) > len(groups):
        figure.supxlabel(BANDS[band], fontsize=8)
    return figure


def f_measures(journal: str | Path | RecordedRun) -> Figure:
    """Draw the f-measure of each object over the episodes of one run (figure 2.3.3).

    The f-measure is the harmonic mean of precision and recall. Below is the object that was
    manipulated in each episode, in a row and colour of its own.

    Args:
        journal: The journal of a run, or the run read already.

    Raises:
        NothingToDrawError: If it was not measured by pictures.
        JournalError: If it cannot be read.
    """
    (run,) = _measured_by_pictures(read_runs([journal]))
    labels = _labels(run)
    figure = new_figure(6.4, 4.2)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    movements = [evaluation.movements for evaluation in run.evaluations]
    for i, label in enumerate(labels):
        colour = OKABE_ITO[i % len(OKABE_ITO)]
        upper.plot(movements, _f_measure(run, label), color=colour, label=label, linewidth=1.3)
        at = [n for n, chosen in enumerate(run.openings.labels) if chosen == label]
        lower.scatter(at, [i] * len(at), s=9, marker="s", color=colour, linewidths=0)
    upper.set_ylabel("f-measure")
    upper.set_ylim(-0.02, 1.02)
    upper.grid(axis="y", color="#E5E5E5", linewidth=0.6)
    upper.legend(frameon=False, fontsize=8, ncols=len(labels), loc="lower right")
    upper.set_title(f"{run.learner}, seed {run.seed}")
    _name_rows(lower, labels)
    lower.set_xlabel("episodes")
    lower.set_xlim(0, max(movements))
    for axes in (upper, lower):
        tidy(axes)
    return figure


def _name_rows(axes: Axes, labels: Sequence[str]) -> None:
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.set_ylabel("manipulated")


def _f_measure(run: RecordedRun, label: str) -> FloatArray:
    """2 · right / (2 · right + missed + taken wrongly), at each evaluation."""
    missed = np.array([e.errors[label] for e in run.evaluations])
    wrong = np.array([e.errors[f"{TAKEN_FOR} {label}"] for e in run.evaluations])
    right = 2 * (1 - missed)
    measure: FloatArray = np.divide(
        right, right + missed + wrong, out=np.zeros_like(right), where=right > 0
    )
    return measure


def _labels(run: RecordedRun) -> list[str]:
    """The objects."""
    assert run.benchmark is not None
    return list(run.benchmark["pictures"])


def _each(run: RecordedRun) -> int:
    """How many pictures of each object a run was measured by."""
    assert run.benchmark is not None
    counts: Sequence[int] = [*run.benchmark["pictures"].values()]
    return counts[0]


def _measured_by_pictures(runs: Sequence[RecordedRun]) -> list[RecordedRun]:
    by_pictures = [r for r in runs if r.evaluations and "pictures" in (r.benchmark or {})]
    if not by_pictures:
        raise NothingToDrawError("no run was measured by pictures to recognise")
    return by_pictures
