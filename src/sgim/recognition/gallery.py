"""Pictures whose features are kept, to be recognised again and again while more is learned."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from sgim.recognition.dictionary import Dictionary
from sgim.recognition.features import Features
from sgim.recognition.views import Views

_PAIR = 1 << 24


def mid_words(points: NDArray[np.intp], colours: NDArray[np.intp]) -> NDArray[np.int64]:
    """Mid-level words of pairs of low-level ones, given with the words of both, shape ``(n, 2)``.

    Returns:
        Whole numbers: from 0 on for pairs of local features, below 0 for pairs of colours.
    """
    return np.concatenate((_named(points), -1 - _named(colours)))


def _named(pairs: NDArray[np.intp]) -> NDArray[np.int64]:
    low, high = pairs.min(axis=1), pairs.max(axis=1)
    return np.asarray(low * _PAIR + high, np.int64)


class Gallery:
    """Pictures by their features, with the low-level words found in them so far.

    Words never go from a dictionary, so that only those new since last time are compared.

    Args:
        points: The dictionary of local features.
        colours: The dictionary of colours.
        features: Of the pictures.
    """

    def __init__(
        self, points: Dictionary, colours: Dictionary, features: Sequence[Features]
    ) -> None:
        self.size = len(features)
        self._points = _Words(
            points, [f.roots for f in features], [f.point_pairs for f in features]
        )
        self._colours = _Words(
            colours, [f.colours for f in features], [f.region_pairs for f in features]
        )

    def bags(self, views: Views) -> sparse.csr_array:
        """Counts of the mid-level words that the views know, shape ``(pictures, words)``."""
        points, of_points = self._points.pairs()
        colours, of_colours = self._colours.pairs()
        columns = views.find(mid_words(points, colours))
        known = columns >= 0
        rows = np.concatenate((of_points, of_colours))[known]
        shape = (self.size, len(views.names))
        ones = np.ones(len(rows), np.float32)
        return sparse.coo_array((ones, (rows, columns[known])), shape).tocsr()


class _Words:
    """Low-level vectors of one sort, their nearest words, and pairs of neighbours."""

    def __init__(
        self,
        dictionary: Dictionary,
        vectors: Sequence[NDArray[np.float32]],
        pairs: Sequence[NDArray[np.intp]],
    ) -> None:
        starts = np.cumsum([0, *map(len, vectors)])
        self._dictionary = dictionary
        self._vectors = np.concatenate(vectors)
        self._pairs = np.concatenate([p + s for p, s in zip(pairs, starts[:-1], strict=True)])
        self._pictures = np.repeat(np.arange(len(pairs)), [len(p) for p in pairs])
        self._nearest = np.full(len(self._vectors), -1)
        self._apart = np.full(len(self._vectors), dictionary.radius**2)
        self._compared = 0

    def pairs(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Pairs of words of neighbours where both are known, and the pictures they are in."""
        self._dictionary.find_among(self._vectors, self._nearest, self._apart, self._compared)
        self._compared = len(self._dictionary)
        words = self._nearest[self._pairs]
        known = (words >= 0).all(axis=1)
        return words[known], self._pictures[known]
