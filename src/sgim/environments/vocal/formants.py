"""Formants of a tube: resonances of a lossless ladder whose walls yield and whose mouth radiates.

Each section of the tube is a capacitance (its air), in parallel with the inductance of its wall's
mass, and inductances of half its air's mass to either side; the glottis is closed, and beyond the
lips is the inductance of the radiated wave. Squared resonances are the eigenvalues of a symmetric
tridiagonal matrix. The number of them below a value is the number of negative pivots there
(Sturm's sequence), so that bisection finds each by its rank: none is missed, and none changes
places with another.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sgim.environments.vocal.geometry import Tube
from sgim.spaces import FloatArray

SingleArray = NDArray[np.float32]

SPEED_OF_SOUND = 35000.0  # cm/s
AIR_DENSITY = 1.14e-3  # g/cm³
WALL_MASS = 1.5  # g/cm²

RANGES = ((80.0, 1200.0), (250.0, 3600.0))
"""Where the first and second formant are searched, in Hz."""

_STEPS = 11
_WAVE = (
    8 * AIR_DENSITY / (3 * math.pi * math.sqrt(math.pi))
)  # of a piston in a wall (Flanagan 1972)


def ladder(tube: Tube, wall_mass: float = WALL_MASS) -> tuple[FloatArray, FloatArray]:
    """The tridiagonal matrix whose eigenvalues are the squared angular resonances, in s⁻².

    Args:
        tube: The tube, of m sections.
        wall_mass: Of the wall, in g/cm²; infinite for hard walls.

    Returns:
        Its diagonal, shape ``(m, n)``, and the squares of what is beside it, ``(m - 1, n)``.
    """
    areas, lengths = tube.areas, tube.lengths
    half = (AIR_DENSITY / 2) * lengths / areas
    mass = half.copy()
    mass[:-1] += half[1:]
    mass[-1] += _WAVE / np.sqrt(areas[-1])
    stiffness = (AIR_DENSITY * SPEED_OF_SOUND**2) / (areas * lengths)
    coupling = 1.0 / mass
    total = coupling + (2.0 * math.sqrt(math.pi) / wall_mass) * np.sqrt(areas) * lengths
    total[1:] += coupling[:-1]
    beside = coupling[:-1] ** 2 * (stiffness[:-1] * stiffness[1:])
    return total * stiffness, beside


def formants(
    tube: Tube, ranges: Sequence[tuple[float, float]] = RANGES, steps: int = _STEPS
) -> FloatArray:
    """The first formants, by bisection in single precision.

    Args:
        tube: The tube.
        ranges: Where each is searched, in Hz, the first formant first; one that lies outside is
            given as the nearer end.
        steps: How often the range is halved.

    Returns:
        In Hz, shape ``(formants, n)``; each is the middle of the last interval.
    """
    diagonal, beside = (part.astype(np.float32, copy=False) for part in ladder(tube))
    rank = np.arange(1, len(ranges) + 1, dtype=np.int8)[:, None]
    low, high = (np.array(ends, dtype=np.float32)[:, None] for ends in zip(*ranges, strict=True))
    step = (high - low) / 4
    found: SingleArray = np.repeat((low + high) / 2, diagonal.shape[1], axis=1)
    for _ in range(steps):
        enough = _below(diagonal, beside, found) >= rank
        found -= np.where(enough, step, -step)
        step = step / 2
    return found.astype(np.float64)


def _below(
    diagonal: SingleArray, beside: SingleArray, frequencies: SingleArray
) -> NDArray[np.int8]:
    """How many resonances lie below each frequency, shape as ``frequencies``."""
    value = np.square(frequencies * np.float32(2 * np.pi))
    pivot = diagonal[0] - value
    quotient, negative = np.empty_like(pivot), np.empty(pivot.shape, dtype=np.bool_)
    count: NDArray[np.int8] = (pivot < 0.0).astype(np.int8)
    with np.errstate(divide="ignore", over="ignore"):
        for entry, square in zip(diagonal[1:], beside, strict=True):
            np.divide(square, pivot, out=quotient)
            np.subtract(entry, value, out=pivot)
            np.subtract(pivot, quotient, out=pivot)
            np.less(pivot, 0.0, out=negative)
            np.add(count, negative.view(np.int8), out=count)
    return count
