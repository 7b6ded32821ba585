"""The air hockey table with movements on it: where the mallet goes, and the puck (fig. 4.2.3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.hockey import (
    MALLET_RADIUS,
    MALLET_STEP,
    PUCK_RADIUS,
    AirHockey,
    Shot,
)
from sgim.environments.hockey_collisions import Block
from sgim.errors import SgimError
from sgim.figures.style import OKABE_ITO, new_figure
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_MOVEMENTS = 12
_COLUMNS = 4
_PUCK, _MALLET = OKABE_ITO[1], OKABE_ITO[0]
_DOT_EVERY = 0.1
_MARGIN = 0.06


def hockey_shots(policies: Sequence[Any] | FloatArray, table: AirHockey | None = None) -> Figure:
    """Draw movements, a panel each: obstacle, path of the mallet and path of the puck.

    Circles show mallet and puck at their true size, where they meet and where they end.

    Args:
        policies: One to 12 policies, shape ``(n, 14)``.
        table: The table; by default that of the experiment.

    Raises:
        SgimError: If there are none or more.
        SpaceError: If they have another shape.
    """
    if not 1 <= len(policies) <= MOST_MOVEMENTS:
        raise SgimError(f"{len(policies)} movements came, expected 1 to {MOST_MOVEMENTS}: choose")
    world = AirHockey() if table is None else table
    shots = world.shots(policies)
    columns = min(_COLUMNS, len(shots))
    rows = -(-len(shots) // columns)
    figure = new_figure(0.4 + 2.2 * columns, 0.55 + 2.4 * rows)
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for panel, shot in zip(panels, shots, strict=False):
        _draw_table(panel, world.obstacle)
        _draw_shot(panel, shot)
        panel.set_title(_title(shot), fontsize=9)
    for panel in panels[len(shots) :]:
        panel.set_axis_off()
    _legend(figure)
    return figure


def _title(shot: Shot) -> str:
    if shot.ending == "top border":
        return f"hit at {shot.puck[-1, 0]:.2f}"
    return "not touched" if shot.touches == 0 else f"ended by {shot.ending}"


def _draw_table(axes: Axes, obstacle: Block | None) -> None:
    from matplotlib.patches import Rectangle

    # The puck's centre stays within the square; the borders are its radius further out.
    edge, size = -1 - PUCK_RADIUS, 2 + 2 * PUCK_RADIUS
    axes.add_patch(Rectangle((edge, edge), size, size, facecolor="#F4F6F8", edgecolor="#7F7F7F"))
    axes.plot([-1, 1], [-edge, -edge], color="black", linewidth=3, solid_capstyle="butt")
    if obstacle is not None:
        corner, width = (obstacle.left, obstacle.bottom), obstacle.right - obstacle.left
        height = obstacle.top - obstacle.bottom
        axes.add_patch(Rectangle(corner, width, height, facecolor="#7F7F7F", linewidth=0))
    axes.set_xlim(edge - _MARGIN, -edge + _MARGIN)
    axes.set_ylim(edge - _MARGIN, -edge + _MARGIN)
    axes.set_aspect("equal")
    axes.set_xticks([-1, 0, 1])
    axes.set_yticks([-1, 0, 1])
    axes.tick_params(labelsize=7, length=2)
    axes.spines[:].set_visible(False)


def _draw_shot(axes: Axes, shot: Shot) -> None:
    axes.plot(*shot.mallet.T, color=_MALLET, linewidth=1)
    axes.plot(*shot.mallet[:: round(_DOT_EVERY / MALLET_STEP)].T, ".", color=_MALLET, markersize=3)
    axes.plot(*shot.mallet[0], "o", color=_MALLET, markersize=3.5)
    axes.plot(*shot.puck.T, color=_PUCK, linewidth=1.2)
    axes.plot(*shot.puck[0], "o", color=_PUCK, markersize=3.5)
    _circle(axes, shot.puck[-1], PUCK_RADIUS, _PUCK)
    for time, puck in zip(shot.times[1:-1], shot.puck[1:-1], strict=True):
        mallet = _at(shot.mallet, float(time))
        if np.hypot(*(puck - mallet)) <= MALLET_RADIUS + PUCK_RADIUS + 1e-6:
            _circle(axes, mallet, MALLET_RADIUS, _MALLET)
            _circle(axes, puck, PUCK_RADIUS, _PUCK)


def _at(mallet: FloatArray, time: float) -> FloatArray:
    """Where the mallet is at a time, straight between samples."""
    steps = np.arange(len(mallet))
    return np.array([np.interp(time / MALLET_STEP, steps, path) for path in mallet.T])


def _circle(axes: Axes, centre: FloatArray, radius: float, colour: str) -> None:
    from matplotlib.patches import Circle

    middle = (float(centre[0]), float(centre[1]))
    axes.add_patch(Circle(middle, radius, facecolor=colour, edgecolor=colour, alpha=0.35, zorder=3))


def _legend(figure: Figure) -> None:
    from matplotlib.lines import Line2D

    marks = {
        "puck": Line2D([], [], color=_PUCK),
        f"mallet, every {_DOT_EVERY:g} s": Line2D([], [], color=_MALLET, marker=".", markersize=4),
        "start": Line2D([], [], color="#4D4D4D", marker="o", markersize=3.5, linestyle=""),
        "obstacle": Line2D([], [], color="#7F7F7F", linewidth=6),
    }
    figure.legend(
        list(marks.values()),
        list(marks),
        loc="outside lower center",
        ncols=len(marks),
        fontsize=8,
        frameon=False,
    )
