"""One vocalisation: how the motors move, the tract's shapes, the sound, and what is heard of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.vocal.motor import DURATION, MOTORS, SECOND_COMMAND
from sgim.environments.vocal.perception import FRAMES, WINDOWS, in_hertz
from sgim.environments.vocal.sound import RATE, waveform
from sgim.environments.vocal.world import Vocalisation, VocalTract
from sgim.figures.style import OKABE_ITO, new_figure, tidy
from sgim.figures.vocal_tract import draw_tract
from sgim.spaces import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_MOVED = 0.3
"""Motors whose commands are all smaller are drawn in grey, without a name."""


def vocalisation(policy: Any, world: VocalTract | None = None) -> Figure:
    """Draw one vocalisation (figures 5.2.3 and 5.3.3 of the thesis).

    A: positions of the motors; circles are the two commands. B: the tract at the end of each
    command. C: the sound. D: intensity and formants; shaded is when one listens, circles are what
    is heard.

    Args:
        policy: Shape ``(18,)``.
        world: The tract; by default that of the experiment.

    Raises:
        SpaceError: If the policy has another shape.
    """
    tract = VocalTract(noise=0.0) if world is None else world
    spoken = tract.vocalise(policy)
    sound = tract.sounds(np.asarray(policy, dtype=np.float64)[None])[0]
    figure = new_figure(8.4, 6.2)
    grid = figure.add_gridspec(3, 4, height_ratios=[1.5, 0.7, 1.1])
    _draw_motors(figure.add_subplot(grid[0, :2]), spoken, np.reshape(policy, (2, -1)))
    for column, time in ((2, SECOND_COMMAND), (3, DURATION)):
        axes = figure.add_subplot(grid[0, column])
        at = int(np.abs(spoken.times - time).argmin())
        draw_tract(axes, spoken.positions[: len(MOTORS) - 2, at], tract.anatomy)
        axes.set_title(f"{'B  ' * (column == 2)}{time * 1000:.0f} ms", fontsize=10)
    _draw_sound(figure.add_subplot(grid[1, :]), spoken)
    _draw_heard(figure.add_subplot(grid[2, :]), spoken, sound)
    return figure


def _draw_motors(axes: Axes, spoken: Vocalisation, commands: FloatArray) -> None:
    colours = iter(OKABE_ITO)
    for name, path, (first, second) in zip(MOTORS, spoken.positions, commands.T, strict=True):
        if max(abs(first), abs(second)) < _MOST_MOVED:
            axes.plot(spoken.times, path, color="#BFBFBF", linewidth=0.8)
            continue
        colour = next(colours, "#7F7F7F")
        axes.plot(spoken.times, path, color=colour, label=name, linewidth=1.3)
        axes.plot([SECOND_COMMAND, DURATION], [first, second], "o", color=colour, markersize=4)
    axes.axvline(SECOND_COMMAND, color="#7F7F7F", linestyle=":", linewidth=0.8)
    axes.set_title("A  positions, and commands (circles)")
    axes.set_xlabel("time (s)")
    axes.set_xlim(0, DURATION + 0.01)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=7, frameon=False, ncols=2, loc="best")
    tidy(axes)


def _draw_sound(axes: Axes, spoken: Vocalisation) -> None:
    samples = waveform(spoken)
    axes.plot(np.arange(len(samples)) / RATE, samples, color="#4D4D4D", linewidth=0.4)
    axes.set_xlim(0, DURATION + 0.01)
    axes.set_ylim(-1, 1)
    axes.set_yticks([])
    axes.set_title("C  sound")
    tidy(axes)


def _draw_heard(axes: Axes, spoken: Vocalisation, sound: FloatArray) -> None:
    colours = {"F1": OKABE_ITO[0], "F2": OKABE_ITO[1]}
    for (name, colour), path in zip(colours.items(), spoken.formants, strict=False):
        axes.plot(spoken.times, path, color=colour, label=name, linewidth=1.3)
    level = axes.twinx()
    level.step(spoken.times, spoken.heard, where="mid", color="#4D4D4D", linewidth=1, label="I")
    for i, window in enumerate(WINDOWS):
        axes.axvspan(*window, color="#F0F0F0", zorder=0)
        middle = sum(window) / 2
        level.plot(middle, sound[i], "o", color="#4D4D4D", markersize=4)
        if sound[i] * FRAMES > 0.5:
            for colour, heard in zip(colours.values(), in_hertz(sound)[:, i], strict=True):
                axes.plot(middle, heard, "o", color=colour, markersize=4)
    axes.set_title("D  what is heard, and its mean in each window (circles)")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("formants (Hz)")
    axes.set_xlim(0, DURATION + 0.01)
    axes.set_ylim(0, 3000)
    level.set_ylim(-0.05, 1.5)
    level.set_yticks([0, 1])
    level.set_ylabel("intensity")
    axes.legend(
        *(
            a + b
            for a, b in zip(
                axes.get_legend_handles_labels(), level.get_legend_handles_labels(), strict=True
            )
        ),
        fontsize=7,
        frameon=False,
        ncols=3,
        loc="upper left",
    )
    tidy(axes)
    level.spines["top"].set_visible(False)
    level.tick_params(labelsize=8)
    level.yaxis.label.set_fontsize(9)
