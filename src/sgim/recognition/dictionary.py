"""A dictionary of visual words that grows with what is seen (Filliat 2007)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float32 = NDArray[np.float32]


class Dictionary:
    """Words are vectors; what is farther than a radius from all of them becomes a new one.

    Words never change or go, so that what was once assigned can only find a nearer, later word.

    Args:
        dimension: Of the vectors.
        radius: Euclidean distance up to which a vector is taken for a word.
    """

    def __init__(self, dimension: int, radius: float) -> None:
        self.radius = float(radius)
        self._words = np.empty((64, dimension), np.float32)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def words(self) -> Float32:
        """The words, oldest first, shape ``(n, dimension)``."""
        return self._words[: self._count]

    def restore(self, words: Float32) -> None:
        """Have these words instead, shape ``(n, dimension)``.

        Raises:
            ValueError: If they are of another dimension.
        """
        if words.ndim != 2 or words.shape[1] != self._words.shape[1]:
            raise ValueError(
                f"words have shape {words.shape}, expected (n, {self._words.shape[1]})"
            )
        self._words = np.concatenate((words.astype(np.float32), self._words[:1]))
        self._count = len(words)

    def add(self, vectors: Float32) -> NDArray[np.intp]:
        """Take in vectors, one after the other, and give the word of each, shape ``(n,)``."""
        for vector in vectors:
            if not self._count or squares(vector[None], self.words).min() > self.radius**2:
                if self._count == len(self._words):
                    self._words = np.concatenate((self._words, np.empty_like(self._words)))
                self._words[self._count] = vector
                self._count += 1
        return self.find(vectors)

    def find(self, vectors: Float32) -> NDArray[np.intp]:
        """The nearest word of each vector, −1 where none is within the radius, shape ``(n,)``."""
        nearest, apart = np.full(len(vectors), -1), np.full(len(vectors), self.radius**2)
        self.find_among(vectors, nearest, apart, 0)
        return nearest

    def find_among(
        self, vectors: Float32, nearest: NDArray[np.intp], apart: NDArray[np.float64], first: int
    ) -> None:
        """Look for nearer words among those from number ``first`` on.

        Args:
            vectors: Shape ``(n, dimension)``.
            nearest: The word of each so far or −1, shape ``(n,)``; updated.
            apart: Its squared distance, or the squared radius, shape ``(n,)``; updated.
            first: How many words have been compared already.
        """
        if first >= self._count or not len(vectors):
            return
        distances = squares(vectors, self.words[first:])
        closest = distances.argmin(axis=1)
        least = distances[np.arange(len(vectors)), closest]
        nearer = np.flatnonzero(least < apart)
        nearest[nearer] = closest[nearer] + first
        apart[nearer] = least[nearer]


def squares(vectors: Float32, words: Float32) -> NDArray[np.float64]:
    """Squared distances, shape ``(n, words)``."""
    products = vectors @ words.T
    lengths = np.einsum("nd,nd->n", vectors, vectors)[:, None]
    apart = lengths + np.einsum("nd,nd->n", words, words) - 2 * products
    return np.asarray(np.maximum(apart, 0), np.float64)
