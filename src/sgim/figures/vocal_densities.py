"""How goals, commands and sounds of a vocal learner are distributed over time (figure 5.3.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sgim.environments.vocal.motor import MOTORS
from sgim.environments.vocal.perception import Sounds
from sgim.experiments.vocal_history import VocalRun, read_policies
from sgim.experiments.vocal_stages import stages_of
from sgim.figures.style import new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_BINS = 100
_FILTER = 1.0  # bins, standard deviation
_HEARD = (("F2", 4, (-1.0, 1.0)), ("F1", 2, (-1.0, 1.0)), ("I", 0, (0.0, 1.0)))
_COMMANDED = (-3.0, 3.0)


def vocal_densities(run: VocalRun) -> Figure:
    """Draw densities over time: of goals, of commands, and of what was heard.

    The two columns are the first and second command, and the first and second window. The darker,
    the denser; each moment's densities are scaled alike. Lines are the stages' boundaries.

    Args:
        run: The run.

    Raises:
        JournalError: If its journal cannot be read.
    """
    policies = read_policies(run.path)
    history = run.history
    groups: list[tuple[str, list[tuple[str, tuple[float, float], Sounds]]]] = [
        ("goals", [(n, span, history.goals[:, [i, i + 1]]) for n, i, span in _HEARD]),
        (
            "commands",
            [(m, _COMMANDED, policies[:, [i, i + len(MOTORS)]]) for i, m in enumerate(MOTORS)],
        ),
        ("heard", [(n, span, history.sounds[:, [i, i + 1]]) for n, i, span in _HEARD]),
    ]
    rows = sum(len(members) for _, members in groups)
    boundaries = [stage.start for stage in stages_of(history)[1:]]
    figure = new_figure(8.0, 0.6 + 0.62 * rows)
    figure.set_layout_engine("none")  # so many panels take long to lay out
    panels = figure.subplots(
        rows,
        2,
        sharex=True,
        gridspec_kw={"left": 0.16, "right": 0.95, "top": 0.94, "bottom": 0.045, "hspace": 0.35},
    )
    row = 0
    for group, members in groups:
        for name, span, values in members:
            for column in (0, 1):
                axes = panels[row, column]
                _draw_density(axes, values[:, column], span)
                for boundary in boundaries:
                    axes.axvline(boundary, color="#D55E00", linewidth=0.8)
            panels[row, 0].set_ylabel(name, rotation=0, ha="right", va="center", fontsize=8)
            row += 1
        panels[row - len(members), 1].set_ylabel(group, fontsize=9, fontweight="bold")
        panels[row - len(members), 1].yaxis.set_label_position("right")
    for axes, title in zip(panels[0], ("first", "second"), strict=True):
        axes.set_title(title, fontsize=10)
    seed = "" if run.seed is None else f", seed {run.seed}"
    figure.suptitle(f"{run.learner or run.path.stem}{seed}", fontsize=11)
    for axes in panels[-1]:
        axes.set_xlabel("vocalisations", fontsize=9)
    return figure


def _draw_density(axes: Axes, values: Sounds, span: tuple[float, float]) -> None:
    from scipy.ndimage import gaussian_filter

    times = np.arange(len(values))
    known = ~np.isnan(values)
    ranges = ((0, len(values)), span)
    counts, _, _ = np.histogram2d(
        times[known], np.clip(values[known], *span), bins=_BINS, range=ranges
    )
    smooth = gaussian_filter(counts, _FILTER)
    # The square root shows what is rare beside silence, which is always the same point.
    axes.imshow(
        np.sqrt(smooth.T),
        origin="lower",
        aspect="auto",
        extent=(0, len(values), *span),
        cmap="Greys",
        interpolation="nearest",
    )
    axes.set_yticks(span)
    axes.tick_params(labelsize=6, length=2)
