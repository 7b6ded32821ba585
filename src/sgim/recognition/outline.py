"""What stands on a table, told from it by depth: the proto-object of section 2.2.1."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.recognition.picture import Picture
from sgim.recognition.vision import opencv

_BORDER = 8
_STEP = 4
_ABOVE = 0.035  # Of the inverse depth in 1/m: 7 mm at half a metre.
_FEWEST = 40


def outline(picture: Picture) -> NDArray[np.bool_]:
    """Which pixels show what stands on the table in the middle of a picture.

    The table is taken to be what reaches the picture's borders. The inverse depth of a plane is
    linear in the pixel's row and column, and what stands on it is nearer. The largest such patch is
    the object.

    Args:
        picture: The picture.

    Returns:
        Shape ``(height, width)``; all false if nothing stands out.
    """
    depth = picture.depth.astype(np.float64)
    known = depth > 0
    near = np.divide(1.0, depth, out=np.zeros_like(depth), where=known)
    border = known.copy()
    border[_BORDER:-_BORDER, _BORDER:-_BORDER] = False
    rows, columns = np.nonzero(border)
    rows, columns = rows[::_STEP], columns[::_STEP]
    if len(rows) < _FEWEST:
        return np.zeros(depth.shape, bool)
    design = np.column_stack((np.ones(len(rows)), rows, columns))
    offset, per_row, per_column = np.linalg.lstsq(design, near[rows, columns])[0]
    height, width = depth.shape
    plane = offset + per_row * np.arange(height)[:, None] + per_column * np.arange(width)
    return _largest(known & (near > plane + _ABOVE))


def _largest(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Its largest patch of connected pixels, without specks and thin threads."""
    cv2 = opencv()
    opened = cv2.morphologyEx(mask.view(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, labels, facts, _ = cv2.connectedComponentsWithStats(opened, connectivity=8)
    if count < 2:
        return np.zeros(mask.shape, bool)
    # A bar in front may part an object: patches close to as large belong to it.
    areas: Any = facts[:, cv2.CC_STAT_AREA]
    large = 1 + np.flatnonzero(areas[1:] >= 0.1 * areas[1:].max())
    return np.isin(labels, large) if len(large) > 1 else labels == large[0]
