"""What the figures have in common: their colours, which colour-blind readers tell apart too."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from sgim.errors import SgimError
from sgim.runs.summary import RecordedRun, read_run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

OKABE_ITO = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#A08A00")
"""Okabe and Ito's palette; its yellow is darkened, to be seen on white."""

MARKERS = "osD^vPX*"

_FAMILIES = {
    "mimic": ("#8C2D04", "#FDD0A2"),
    "emulate": ("#084594", "#C6DBEF"),
    "imitate": ("#54278F", "#DADAEB"),
    "observe": ("#00441B", "#C7E9C0"),
}
_ALONE = ("#4D4D4D", "#A6A6A6", "#D9D9D9")


class NothingToDrawError(SgimError):
    """The runs have nothing of what this figure is about, and nothing is amiss with them."""


def read_runs(journals: Iterable[str | Path | RecordedRun]) -> list[RecordedRun]:
    """The runs of these journals; those that were read already stay as they are.

    Raises:
        SgimError: If there is none, or they are of different experiments.
        JournalError: If one cannot be read.
    """
    runs = [one if isinstance(one, RecordedRun) else read_run(one) for one in journals]
    experiments = {run.experiment for run in runs}
    if len(experiments) != 1:
        names = ", ".join(sorted(str(name) for name in experiments)) or "no journal"
        raise SgimError(f"a figure shows runs of one experiment, but here are {names}")
    return runs


def mode_colours(modes: Iterable[str]) -> dict[str, str]:
    """Greys for modes without a teacher, shades of one colour for each way to learn from one.

    Other modes have the remaining colours of the palette.
    """
    from matplotlib.colors import LinearSegmentedColormap, to_hex

    families: dict[str, list[str]] = {}
    for mode in sorted(modes):
        first, space, _ = mode.partition(" ")
        families.setdefault(first if space and first in _FAMILIES else "", []).append(mode)
    colours = {}
    for family, members in families.items():
        if family:
            shades = LinearSegmentedColormap.from_list(family, _FAMILIES[family])
            for i, mode in enumerate(members):
                colours[mode] = to_hex(shades(i / max(1, len(members) - 1)))
        else:
            rest = (*_ALONE, *OKABE_ITO[2:5])
            colours.update({mode: rest[i % len(rest)] for i, mode in enumerate(members)})
    return colours


def kind_colours(kinds: Iterable[str]) -> dict[str, str]:
    """A colour for each kind of goal."""
    return {kind: OKABE_ITO[2:][i % 6] for i, kind in enumerate(sorted(kinds))}


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of this size in inches."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained", dpi=150)


def tidy(axes: Axes) -> None:
    """Take away what is not needed to read a panel."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)
    axes.xaxis.label.set_fontsize(9)
    axes.yaxis.label.set_fontsize(9)
    axes.title.set_fontsize(10)
