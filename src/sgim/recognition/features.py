"""What is kept of a picture: local features, colours of superpixels, and where they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.arrays import Arrays
from sgim.recognition.outline import outline
from sgim.recognition.picture import Picture
from sgim.recognition.superpixels import superpixels
from sgim.recognition.vision import opencv

FEATURES = Arrays(
    {
        "points": ("float32", 2),
        "descriptors": ("uint8", 128),
        "regions": ("float32", 2),
        "colours": ("float32", 3),
        "digest": ("uint8", 16),
    },
    together=[("points", "descriptors"), ("regions", "colours")],
)
"""The space of features, as journals keep them."""

_NEIGHBOURS = 3
_MARGIN = 8


@dataclass(frozen=True, eq=False)
class Features:
    """The features of a picture.

    Attributes:
        points: Places (column, row) of the local features in pixels, shape ``(n, 2)``.
        descriptors: Their SIFT descriptors, shape ``(n, 128)``, uint8.
        regions: Places of the superpixels, shape ``(m, 2)``.
        colours: Their mean Lab colours, shape ``(m, 3)``.
        digest: The picture's `Picture.digest`, shape ``(1, 16)``, uint8.
    """

    points: NDArray[np.float32]
    descriptors: NDArray[np.uint8]
    regions: NDArray[np.float32]
    colours: NDArray[np.float32]
    digest: NDArray[np.uint8]

    @classmethod
    def of(cls, arrays: Mapping[str, Any]) -> Features:
        """From a point of `FEATURES`."""
        return cls(**FEATURES.check(arrays, "features"))

    @property
    def arrays(self) -> dict[str, NDArray[Any]]:
        """As a point of `FEATURES`."""
        return {name: getattr(self, name) for name in FEATURES.fields}

    @cached_property
    def roots(self) -> NDArray[np.float32]:
        """RootSIFT (Arandjelović and Zisserman 2012): roots of descriptors that sum to 1."""
        sums = self.descriptors.sum(axis=1, keepdims=True, dtype=np.float32)
        return np.asarray(np.sqrt(self.descriptors / np.maximum(sums, 1)), np.float32)

    @cached_property
    def point_pairs(self) -> NDArray[np.intp]:
        """Pairs of neighbouring local features, shape ``(p, 2)``."""
        return neighbours(self.points)

    @cached_property
    def region_pairs(self) -> NDArray[np.intp]:
        """Pairs of neighbouring superpixels, shape ``(q, 2)``."""
        return neighbours(self.regions)


def neighbours(places: NDArray[np.float32], count: int = _NEIGHBOURS) -> NDArray[np.intp]:
    """Each place with its nearest others, each pair once.

    Args:
        places: Shape ``(n, 2)``.
        count: How many others.

    Returns:
        Row numbers, the lower first, shape ``(p, 2)``.
    """
    n = len(places)
    count = min(count, n - 1)
    if count < 1:
        return np.empty((0, 2), np.intp)
    apart = ((places[:, None, :] - places[None, :, :]) ** 2).sum(axis=2)
    np.fill_diagonal(apart, np.inf)
    nearest = np.argsort(apart, axis=1, kind="stable")[:, :count]
    first = np.repeat(np.arange(n), count)
    pairs = np.sort(np.column_stack((first, nearest.ravel())), axis=1)
    return np.unique(pairs, axis=0)


class Eye:
    """Finds the features of what stands on the table in a picture.

    Args:
        most_points: Local features kept, the strongest.
        contrast: Of a local feature, from 0 to 1, at least.
        patch: Distance of neighbouring superpixels in pixels.
    """

    def __init__(
        self, *, most_points: int = 60, contrast: float = 0.02, patch: float = 16.0
    ) -> None:
        self.most_points = most_points
        self.contrast = contrast
        self.patch = patch

    def look(self, picture: Picture) -> Features:
        """The features of a picture; none where nothing stands on the table.

        Raises:
            SgimError: If OpenCV is not installed.
        """
        cv2 = opencv()
        mask = outline(picture)
        digest = np.frombuffer(picture.digest(), np.uint8).reshape(1, 16)
        if not mask.any():
            nothing = np.empty((0, 2), np.float32)
            no_colours = np.empty((0, 3), np.float32)
            return Features(nothing, np.empty((0, 128), np.uint8), nothing, no_colours, digest)
        rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        top, left = max(0, rows[0] - _MARGIN), max(0, columns[0] - _MARGIN)
        window = (slice(top, rows[-1] + _MARGIN), slice(left, columns[-1] + _MARGIN))
        mask, colours = mask[window], np.ascontiguousarray(picture.colours[window])
        points, descriptors = self._local(cv2, colours, mask)
        lab = cv2.cvtColor(colours.astype(np.float32) / 255, cv2.COLOR_RGB2LAB)
        regions, means = superpixels(lab[::2, ::2], mask[::2, ::2], self.patch / 2)
        return Features(points, descriptors, 2 * regions, means, digest)

    def _local(
        self, cv2: Any, colours: NDArray[np.uint8], mask: NDArray[np.bool_]
    ) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
        sift = cv2.SIFT_create(nfeatures=self.most_points, contrastThreshold=self.contrast)
        grey = cv2.cvtColor(colours, cv2.COLOR_RGB2GRAY)
        found, descriptors = sift.detectAndCompute(grey, mask.view(np.uint8))
        if not found:
            return np.empty((0, 2), np.float32), np.empty((0, 128), np.uint8)
        points = np.array([point.pt for point in found], np.float32)
        return points, np.rint(descriptors).astype(np.uint8)
