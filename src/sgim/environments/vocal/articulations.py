"""Articulations of an adult: how this tract says vowels, and how it closes."""

from __future__ import annotations

from functools import cache
from types import MappingProxyType

import numpy as np

from sgim.environments.tables import read_table
from sgim.spaces import FloatArray

ARTICULATIONS_TABLE = "vocal_articulations.csv"

CORNERS = MappingProxyType({"a": (700.0, 1200.0), "i": (280.0, 2250.0), "u": (310.0, 870.0)})
"""F1 and F2 in Hz of the vowels between which all others lie."""

VOWELS = MappingProxyType(
    {
        "heed": (270.0, 2290.0),
        "hid": (390.0, 1990.0),
        "head": (530.0, 1840.0),
        "had": (660.0, 1720.0),
        "hod": (730.0, 1090.0),
        "hawed": (570.0, 840.0),
        "hood": (440.0, 1020.0),
        "who'd": (300.0, 870.0),
        "hud": (640.0, 1190.0),
        "heard": (490.0, 1350.0),
    }
)
"""F1 and F2 in Hz of English vowels as 33 men say them (Peterson and Barney 1952, table II)."""

CLOSURES = MappingProxyType({"labial": None, "alveolar": (23, 27), "velar": (10, 17)})
"""Where the tract can be closed: between which lines of the grid; None for the lips."""

NAMES = (*CORNERS, *VOWELS, *CLOSURES)
"""The articulations of the table, row by row."""


@cache
def articulations() -> MappingProxyType[str, FloatArray]:
    """Each articulation's positions of the seven articulators, shape ``(7,)``."""
    table = read_table(ARTICULATIONS_TABLE)
    table.flags.writeable = False
    return MappingProxyType(dict(zip(NAMES, table, strict=True)))


def formants_of(name: str) -> FloatArray:
    """F1 and F2 in Hz that a vowel should have, shape ``(2,)``."""
    return np.array({**CORNERS, **VOWELS}[name])
