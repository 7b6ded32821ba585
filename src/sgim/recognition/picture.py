"""A picture with depth, and what a picture must be to be looked at."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.errors import SgimError

SMALLEST = 32
"""Least width and height of a picture in pixels."""


class PictureError(SgimError, ValueError):
    """Something is no picture that can be looked at."""


class Picture:
    """Colours and distances as a camera over a table gives them.

    Args:
        colours: Red, green and blue from 0 to 255, shape ``(height, width, 3)``, uint8.
        depth: Distance along the optical axis in m, shape ``(height, width)``; 0 where the camera
            could not tell.

    Attributes:
        colours: Read-only.
        depth: Read-only, float32.

    Raises:
        PictureError: If shapes or types are wrong, the picture is smaller than 32 × 32, or a
            depth is negative, infinite or not a number.
    """

    __slots__ = ("colours", "depth")

    def __init__(self, colours: Any, depth: Any) -> None:
        colours, depth = np.asarray(colours), np.asarray(depth)
        if colours.ndim != 3 or colours.shape[2:] != (3,):
            raise PictureError(
                f"colours have shape {colours.shape}, expected (height, width, 3): red, green, blue"
            )
        if colours.dtype != np.uint8:
            raise PictureError(
                f"colours are {colours.dtype}, expected uint8 from 0 to 255; colours from 0 to 1 "
                "become that with (255 * colours).astype(np.uint8)"
            )
        if depth.shape != colours.shape[:2]:
            raise PictureError(
                f"depth has shape {depth.shape}, expected that of the colours, {colours.shape[:2]}"
            )
        if min(depth.shape) < SMALLEST:
            raise PictureError(
                f"picture has {depth.shape[0]} × {depth.shape[1]} pixels, expected {SMALLEST} × "
                f"{SMALLEST} or more"
            )
        if not np.issubdtype(depth.dtype, np.floating):
            raise PictureError(
                f"depth is {depth.dtype}, expected floating-point numbers in m; cameras that give "
                "mm as integers: depth / 1000"
            )
        wrong = ~(np.isfinite(depth) & (depth >= 0))
        if wrong.any():
            row, column = np.argwhere(wrong)[0]
            raise PictureError(
                f"depth is {depth[row, column]} at row {row}, column {column}, expected m, and 0 "
                f"where unknown, of which there are {int(wrong.sum())}: use np.nan_to_num(depth, "
                "posinf=0)"
            )
        self.colours: NDArray[np.uint8] = colours.copy()
        self.depth: NDArray[np.float32] = depth.astype(np.float32)
        self.colours.flags.writeable = self.depth.flags.writeable = False

    def digest(self) -> bytes:
        """A BLAKE2 digest of colours and depth, 16 bytes, by which pictures can be told apart."""
        digest = hashlib.blake2b(self.colours.tobytes(), digest_size=16)
        digest.update(self.depth.astype("<f4").tobytes())
        return digest.digest()
