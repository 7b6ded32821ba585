"""How many pictures of each object a learner recognises, of pictures it never learns from."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from typing import Any

from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.recognition.features import FEATURES, Features
from sgim.recognition.gallery import Gallery
from sgim.recognition.model import RecognitionModel
from sgim.streams import Streams

TAKEN_FOR = "taken for"
"""Begins the kind of error that counts what is wrongly taken for a label."""


class RecognitionBenchmark:
    """Pictures to be recognised, by their features (section 2.3.2).

    Args:
        pictures: Label → features of its pictures; as many for each.
    """

    def __init__(self, pictures: Mapping[str, Sequence[Features]]) -> None:
        self.pictures = {label: list(features) for label, features in pictures.items()}
        counts = {len(features) for features in self.pictures.values()}
        if len(counts) != 1 or 0 in counts:
            raise SgimError(f"a benchmark needs as many pictures of each label, got {counts}")
        self.each = counts.pop()
        self._gallery: tuple[RecognitionModel, Gallery] | None = None

    def describe(self) -> dict[str, Any]:
        """What it measures by: labels and how many pictures of each, and a digest of them."""
        digest = hashlib.blake2b(digest_size=8)
        for label, features in self.pictures.items():
            digest.update(label.encode())
            for one in features:
                digest.update(FEATURES.pack(one.arrays))
        counts = dict.fromkeys(self.pictures, self.each)
        return {"pictures": counts, "digest": digest.hexdigest()}

    def evaluate(self, learner: Learner, streams: Streams, index: int) -> dict[str, float]:
        """The share of each label's pictures that is not recognised, and ``total``, their mean.

        For each label there is ``taken for LABEL`` too: how many pictures of others are taken for
        it, as a share of a label's pictures. It does not count in the total.

        Args:
            learner: Whose model is a `RecognitionModel`.
            streams: Not used.
            index: Not used.

        Raises:
            SgimError: If the learner's model recognises nothing.
        """
        found = self.recognised(learner)
        missed, wrong = dict.fromkeys(self.pictures, 0), dict.fromkeys(self.pictures, 0)
        for label, taken in found.items():
            for one in taken:
                if one != label:
                    missed[label] += 1
                    if one in wrong:
                        wrong[one] += 1
        errors = {label: count / self.each for label, count in missed.items()}
        total = sum(errors.values()) / len(errors)
        others = {f"{TAKEN_FOR} {label}": count / self.each for label, count in wrong.items()}
        return {**errors, **others, "total": total}

    def recognised(self, learner: Learner) -> dict[str, list[str | None]]:
        """For each label, what each of its pictures is taken for; None for nothing known."""
        model = learner.model
        if not isinstance(model, RecognitionModel):
            raise SgimError(
                f"{type(model).__name__} recognises no pictures; a learner for this benchmark has "
                "a RecognitionModel"
            )
        if not model.recogniser.labels:
            return {label: [None] * self.each for label in self.pictures}
        if self._gallery is None or self._gallery[0] is not model:
            features = [one for several in self.pictures.values() for one in several]
            self._gallery = (model, model.recogniser.gallery(features))
        taken = [r.label for r in model.recogniser.recognise_all(self._gallery[1])]
        return {
            label: taken[i * self.each : (i + 1) * self.each]
            for i, label in enumerate(self.pictures)
        }
