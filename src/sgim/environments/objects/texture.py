"""A surface texture: noise in space, sampled where a surface is, so that it turns with the toy."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.streams import Streams

_SIDE = 32
_CELLS = (0.0035, 0.009)


@cache
def _lattice() -> NDArray[np.float32]:
    """Numbers from −1 to 1 at the points of a lattice that repeats itself, shape ``(side³,)``."""
    return Streams(0)("texture").uniform(-1, 1, _SIDE**3).astype(np.float32)


def texture(places: Any, shifts: Any) -> NDArray[np.float32]:
    """How much lighter or darker than its colour a surface is.

    Two lattices of noise, one finer than the other, interpolated linearly.

    Args:
        places: In m, in the frame of what has the texture, shape ``(3, n)``.
        shifts: Added to the places, in m, so that surfaces of other shifts look different; shape
            ``(3, n)`` or ``(3, 1)``.

    Returns:
        Numbers in [−1, 1], shape ``(n,)``.
    """
    lattice, total = _lattice(), np.zeros(places.shape[1], np.float32)
    moved = (places + shifts).astype(np.float32)
    for cell in _CELLS:
        scaled = moved * np.float32(1 / cell)
        floor = np.floor(scaled)
        x, y, z = scaled - floor
        low = floor.astype(np.int32) & (_SIDE - 1)
        high = (low + 1) & (_SIDE - 1)
        low[0] *= _SIDE * _SIDE
        high[0] *= _SIDE * _SIDE
        low[1] *= _SIDE
        high[1] *= _SIDE
        for i, wx in ((low[0], 1 - x), (high[0], x)):
            for j, wy in ((low[1], 1 - y), (high[1], y)):
                ij = i + j
                near, far = lattice[ij + low[2]], lattice[ij + high[2]]
                total += wx * wy * (near + z * (far - near))
    total *= np.float32(1 / len(_CELLS))
    return total
