"""Recognises objects by their views, which are learned one labelled picture at a time.

It follows section 2.2.1 of the thesis: pairs of neighbouring features are mid-level words, views
are bags of them, pictures vote by TF-IDF for the views they are like, and views are of objects.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sgim.errors import SgimError, unknown
from sgim.recognition.dictionary import Dictionary
from sgim.recognition.features import Eye, Features
from sgim.recognition.gallery import Gallery, mid_words
from sgim.recognition.picture import Picture
from sgim.recognition.views import Views


class NothingLearnedError(SgimError, LookupError):
    """No picture has been learned yet, so that none can be recognised."""


@dataclass(frozen=True)
class Settings:
    """The constants of a recogniser.

    Attributes:
        point_radius: Distance of RootSIFT descriptors up to which they are the same word.
        colour_radius: The same of Lab colours.
        new_view: Cosine of a picture with an object's own views below which it is a new view.
    """

    point_radius: float = 0.6
    colour_radius: float = 20.0
    new_view: float = 0.5


@dataclass(frozen=True)
class Recognition:
    """What a picture was taken for.

    Attributes:
        label: Of the object whose view is most like the picture; None if no view is like it.
        likelihood: The cosine with that view, in [0, 1].
        second: The label of the view second most like it, which may be the same; None if there
            is none like it.
        second_likelihood: The cosine with that.
    """

    label: str | None
    likelihood: float
    second: str | None
    second_likelihood: float


class Recogniser:
    """Learns from labelled pictures, and recognises what is in others.

    Args:
        settings: Its constants.
        eye: Finds the features of pictures.

    Attributes:
        settings: As given.
        eye: As given.
        points: The dictionary of local features.
        colours: The dictionary of superpixels' colours.
        views: What is known of the objects.
    """

    def __init__(self, settings: Settings | None = None, eye: Eye | None = None) -> None:
        self.settings = settings or Settings()
        self.eye = eye or Eye()
        self.points = Dictionary(128, self.settings.point_radius)
        self.colours = Dictionary(3, self.settings.colour_radius)
        self.views = Views(self.settings.new_view)

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels learned, in the order they were first heard."""
        return tuple(dict.fromkeys(self.views.labels))

    def known_views(self, label: str) -> int:
        """How many views of an object are known.

        Raises:
            UnknownNameError: If no picture of it has been learned.
        """
        if label not in self.views.labels:
            raise unknown("label", label, self.labels)
        return self.views.of(label)

    def learn(self, seen: Picture | Features, label: str) -> bool:
        """Learn that a picture shows an object.

        Args:
            seen: The picture, or its features if they are known.
            label: What it shows.

        Returns:
            Whether it was a new view of the object.
        """
        if not isinstance(label, str) or not label:
            raise SgimError(f"label is {label!r}, expected a word")
        features = self._features(seen)
        points, colours = self.points.add(features.roots), self.colours.add(features.colours)
        words = mid_words(points[features.point_pairs], colours[features.region_pairs])
        return self.views.learn(words, label)

    def recognise(self, seen: Picture | Features) -> Recognition:
        """What a picture is taken for.

        Args:
            seen: The picture, or its features if they are known.

        Raises:
            NothingLearnedError: If nothing has been learned.
        """
        return self.recognise_all(self.gallery([self._features(seen)]))[0]

    def save(self, path: str | Path) -> None:
        """Write all that has been learned to a file, for `load`; one that exists is replaced."""
        from sgim.recognition.saving import save

        save(self, path)

    @staticmethod
    def load(path: str | Path) -> Recogniser:
        """Make a recogniser again from the file that `save` wrote.

        Raises:
            SavedRecogniserError: If it is no recogniser, is damaged, or was written by a newer
                version.
            OSError: If it cannot be read.
        """
        from sgim.recognition.saving import load

        return load(path)

    def gallery(self, features: Sequence[Features]) -> Gallery:
        """Keep the features of pictures, to recognise them again and again."""
        return Gallery(self.points, self.colours, features)

    def recognise_all(self, gallery: Gallery) -> list[Recognition]:
        """What each picture of a gallery of this recogniser is taken for now.

        Raises:
            NothingLearnedError: If nothing has been learned.
        """
        labels = self.views.labels
        if not labels:
            raise NothingLearnedError(
                "nothing has been learned yet: learn(picture, label) comes before recognise"
            )
        cosines = self.views.cosines(gallery.bags(self.views))
        best = np.argsort(-cosines, axis=1, kind="stable")[:, :2]
        found = []
        for row, order in zip(cosines, best, strict=True):
            two = [(labels[i], float(row[i])) if row[i] > 0 else (None, 0.0) for i in order]
            (label, likelihood), (second, second_likelihood) = (*two, (None, 0.0))[:2]
            found.append(Recognition(label, likelihood, second, second_likelihood))
        return found

    def _features(self, seen: Picture | Features) -> Features:
        if isinstance(seen, Features):
            return seen
        if not isinstance(seen, Picture):
            raise SgimError(
                f"a {type(seen).__name__} cannot be looked at, expected a Picture(colours, depth)"
            )
        return self.eye.look(seen)
