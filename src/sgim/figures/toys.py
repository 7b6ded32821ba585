"""The toys, and pictures of them, as the camera sees them (figures 2.1.2 and 2.3.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.objects import ToyTable
from sgim.environments.objects.nuisances import STILL
from sgim.environments.objects.pictures import evaluation_pictures
from sgim.figures.style import new_figure
from sgim.streams import Streams

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def contact_sheet() -> Figure:
    """Draw every toy from four sides, as it is presented, in pictures without nuisances.

    Raises:
        SgimError: If MuJoCo is not installed.
    """
    table, streams = ToyTable(STILL), Streams(0)
    sides = (("front", 0.0), ("left", 0.5 * np.pi), ("rear", np.pi), ("right", 1.5 * np.pi))
    figure = new_figure(8.4, 5.2)
    grid = figure.subplots(len(sides), len(table.toys.labels), squeeze=False)
    for row, (side, angle) in zip(grid, sides, strict=True):
        for axes, toy in zip(row, table.toys.labels, strict=True):
            pose = table.presented(toy, angle)
            _show(axes, table.picture(toy, pose, streams("contact sheet")).colours)
            if side == "front":
                axes.set_title(toy, fontsize=10)
            if axes is row[0]:
                axes.set_ylabel(side, fontsize=9)
    return figure


def database(toy: str = "cubes", count: int = 32) -> Figure:
    """Draw the first of the pictures of a toy by which recognition is measured (figure 2.3.1).

    Args:
        toy: Which toy.
        count: How many pictures, in rows of 8.

    Raises:
        SgimError: If MuJoCo is not installed, or there is no such toy.
    """
    table = ToyTable()
    rows = -(-count // 8)
    figure = new_figure(8.4, 0.85 * rows)
    grid: Any = figure.subplots(rows, 8, squeeze=False)
    pictures = evaluation_pictures(table, table.toys.check(toy, "toy"), count)
    for axes, picture in zip(grid.flat, pictures, strict=False):
        _show(axes, picture.colours)
    for axes in grid.flat[count:]:
        axes.set_visible(False)
    return figure


def _show(axes: Axes, colours: Any) -> None:
    axes.imshow(colours, interpolation="nearest")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)
