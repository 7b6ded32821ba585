"""Superpixels: patches of neighbouring pixels of like colour (SLIC, Achanta et al. 2012)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float32 = NDArray[np.float32]

_ROUNDS = 4
_FEWEST = 6


def superpixels(
    colours: Float32, mask: NDArray[np.bool_], size: float, compactness: float = 20.0
) -> tuple[Float32, Float32]:
    """Group the pixels of a mask into patches compact in colour and place.

    It is k-means over colour and scaled place, begun on a grid, with every pixel compared to every
    centre: an object has few enough patches for that.

    Args:
        colours: Lab colours, shape ``(height, width, 3)``.
        mask: Which pixels to group, shape ``(height, width)``.
        size: Distance of neighbouring patches in pixels.
        compactness: The difference of colour that counts as much as that distance.

    Returns:
        The patches' mean places (column, row) in pixels, shape ``(n, 2)``, and their mean colours,
        shape ``(n, 3)``.
    """
    rows, columns = np.nonzero(mask)
    if len(rows) < _FEWEST:
        return np.empty((0, 2), np.float32), np.empty((0, 3), np.float32)
    scale = compactness / size
    pixels = np.column_stack((columns * scale, rows * scale, colours[rows, columns]))
    pixels = pixels.astype(np.float32)
    cells = (rows // size).astype(np.int64) * 4096 + (columns // size).astype(np.int64)
    _, owner = np.unique(cells, return_inverse=True)
    centres = _means(pixels, owner)
    for _ in range(_ROUNDS):
        nearness = pixels @ centres.T - 0.5 * np.einsum("kd,kd->k", centres, centres)
        owner = np.unique(nearness.argmax(axis=1), return_inverse=True)[1]
        centres = _means(pixels, owner)
    centres = centres[np.bincount(owner) >= _FEWEST]
    return centres[:, :2] / np.float32(scale), centres[:, 2:].copy()


def _means(pixels: Float32, owner: NDArray[np.intp]) -> Float32:
    """The mean of each owner's pixels, owners being numbered from 0 without gaps."""
    counts = np.bincount(owner)
    sums = [np.bincount(owner, weights=column) for column in pixels.T]
    return (np.column_stack(sums) / counts[:, None]).astype(np.float32)
