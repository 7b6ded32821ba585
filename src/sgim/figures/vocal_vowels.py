"""What a vocal tract can say: its formants, and the vowels of a language among them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS, Anatomy
from sgim.environments.vocal.articulations import VOWELS
from sgim.environments.vocal.formants import formants
from sgim.environments.vocal.geometry import Tube, contours, tube
from sgim.figures.style import OKABE_ITO, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DRAWS = 12_000


def vocal_vowels(rng: np.random.Generator, anatomy: Anatomy = ADULT) -> Figure:
    """Draw the first two formants of uniform positions that are open, and English vowels.

    As usual in phonetics, both axes point backwards, so that the tongue's place can be read off:
    /i/ is at the upper left.

    Args:
        rng: For the positions.
        anatomy: Whose tract.
    """
    positions = rng.uniform(-3, 3, (len(ARTICULATORS), _DRAWS))
    shape = contours(anatomy, positions)
    every = tube(anatomy, positions, shape)
    opened = shape.opening > 0
    first, second = formants(Tube(every.areas[:, opened], every.lengths[:, opened]))
    figure = new_figure(5.2, 4.2)
    axes = figure.add_subplot()
    axes.scatter(second, first, s=3, color="#BFBFBF", linewidths=0, rasterized=True)
    for name, (f1, f2) in VOWELS.items():
        axes.plot(f2, f1, "o", color=OKABE_ITO[1], markersize=4)
        axes.annotate(name, (f2, f1), xytext=(4, 3), textcoords="offset points", fontsize=8)
    axes.set_xlim(2500, 500)
    axes.set_ylim(850, 150)
    axes.set_xlabel("F2 (Hz)")
    axes.set_ylabel("F1 (Hz)")
    axes.set_title(f"{opened.mean():.0%} of uniform positions are open; vowels of men")
    tidy(axes)
    return figure
