"""A vocal tract from the side, and what each of its articulators does to it (figure 5.2.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS, Anatomy
from sgim.environments.vocal.geometry import LINES, MOUTH, Contours, contours
from sgim.figures.style import OKABE_ITO, new_figure
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TONGUE, WALLS = OKABE_ITO[1], "#4D4D4D"

_MOVED = 2.0
_UPPER_LIP = 0.12  # cm by which the upper lip hangs below the upper teeth
_LIP = 0.45  # thickness of the lips in cm
_NOSE = ((0.1, 1.0), (0.75, 1.1), (1.2, 1.35), (1.05, 1.9), (0.55, 3.2), (0.25, 4.3))
_LIMITS = ((-4.0, 6.9), (-9.0, 6.4))


def draw_tract(
    axes: Axes,
    positions: FloatArray,
    anatomy: Anatomy = ADULT,
    *,
    colour: str = TONGUE,
    walls: bool = True,
    width: float = 1.6,
) -> None:
    """Draw the contour of a tract from the side, with the lips on the right.

    Args:
        axes: The panel.
        positions: Of the seven articulators, shape ``(7,)``.
        anatomy: Whose tract.
        colour: Of what moves: tongue and lips.
        walls: Whether to draw what does not move.
        width: Of the lines, in points.
    """
    shape = contours(anatomy, positions[:, None])
    protrusion = float(positions[ARTICULATORS.index("lip protrusion")])
    length = max(anatomy.lip_length + anatomy.lip_length_by_protrusion * protrusion, 0.1)
    tongue, wall = (
        shape.points(part)[:, :, 0].astype(np.float64) for part in (shape.tongue, shape.wall)
    )
    if walls:
        _draw_walls(axes, wall, anatomy)
    opening = float(shape.lips[0])
    top = anatomy.teeth_height - _UPPER_LIP
    start, end = anatomy.teeth_place + 0.15, anatomy.teeth_place + 0.15 + length
    axes.plot(*_behind_teeth(tongue, shape), color=colour, linewidth=width, zorder=3)
    for height, side in ((top, 1), (top - opening, -1)):
        axes.plot(*_lip(start, end, height, side), color=colour, linewidth=width, zorder=3)
    below = np.array([0.0, anatomy.larynx_length])
    tube = np.array([tongue[:, 0], tongue[:, 0] - below, wall[:, 0] - below])
    axes.plot(*tube.T, color=colour, linewidth=width, zorder=3)
    axes.set_xlim(*_LIMITS[0])
    axes.set_ylim(*_LIMITS[1])
    axes.set_aspect("equal")
    axes.set_axis_off()


def vocal_articulators(anatomy: Anatomy = ADULT, moved: float = _MOVED) -> Figure:
    """Draw what each articulator moves: bold at a positive command, thin at 0 and a negative one.

    Args:
        anatomy: Whose tract.
        moved: The commands, this and its opposite.
    """
    figure = new_figure(8.4, 5.4)
    panels = figure.subplots(2, 4).ravel().tolist()
    for i, (axes, name) in enumerate(zip(panels, ARTICULATORS, strict=False)):
        for command, colour, width in (
            (-moved, OKABE_ITO[0], 0.8),
            (0.0, "#7F7F7F", 0.8),
            (moved, TONGUE, 1.8),
        ):
            positions = np.zeros(len(ARTICULATORS))
            positions[i] = command
            draw_tract(axes, positions, anatomy, colour=colour, walls=not command, width=width)
        axes.set_title(name, fontsize=10)
    _draw_legend(panels[-1], moved)
    return figure


def _behind_teeth(tongue: FloatArray, shape: Contours) -> FloatArray:
    """The tongue without points that the next line has passed, where lines cross below it."""
    kept = np.ones(LINES, dtype=bool)
    kept[: LINES - MOUTH] = shape.tongue[: LINES - MOUTH, 0] > 0
    return tongue[:, kept]


def _draw_walls(axes: Axes, wall: FloatArray, anatomy: Anatomy) -> None:
    low = np.array([[wall[0, 0]], [_LIMITS[1][0]]])
    axes.plot(*np.concatenate([low, wall], axis=1), color=WALLS, linewidth=1.6)
    teeth, height = anatomy.teeth_place, anatomy.teeth_height
    tooth = [(teeth, height), (teeth + 0.05, height - 0.2), (teeth + 0.15, height)]
    axes.plot(*np.array(tooth).T, color=WALLS, linewidth=1.2)
    nose = np.array(_NOSE) + np.array([teeth + 0.6, height - 0.2])
    axes.plot(*nose.T, color="#BFBFBF", linewidth=1.2)


def _lip(start: float, end: float, height: float, side: int) -> FloatArray:
    """The outline of a lip whose inner side is at a height."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, 20)
    round_end = np.array([end + _LIP * np.cos(angles), height + side * _LIP * (1 + np.sin(angles))])
    inner = np.array([[start, end], [height, height]])
    outer = np.array([[end - 0.2], [height + side * 2.3 * _LIP]])
    return np.concatenate([inner, round_end, outer], axis=1)


def _draw_legend(axes: Axes, moved: float) -> None:
    from matplotlib.lines import Line2D

    axes.set_axis_off()
    marks = {
        f"command {moved:g}": Line2D([], [], color=TONGUE, linewidth=1.8),
        "neutral": Line2D([], [], color="#7F7F7F", linewidth=0.8),
        f"command −{moved:g}": Line2D([], [], color=OKABE_ITO[0], linewidth=0.8),
        "does not move": Line2D([], [], color=WALLS, linewidth=1.6),
    }
    axes.legend(list(marks.values()), list(marks), loc="center", frameon=False, fontsize=9)
