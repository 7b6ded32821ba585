"""Stages of vocal development: periods in which a learner makes much the same sounds."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from sgim.environments.vocal.classes import CLASSES, TYPES
from sgim.experiments.vocal_history import VocalHistory
from sgim.spaces import FloatArray
from sgim.statistics import stages as cut

Label = Literal["no phonation–unarticulated", "unarticulated", "articulated", "other"]

LABELS: tuple[Label, ...] = (
    "no phonation–unarticulated",
    "unarticulated",
    "articulated",
    "other",
)
"""The rows of table 5.3.1."""

WINDOWS = 60
MOST = 4
TOLERANCE = 0.1
"""By how much the shares of classes may scatter within a stage, in root mean square."""

_SHORTEST = 3  # windows


@dataclass(frozen=True)
class Stage:
    """A stage.

    Attributes:
        start: Vocalisations before it.
        end: Vocalisations before the next one.
        classes: Share of each of `CLASSES`.
        types: Share of each of `TYPES`.
    """

    start: int
    end: int
    classes: FloatArray
    types: FloatArray

    @property
    def label(self) -> Label:
        """What is mainly heard: the most frequent class, or a mixture.

        Where silence is the most frequent, or half as frequent as unarticulated sounds which are,
        it is the first of `LABELS`; unless a third of the sounds or more are articulated.
        """
        silent, unarticulated, articulated = self.classes.tolist()
        if articulated > max(silent, unarticulated):
            return "articulated"
        if unarticulated > 2 * silent:
            return "unarticulated"
        return "no phonation–unarticulated" if articulated < 1 / 3 else "other"


def stages_of(history: VocalHistory) -> list[Stage]:
    """The stages of a run, by a stated method and not by eye.

    The run is cut into 60 windows, and these into the fewest stages, at most four, within which
    the shares of the three classes scatter by at most 0.1 (`sgim.statistics.stages`); a stage has
    three windows or more.

    Raises:
        JournalError: If the run has fewer than 60 vocalisations.
    """
    begin = cut(history.shares(WINDOWS), tolerance=TOLERANCE, most=MOST, shortest=_SHORTEST)
    edges = np.linspace(0, len(history), WINDOWS + 1).astype(int)[begin].tolist()
    return [
        Stage(
            start,
            end,
            np.bincount(history.classes[start:end], minlength=len(CLASSES)) / (end - start),
            np.bincount(history.types[start:end], minlength=len(TYPES)) / (end - start),
        )
        for start, end in pairwise(edges)
    ]


def in_order(labels: list[Label]) -> bool:
    """Whether stages pass from silence and unarticulated sounds to unarticulated to articulated.

    All three must come, one after another, and nothing may go back; ``other`` stages count
    nowhere.
    """
    places = [LABELS.index(label) for label in labels if label != "other"]
    return places == sorted(places) and {*places} == {0, 1, 2}
