"""What claims about learners of labels are about: which labels they choose, and for how long."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import ClassVar

import numpy as np

from sgim.claims.measures import Error, Unit
from sgim.runs.measured import MeasuredRun
from sgim.runs.summary import RecordedRun
from sgim.spaces import Choices


@dataclass(frozen=True)
class Loss:
    """By how much the final error of a learner is above that of another, seed by seed.

    Attributes:
        of: Whose error.
        above: Above whose.
    """

    of: str
    above: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = False

    @property
    def learners(self) -> tuple[str, ...]:
        """Both."""
        return (self.of, self.above)

    @property
    def learner(self) -> str:
        """Whose error it is."""
        return self.of

    @property
    def what(self) -> str:
        """In words."""
        return f"total error above that of {self.above}"

    def values(
        self, groups: Mapping[str, Sequence[MeasuredRun]], movements: int
    ) -> dict[int | None, float]:
        """The difference at each seed that both have."""
        one, other = (
            {run.seed: Error(name).of(run, movements) for run in groups[name]}
            for name in self.learners
        )
        return {seed: error - other[seed] for seed, error in one.items() if seed in other}


@dataclass(frozen=True)
class OnLabel:
    """The share of episodes for a label, once each label has been presented.

    Attributes:
        learner: Whose.
        label: The label.
    """

    learner: str
    label: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"share of episodes for {self.label}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among the episodes begun in so many movements; NaN if there was none."""
        chosen = _chosen(run, movements)
        return chosen.count(self.label) / len(chosen) if chosen else float("nan")


@dataclass(frozen=True)
class EvenLabels:
    """The share that a label would have if all were chosen equally often.

    Attributes:
        learner: Whose labels.
    """

    learner: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True
    what: ClassVar[str] = "even share of the labels"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """One over how many labels the run's task has."""
        return 1 / _count(run)


@dataclass(frozen=True)
class Dwelling:
    """For how many episodes on end a learner stays with a label, in the mean.

    Attributes:
        learner: Whose.
    """

    learner: str

    unit: ClassVar[Unit] = "error"
    of_choices: ClassVar[bool] = True
    what: ClassVar[str] = "episodes on end for a label"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Of the episodes begun in so many movements, after the presentation."""
        lengths = [len([*group]) for _, group in groupby(_chosen(run, movements))]
        return float(np.mean(lengths)) if lengths else float("nan")


def _count(run: MeasuredRun) -> int:
    """How many labels there are, which is how many episodes the presentation takes."""
    assert isinstance(run, RecordedRun)
    return sum(len(s.labels) for s in run.task.goal_spaces.values() if isinstance(s, Choices))


def _chosen(run: MeasuredRun, movements: int) -> list[str | None]:
    """The labels chosen after the presentation, in order."""
    assert isinstance(run, RecordedRun)
    begun = int(np.searchsorted(run.openings.movements, movements))
    return run.openings.labels[_count(run) : begun]
