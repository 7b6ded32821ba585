"""Shares of choices over time, stacked; what the figures of choices have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from sgim.runs.summary import Openings, RecordedRun
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_EPISODES = 40
"""Episodes that a window should hold, all runs together, before windows get narrower."""


def windows(runs: Sequence[RecordedRun]) -> FloatArray:
    """Edges of the windows over movements in which choices of these runs are counted."""
    episodes = sum(len(run.openings.modes) for run in runs)
    number = int(np.clip(episodes // _EPISODES, 4, 24))
    return np.linspace(0, max(1, *(run.movements for run in runs)), number + 1)


def draw_shares(
    axes: Axes,
    openings: Openings,
    edges: FloatArray,
    what: str,
    colours: Mapping[str, str],
    end: float,
) -> None:
    """Stack the shares of ``"modes"`` or ``"kinds"`` over movements; a window without is blank.

    Args:
        axes: The panel.
        openings: The episodes counted.
        edges: Of the windows, shape ``(w + 1,)``.
        what: ``"modes"`` or ``"kinds"``.
        colours: Name → colour, in the order of stacking from below.
        end: Where the axis of movements ends.
    """
    found = openings.shares(edges)
    base = np.zeros(len(edges) - 1)
    for name, colour in colours.items():
        share = np.array([shares[what].get(name, 0.0) for shares in found])
        axes.stairs(base + share, edges, baseline=base, fill=True, color=colour, linewidth=0)
        base = base + share
    if not base.any():
        axes.text(0.5, 0.5, "no goals", transform=axes.transAxes, ha="center", fontsize=8)
    axes.set_xlim(0, end)
    axes.set_ylim(0, 1)
    axes.set_yticks([0, 0.5, 1], ["0", "50%", "100%"])


def draw_legend(axes: Axes, colours: Mapping[str, str], columns: int = 3) -> None:
    """Fill a panel with the legend of these colours."""
    from matplotlib.patches import Patch

    axes.axis("off")
    handles = [Patch(color=colour, label=name) for name, colour in colours.items()]
    if not handles:
        return
    axes.legend(
        handles=handles,
        loc="upper center",
        ncols=min(columns, len(handles)),
        frameon=False,
        fontsize=8,
        handlelength=1.2,
        columnspacing=1.2,
    )
