"""What claims are about: one number of one run, such as an error or a share of its episodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from sgim.errors import SgimError
from sgim.runs.measured import MeasuredRun
from sgim.runs.summary import QUARTERS, Openings, RecordedRun

Unit = Literal["error", "share", "count"]

ANY = "any"
"""Instead of a teacher's name: whichever."""


@runtime_checkable
class JointMeasure(Protocol):
    """A number of each seed, from the runs of several learners together.

    It has what a `Measure` has, and ``values`` instead of ``of``.
    """

    @property
    def learners(self) -> tuple[str, ...]:
        """Whose runs it needs."""
        ...

    @property
    def learner(self) -> str:
        """All of them, in words."""
        ...

    @property
    def what(self) -> str:
        """See `Measure`."""
        ...

    @property
    def unit(self) -> Unit:
        """See `Measure`."""
        ...

    @property
    def of_choices(self) -> bool:
        """See `Measure`."""
        ...

    def values(
        self, groups: Mapping[str, Sequence[MeasuredRun]], movements: int
    ) -> dict[int | None, float]:
        """The number of each seed; NaN if it has none."""
        ...


class Measure(Protocol):
    """A number of each run of a learner."""

    @property
    def learner(self) -> str:
        """Whose runs are measured, by its name on the command line."""
        ...

    @property
    def what(self) -> str:
        """What is measured, in words."""
        ...

    @property
    def unit(self) -> Unit:
        """``error``, ``share`` or ``count``: it decides the margin and how effects are shown."""
        ...

    @property
    def of_choices(self) -> bool:
        """Whether it needs more of a run than its evaluations, such as its episodes."""
        ...

    def of(self, run: MeasuredRun, movements: int) -> float:
        """The number of a run after so many movements; NaN if it has none."""
        ...


def learners_of(measure: Measure | JointMeasure) -> tuple[str, ...]:
    """Whose runs a measure needs."""
    return measure.learners if isinstance(measure, JointMeasure) else (measure.learner,)


@dataclass(frozen=True)
class Error:
    """The mean error over the benchmark.

    Attributes:
        learner: Whose.
        kind: Kind of goal, or ``total``, the mean of the kinds.
        at: After how many movements; None for the evaluation that the world is compared at.
    """

    learner: str
    kind: str = "total"
    at: int | None = None

    unit: ClassVar[Unit] = "error"
    of_choices: ClassVar[bool] = False

    @property
    def what(self) -> str:
        """In words."""
        at = "" if self.at is None else f" at {self.at} movements"
        return f"{self.kind} error{at}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """At the evaluation after so many movements, or at its own.

        Raises:
            SgimError: If the run has no such evaluation or kind of error.
        """
        movements = movements if self.at is None else self.at
        for evaluation in run.evaluations:
            if evaluation.movements == movements and self.kind in evaluation.errors:
                return float(evaluation.errors[self.kind])
        raise SgimError(
            f"{run.path} has no {self.kind} error at {movements} movements, which a claim is "
            "about; run it again with the experiment's own benchmark"
        )


@dataclass(frozen=True)
class Episodes:
    """Which episodes: those that agree with all that is given.

    Modes are named by their way and, for social ones, the teacher: ``autonomous``, ``mimic T1``.

    Attributes:
        way: ``autonomous``, ``mimic`` or ``emulate``.
        teacher: Whom the mode asks; `ANY` for all modes that ask someone.
        kind: Kind of the goal that was chosen.
    """

    way: str | None = None
    teacher: str | None = None
    kind: str | None = None

    def __str__(self) -> str:
        teacher = "any teacher" if self.teacher == ANY else self.teacher
        asking = f"asking {teacher}" if teacher and not self.way else teacher
        goals = f"{self.kind} goals" if self.kind else None
        mode = " ".join(word for word in (self.way, asking) if word)
        return " for ".join(words for words in (mode, goals) if words) or "all"

    def among(self, openings: Openings) -> NDArray[np.bool_]:
        """Which of these episodes agree, shape ``(n,)``."""
        modes = {name: self._has(name) for name in {*openings.modes}}
        agree = np.fromiter(map(modes.__getitem__, openings.modes), bool, len(openings.modes))
        if self.kind is not None:
            kinds = (kind == self.kind for kind in openings.kinds)
            agree &= np.fromiter(kinds, bool, len(openings.kinds))
        return agree

    def _has(self, mode: str) -> bool:
        way, _, teacher = mode.partition(" ")
        if self.way not in (None, way):
            return False
        return self.teacher in (None, teacher) or (self.teacher == ANY and teacher != "")


@dataclass(frozen=True)
class Share:
    """The share of some episodes among others, as they were decided when they began.

    Attributes:
        learner: Whose.
        counted: Which are counted.
        among: Among which.
        quarter: In which quarter of the movements, from 1 to 4; None for all of them.
        half: In which half of them, 1 or 2, instead.
    """

    learner: str
    counted: Episodes
    among: Episodes = Episodes()
    quarter: int | None = None
    half: int | None = None

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        among = "" if self.among == Episodes() else f" among {self.among}"
        when = "" if self.quarter is None else f" in quarter {self.quarter}"
        when = when if self.half is None else f" in half {self.half}"
        return f"share of {self.counted}{among}{when}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Among the episodes begun in so many movements; NaN if there was none of those."""
        assert isinstance(run, RecordedRun)
        part, parts = 1, 1
        if self.quarter is not None:
            part, parts = self.quarter, QUARTERS
        elif self.half is not None:
            part, parts = self.half, 2
        first, end = movements * (part - 1) / parts, movements * part / parts
        begun = run.openings.movements
        rows = (begun >= first) & (begun < end) & self.among.among(run.openings)
        counted = self.counted.among(run.openings) & rows
        return float(counted.sum() / rows.sum()) if rows.any() else float("nan")


@dataclass(frozen=True)
class EvenShare:
    """The share that some modes or teachers would have if all were chosen equally often.

    It depends on the world, since worlds may have more teachers.

    Attributes:
        learner: Which learner's modes: one autonomous, and two ways for each of its teachers.
        count: How many are meant.
        of_teachers: Whether they are teachers, among teachers, and not modes among modes.
    """

    learner: str
    count: int = 1
    of_teachers: bool = False

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = False

    @property
    def what(self) -> str:
        """In words."""
        each = "teacher" if self.of_teachers else "mode"
        return f"even share of {self.count} {each}{'s' * (self.count > 1)}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """By the teachers that the run's recipe names.

        Raises:
            SgimError: If it names none.
        """
        teachers: Sequence[str] = run.recipe.get("teachers") or ()
        if not teachers:
            raise SgimError(
                f"{run.path} does not say which teachers {self.learner} has; run it again by name"
            )
        return self.count / (len(teachers) if self.of_teachers else 1 + 2 * len(teachers))


@dataclass(frozen=True)
class Constant:
    """The same number for each run of a learner.

    Attributes:
        learner: Whose runs it stands beside.
        value: The number.
        unit: What it is.
    """

    learner: str
    value: float
    unit: Unit = "share"

    of_choices: ClassVar[bool] = False

    @property
    def what(self) -> str:
        """The number in writing."""
        return f"{self.value:.3g}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """The number."""
        return self.value
