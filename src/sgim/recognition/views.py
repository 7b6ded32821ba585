"""What is known of objects: their views, which are bags of mid-level words, weighed by TF-IDF."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse


class Views:
    """Views of objects, and the dictionary of their mid-level words.

    A mid-level word is any integer: equal pairs of low-level words have equal ones.

    Args:
        new_view: Cosine with an object's own views below which a picture is a new view.

    Attributes:
        labels: The object of each view.
    """

    def __init__(self, new_view: float) -> None:
        self.new_view = new_view
        self.labels: list[str] = []
        self._names = np.empty(0, np.int64)
        self._counts = np.zeros((0, 0), np.float32)
        self._forget()

    def _forget(self) -> None:
        self._weighed: tuple[NDArray[np.float32], NDArray[np.float32]] | None = None
        self._order: NDArray[np.intp] | None = None

    @property
    def names(self) -> NDArray[np.int64]:
        """The mid-level words, oldest first."""
        return self._names

    @property
    def counts(self) -> NDArray[np.float32]:
        """How often each word was seen in each view, shape ``(views, words)``."""
        return self._counts

    def restore(
        self, labels: list[str], names: NDArray[np.int64], counts: NDArray[np.float32]
    ) -> None:
        """Have these views instead.

        Args:
            labels: The object of each.
            names: The mid-level words.
            counts: Shape ``(views, words)``.
        """
        self.labels = labels
        self._names = names
        self._counts = counts
        self._forget()

    def of(self, label: str) -> int:
        """How many views an object has."""
        return self.labels.count(label)

    def find(self, names: NDArray[np.int64]) -> NDArray[np.intp]:
        """Columns of words, −1 for those not known."""
        if not len(self._names):
            return np.full(len(names), -1)
        if self._order is None:
            self._order = np.argsort(self._names)
        at = np.searchsorted(self._names, names, sorter=self._order)
        columns = self._order[np.minimum(at, len(self._names) - 1)]
        return np.where(self._names[columns] == names, columns, -1)

    def learn(self, names: NDArray[np.int64], label: str) -> bool:
        """Learn a picture of an object by its words.

        Args:
            names: Its words, as often as they occur in it.
            label: The object.

        Returns:
            Whether it is a new view.
        """
        self._extend(np.setdiff1d(names, self._names))
        bag = np.bincount(self.find(names), minlength=len(self._names)).astype(np.float32)
        own = [i for i, its in enumerate(self.labels) if its == label]
        best, likeness = -1, 0.0
        if own:
            cosines = self.cosines(sparse.csr_array(bag[None]))[0, own]
            best, likeness = own[int(cosines.argmax())], float(cosines.max())
        new = best < 0 or likeness < self.new_view
        if new:
            self._counts = np.concatenate((self._counts, bag[None]))
            self.labels.append(label)
        else:
            self._counts[best] += bag
        self._weighed = None
        return new

    def _extend(self, names: NDArray[np.int64]) -> None:
        if len(names):
            self._names = np.concatenate((self._names, names))
            self._counts = np.pad(self._counts, ((0, 0), (0, len(names))))
            self._forget()

    def cosines(self, bags: sparse.csr_array) -> NDArray[np.float64]:
        """How like the views pictures are, by cosine of their weighed words.

        A word weighs the logarithm of how few views have it.

        Args:
            bags: Counts of words, shape ``(pictures, words)``.

        Returns:
            Shape ``(pictures, views)``, in [0, 1].
        """
        if self._weighed is None:
            having = np.maximum((self._counts > 0).sum(axis=0), 1)
            rarity = np.log((1 + len(self.labels)) / having).astype(np.float32)
            weighed = self._counts * rarity
            lengths = np.linalg.norm(weighed, axis=1, keepdims=True)
            self._weighed = rarity, weighed / np.maximum(lengths, 1e-12)
        rarity, units = self._weighed
        weighed_bags = bags @ sparse.diags_array(rarity)
        lengths = np.sqrt(weighed_bags.multiply(weighed_bags).sum(axis=1))
        products = np.asarray(weighed_bags @ units.T)
        found = products / np.maximum(lengths, 1e-12)[:, None]
        return np.asarray(np.minimum(found, 1.0), np.float64)
