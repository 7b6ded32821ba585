"""One movement of the fishing rod, drawn from where its bodies were; no OpenGL is needed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.fishing import FishingRod
from sgim.figures.style import OKABE_ITO, new_figure, tidy
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_GHOSTS = 7
_WATER = "#DCEBF5"
_VIEWS = {"from the side": (1, 2), "from above": (0, 1)}
_NAMES = ("x (m)", "y (m)", "height (m)")


def fishing_movement(policy: Any, world: FishingRod | None = None) -> Figure:
    """Draw a movement from the side and from above: the rig at some instants, the float's path.

    Args:
        policy: Shape ``(25,)``.
        world: Whose model moves, without noise; the full one if None.

    Raises:
        SpaceError: If the policy is malformed.
        SgimError: If the simulation becomes unstable.
    """
    world = FishingRod(0.0, fast=False) if world is None else world
    names, path = world.positions(policy)
    wet = np.flatnonzero(path[1:, -1, 2] <= 0)
    last = int(wet[0]) + 1 if len(wet) else len(path) - 1
    instants = np.unique(np.linspace(0, last, _GHOSTS).astype(int))
    hand = names.index("rod0")
    tip = names.index("line0")
    figure = new_figure(8.4, 4.1)
    panels = figure.subplots(1, 2)
    for panel, (title, (across, up)) in zip(panels, _VIEWS.items(), strict=True):
        for number, instant in enumerate(instants):
            shade = 0.15 + 0.85 * (number / max(1, len(instants) - 1)) ** 1.5
            _rig(panel, path[instant][:, [across, up]], hand, tip, shade)
        flown = path[: last + 1, -1][:, [across, up]]
        panel.plot(*flown.T, ":", color=OKABE_ITO[1], linewidth=1.2, label="way of the float")
        panel.plot(*flown[0], "o", color="white", markeredgecolor=OKABE_ITO[1], markersize=5)
        panel.plot(*flown[-1], "o", color=OKABE_ITO[1], markersize=6, label="float")
        panel.set_title(title)
        panel.set_xlabel(_NAMES[across])
        panel.set_ylabel(_NAMES[up])
        panel.set_aspect("equal")
        tidy(panel)
    panels[0].set_ylim(bottom=-0.1)
    panels[0].axhspan(-0.1, 0.0, color=_WATER, zorder=-2)
    panels[1].set_facecolor(_WATER)
    where = path[last, -1]
    said = "has not landed" if not len(wet) else f"lands at ({where[0]:.2f}, {where[1]:.2f}) m"
    figure.suptitle(f"The float {said} after {last * world.step:.2f} s", fontsize=11)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8, frameon=False)
    return figure


def _rig(axes: Axes, points: FloatArray, hand: int, tip: int, shade: float) -> None:
    """Arm, rod and line at one instant, the later the darker."""
    now = shade == 1.0
    parts = {
        "arm": (points[: hand + 1], "#333333", 4.0),
        "rod": (points[hand : tip + 1], OKABE_ITO[0], 2.2),
        "line": (points[tip:], OKABE_ITO[2], 1.0),
    }
    for name, (joints, colour, width) in parts.items():
        axes.plot(
            *joints.T,
            "-",
            color=colour,
            linewidth=width,
            alpha=shade,
            label=name if now else None,
            solid_capstyle="round",
            solid_joinstyle="round",
        )
