"""What each strategy brings a vocal learner, and how often it is chosen (figures 5.3.5, 5.3.6)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from sgim.experiments.vocal import BATCH
from sgim.experiments.vocal_history import VocalHistory, VocalRun
from sgim.figures.style import NothingToDrawError, new_figure, tidy
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STRATEGIES = {"autonomous": "#4D4D4D", "emulate": "#0072B2"}
"""First words of the modes' names, and their colours."""

SMOOTHING = 100
"""Updates of the model in a window, as in the thesis."""


def vocal_strategies(runs: Sequence[VocalRun]) -> Figure:
    """Draw competence, progress and choice of each strategy over the updates of the model.

    Progress is by how much the mean competence of a window of a hundred updates exceeds that of
    the window before it. Thin lines are runs; the thick one is their mean.

    Args:
        runs: Runs of one learner that chooses between exploring and emulating.

    Raises:
        NothingToDrawError: If no run emulates, or all are shorter than two windows.
    """
    usable = [
        run.history
        for run in runs
        if run.history.of_mode("emulate").any() and len(run.history) >= 2 * SMOOTHING * BATCH
    ]
    if not usable:
        raise NothingToDrawError("no run emulates for long enough to draw its strategies")
    figure = new_figure(8.0, 6.6)
    panels: dict[str, Axes] = {}
    titles = ("competence", "progress in a hundred updates", "share of vocalisations")
    for i, title in enumerate(titles):
        panels[title] = figure.add_subplot(3, 1, i + 1)
        panels[title].set_ylabel(title)
    for word, colour in STRATEGIES.items():
        curves = [strategy_curves(history, word) for history in usable]
        shortest = min(len(values[0]) for values in curves)
        for axes, several in zip(panels.values(), zip(*curves, strict=True), strict=True):
            lines = np.array([values[:shortest] for values in several])
            updates = np.arange(shortest)
            for line in lines if len(lines) > 1 else []:
                axes.plot(updates, line, color=colour, alpha=0.25, linewidth=0.7)
            counted = np.isfinite(lines).sum(axis=0)
            mean = np.where(counted, np.nansum(lines, axis=0) / np.maximum(counted, 1), np.nan)
            axes.plot(updates, mean, color=colour, linewidth=2, label=word)
    panels[titles[1]].axhline(0, color="black", linewidth=0.6)
    panels[titles[2]].set_ylim(0, 1)
    panels[titles[0]].legend(frameon=False, fontsize=8)
    panels[titles[2]].set_xlabel("updates of the model")
    for axes in panels.values():
        tidy(axes)
    return figure


def strategy_curves(history: VocalHistory, word: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Smoothed competence, progress and share of a strategy at each update of the model.

    Args:
        history: The vocalisations of a run.
        word: First word of the modes' names.

    Returns:
        Each of shape ``(updates,)``, NaN where there is nothing to tell.
    """
    updates = len(history) // BATCH
    chosen = history.of_mode(word)[: updates * BATCH].reshape(updates, BATCH)
    shown = history.competences[: updates * BATCH].reshape(updates, BATCH)
    counts = chosen.sum(axis=1)
    sums = np.where(chosen, np.nan_to_num(shown), 0.0).sum(axis=1)
    competence = _windowed(sums) / np.maximum(_windowed(counts), 1)
    competence = np.where(_windowed(counts) > 0, competence, np.nan)
    progress = np.full(updates, np.nan)
    progress[SMOOTHING:] = competence[SMOOTHING:] - competence[:-SMOOTHING]
    return competence, progress, _windowed(counts) / _windowed(np.full(updates, BATCH))


def _windowed(values: FloatArray) -> FloatArray:
    """Sums over each value and those before it, a window in all."""
    total = np.concatenate(([0.0], np.cumsum(values)))
    ends = np.arange(1, len(values) + 1)
    sums: FloatArray = total[ends] - total[np.maximum(ends - SMOOTHING, 0)]
    return sums
