"""Measures of where a run went: what it reached and aimed at, what it asked for and was shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sgim.claims.measures import Episodes, Unit
from sgim.runs.measured import MeasuredRun
from sgim.runs.summary import RecordedRun
from sgim.statistics import mean_vector_p
from sgim.streams import Streams


@dataclass(frozen=True)
class Tiles:
    """How many tiles of the outcome space were reached, each so often.

    Attributes:
        learner: Whose.
        kind: Kind of the outcomes.
        low: Lower bounds of the box that is tiled.
        high: Upper bounds.
        along: Tiles along each side.
        often: How many outcomes make a tile reached.
    """

    learner: str
    kind: str
    low: tuple[float, ...]
    high: tuple[float, ...]
    along: int
    often: int = 2

    unit: ClassVar[Unit] = "count"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"{self.kind} tiles reached {self.often} times or more"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among the outcomes of so many movements."""
        assert isinstance(run, RecordedRun)
        low, high = np.array(self.low), np.array(self.high)
        outcomes = run.produced(self.kind, movements).reshape(-1, len(low))
        shares = (outcomes - low) / (high - low)
        inside = shares[((shares >= 0) & (shares < 1)).all(axis=1)]
        _, counts = np.unique((inside * self.along).astype(int), axis=0, return_counts=True)
        return float((counts >= self.often).sum())


@dataclass(frozen=True)
class Produced:
    """The share of movements whose outcome lies in its box.

    Attributes:
        learner: Whose.
        kind: Kind of the outcomes.
    """

    learner: str
    kind: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"share of movements with a {self.kind} in its box"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among so many movements."""
        assert isinstance(run, RecordedRun)
        space = run.task.outcome_spaces[self.kind]
        return sum(map(space.contains, run.produced(self.kind, movements))) / movements


@dataclass(frozen=True)
class GoalsWithin:
    """The share of the goals chosen that lie within the convex hull of some points.

    Attributes:
        learner: Whose.
        kind: Kind of the goals.
        counted: The episodes whose goals are meant.
        points: The points, shape ``(n, d)``.
        where: What they are, in words.
    """

    learner: str
    kind: str
    counted: Episodes
    points: Sequence[tuple[float, ...]]
    where: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"share of {self.counted} goals within {self.where}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among the goals of those begun in so many movements; NaN if there was none."""
        from scipy.spatial import Delaunay

        assert isinstance(run, RecordedRun)
        rows, goals = run.aimed_at(self.kind)
        begun = run.openings.movements < movements
        meant = (begun & self.counted.among(run.openings))[rows]
        if not meant.any():
            return float("nan")
        return float((Delaunay(np.array(self.points)).find_simplex(goals[meant]) >= 0).mean())


@dataclass(frozen=True)
class Count:
    """How many episodes of some sort were begun.

    Attributes:
        learner: Whose.
        counted: Which.
    """

    learner: str
    counted: Episodes

    unit: ClassVar[Unit] = "count"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"episodes {self.counted}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """In so many movements."""
        assert isinstance(run, RecordedRun)
        begun = run.openings.movements < movements
        return float((begun & self.counted.among(run.openings)).sum())


@dataclass(frozen=True)
class Early:
    """Which share of some episodes was begun in the first part of the run.

    Attributes:
        learner: Whose.
        counted: Which episodes.
        part: The part, as a share of the movements.
    """

    learner: str
    counted: Episodes
    part: float

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"share of {self.counted} episodes in the first {self.part:.2g} of the movements"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among those in so many movements; NaN if there was none."""
        assert isinstance(run, RecordedRun)
        begun = run.openings.movements[self.counted.among(run.openings)]
        begun = begun[begun < movements]
        return float((begun < self.part * movements).mean()) if len(begun) else float("nan")


@dataclass(frozen=True)
class ChanceOfShown:
    """How likely demonstrations are if they are movements drawn at random, by their mean.

    Attributes:
        learner: To whom they were shown.
    """

    learner: str

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True
    what: ClassVar[str] = "p-value of what was shown being random policies"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """By Hotelling's test against as many uniform policies; NaN if too few were shown."""
        assert isinstance(run, RecordedRun)
        shown = np.unique(run.shown(), axis=0)
        if 2 * len(shown) < shown.shape[1] + 2 or not len(shown):
            return float("nan")
        rng = Streams(run.seed or 0)("claims/random policies")
        space = run.task.policy_space
        return mean_vector_p(shown, np.array([space.sample(rng) for _ in shown]))


@dataclass(frozen=True)
class Floor:
    """The error that noise alone leaves: how well a large memory can do, as it was measured.

    Attributes:
        learner: Whose runs it stands beside.
        floors: Name of the experiment → the error.
    """

    learner: str
    floors: tuple[tuple[str, float], ...]

    unit: ClassVar[Unit] = "error"
    of_choices: ClassVar[bool] = False
    what: ClassVar[str] = "noise floor"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Of the run's experiment; NaN if it was not measured there."""
        return dict(self.floors).get(str(run.experiment), float("nan"))
