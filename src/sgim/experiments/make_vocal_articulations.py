"""Finds how the vocal tract says vowels and closes, and writes the table of articulations.

Run it as ``python -m sgim.experiments.make_vocal_articulations``; it takes some seconds.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.tables import write_table
from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS, Anatomy
from sgim.environments.vocal.articulations import (
    ARTICULATIONS_TABLE,
    CLOSURES,
    NAMES,
    formants_of,
)
from sgim.environments.vocal.formants import formants
from sgim.environments.vocal.geometry import contours, tube
from sgim.spaces import FloatArray
from sgim.streams import Streams

Cost = Callable[[FloatArray], FloatArray]

_CANDIDATES, _BEST, _ROUNDS = 1000, 50, 80
BOUND = 3.0
"""Commands lie between this and its opposite."""

_EFFORT = 0.001  # weight of the mean square command: an articulation nearer to neutral is better
_LEAST_OPENING = 0.04  # cm, of a vowel
_PRESSED, _APART = -0.15, 0.15  # cm, of a closure at its place, and elsewhere


def main(folder: Path) -> None:
    """Write the table to ``folder``."""
    streams = Streams(0)
    rows = []
    for index, name in enumerate(NAMES):
        cost = (
            closure_cost(ADULT, name) if name in CLOSURES else vowel_cost(ADULT, formants_of(name))
        )
        found, least = search(cost, streams("make_vocal_articulations", index))
        rows.append(found)
        print(f"{name}: {np.round(found, 2)}, cost {least:.4f}")
    named = ", ".join(NAMES)
    comment = (
        "Made by: python -m sgim.experiments.make_vocal_articulations\n"
        "positions of the articulators, found by the cross-entropy method, for: " + named
    )
    columns = [name.replace(" ", "_") for name in ARTICULATORS]
    write_table(folder / ARTICULATIONS_TABLE, comment, columns, rows, decimals=3)


def vowel_cost(anatomy: Anatomy, wanted: FloatArray) -> Cost:
    """Of positions, shape ``(7, n)``: how far from the formants, how narrow, how far from neutral.

    Args:
        anatomy: Whose tract.
        wanted: F1 and F2 in Hz.
    """

    def cost(positions: FloatArray) -> FloatArray:
        shape = contours(anatomy, positions)
        found = formants(tube(anatomy, positions, shape))
        off = np.abs(found / wanted[:, None] - 1).max(axis=0)
        narrow = np.maximum(_LEAST_OPENING - shape.opening, 0.0)
        costs: FloatArray = off + 10 * narrow + _EFFORT * (positions**2).mean(axis=0)
        return costs

    return cost


def closure_cost(anatomy: Anatomy, name: str) -> Cost:
    """Of positions: how far from closed at a place and open at the others.

    Args:
        anatomy: Whose tract.
        name: Where, one of `CLOSURES`.
    """
    lines = CLOSURES[name]

    def cost(positions: FloatArray) -> FloatArray:
        shape = contours(anatomy, positions)
        gaps = np.concatenate([shape.gaps, shape.lips[None]])
        here = np.zeros(len(gaps), dtype=bool)
        here[slice(*lines) if lines else slice(-1, None)] = True
        open_here = np.maximum(gaps[here].min(axis=0) - _PRESSED, 0.0)
        closed_there = np.maximum(_APART - gaps[~here].min(axis=0), 0.0)
        effort = _EFFORT * (positions**2).mean(axis=0)
        costs: FloatArray = open_here + closed_there + effort
        return costs

    return cost


def search(cost: Cost, rng: np.random.Generator) -> tuple[FloatArray, float]:
    """The positions of least cost, by the cross-entropy method (Rubinstein 1999).

    Args:
        cost: Of positions, shape ``(7, n)``, to costs, shape ``(n,)``.
        rng: For the candidates.

    Returns:
        Positions, shape ``(7,)``, and their cost.
    """
    middle, spread = np.zeros(len(ARTICULATORS)), np.full(len(ARTICULATORS), 1.5)
    best, least = middle, np.inf
    for _ in range(_ROUNDS):
        drawn = rng.standard_normal((len(ARTICULATORS), _CANDIDATES))
        candidates = np.clip(middle[:, None] + spread[:, None] * drawn, -BOUND, BOUND)
        costs = cost(candidates)
        order = np.argsort(costs)[:_BEST]
        middle, spread = candidates[:, order].mean(axis=1), candidates[:, order].std(axis=1)
        if costs[order[0]] < least:
            best, least = candidates[:, order[0]], float(costs[order[0]])
    return best, least


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(environments.__file__).parent / "data")
