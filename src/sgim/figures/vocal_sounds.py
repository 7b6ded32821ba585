"""Early and mature sounds of a vocal learner, with those of its ambient language (figure 5.3.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sgim.environments.vocal.languages import ambient_language
from sgim.environments.vocal.perception import SOUND, Sounds
from sgim.experiments.vocal_history import VocalRun
from sgim.figures.style import OKABE_ITO, new_figure, tidy
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PART = 0.1
"""Early is the first tenth of a run, mature the last."""

MOST_POINTS = 4000

_PLANES = ((0, 1), (2, 3), (4, 5))
_LIMITS = ((-0.08, 1.08), (-1.0, 1.0), (-1.0, 1.0))


def vocal_sounds(run: VocalRun) -> Figure:
    """Draw the sounds of the first and of the last tenth of a run (figures 5.3.4 and 5.3.7).

    The panels are the intensities of both windows, their first and their second formants; of many
    sounds, every so manieth is drawn. Circles are the sounds of the ambient language.

    Args:
        run: The run.
    """
    sounds, part = run.history.sounds, max(1, round(PART * len(run.history)))
    ambient = None if run.language is None else ambient_language(run.language).sounds
    figure = new_figure(7.2, 5.0)
    panels = figure.subplots(2, 3)
    for row, name, chosen in ((0, "early", sounds[:part]), (1, "mature", sounds[-part:])):
        for axes, plane, limits in zip(panels[row], _PLANES, _LIMITS, strict=True):
            _draw_plane(axes, chosen, plane, ambient)
            axes.set_xlim(*limits)
            axes.set_ylim(*limits)
            axes.set_aspect("equal")
            tidy(axes)
        panels[row, 0].set_title(f"{name}: {len(chosen)} sounds")
    language = f" amid language {run.language}" if run.language else ""
    seed = "" if run.seed is None else f", seed {run.seed}"
    figure.suptitle(f"{run.learner or run.path.stem}{language}{seed}", fontsize=11)
    return figure


def _draw_plane(
    axes: Axes, sounds: Sounds, plane: tuple[int, int], ambient: FloatArray | None
) -> None:
    every = -(-len(sounds) // MOST_POINTS)
    x, y = (sounds[::every, i] for i in plane)
    axes.scatter(x, y, s=3, color=OKABE_ITO[0], alpha=0.4, linewidths=0, rasterized=True)
    if ambient is not None:
        at = [ambient[:, i] for i in plane]
        axes.plot(*at, "o", markersize=9, markerfacecolor="none", color=OKABE_ITO[1], mew=1.6)
    axes.set_xlabel(SOUND[plane[0]])
    axes.set_ylabel(SOUND[plane[1]])
    axes.set_xticks(np.array([0, 1]) if plane == (0, 1) else np.array([-1, 0, 1]))
    axes.set_yticks(axes.get_xticks())
