"""What the claims about vocal development are about: stages, classes, competences, distances."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from sgim.claims.measures import Unit
from sgim.environments.vocal.classes import CLASSES
from sgim.environments.vocal.languages import ambient_language
from sgim.environments.vocal.perception import Sounds
from sgim.experiments.vocal_history import VocalHistory, VocalRun
from sgim.experiments.vocal_stages import in_order, stages_of
from sgim.runs.measured import MeasuredRun
from sgim.spaces import FloatArray

Part = Literal["early", "mature"]

TENTHS = 10
WINDOWS = 60
THIRD = 1 / 3

_ARTICULATED = CLASSES.index("articulated")
_NEIGHBOURS = 15
_SOUNDS = 500  # of a run, by which its language is told
_NEAREST = 0.01


def history_of(run: MeasuredRun, movements: int) -> VocalHistory:
    """The vocalisations of a run up to a number of movements."""
    assert isinstance(run, VocalRun)
    return run.history.part(0, movements)


@dataclass(frozen=True)
class NoOrder:
    """Whether a run lacks the order of stages of claim V1: 1 if it does, else 0.

    Attributes:
        learner: Whose runs.
    """

    learner: str

    what: ClassVar[str] = "share of runs without the order of stages"
    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    def of(self, run: MeasuredRun, movements: int) -> float:
        """1 or 0."""
        return float(not in_order([s.label for s in stages_of(history_of(run, movements))]))


@dataclass(frozen=True)
class Articulated:
    """The share of articulated sounds.

    Attributes:
        learner: Whose.
        third: In which third of the run, from 1 to 3.
    """

    learner: str
    third: int

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"share of articulated sounds in third {self.third}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Of all sounds of that third."""
        return float(history_of(run, movements).shares(3)[self.third - 1, _ARTICULATED])


@dataclass(frozen=True)
class FirstArticulated:
    """The part of a run that passes before a third of the sounds are articulated.

    Attributes:
        learner: Whose.
    """

    learner: str

    what: ClassVar[str] = "share of the run before a third of the sounds are articulated"
    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    def of(self, run: MeasuredRun, movements: int) -> float:
        """To the first of 60 windows in which they are; 1 if there is none."""
        shares = history_of(run, movements).shares(WINDOWS)[:, _ARTICULATED]
        reached = np.flatnonzero(shares >= THIRD)
        return float(reached[0] / WINDOWS) if len(reached) else 1.0


@dataclass(frozen=True)
class EmulationGain:
    """How much the competence of emulations grows in a half of a run.

    Attributes:
        learner: Whose.
        half: Which, 1 or 2.
    """

    learner: str
    half: int

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        return f"growth of the competence of emulations in half {self.half}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Mean competence in its last fifth less that in its first; NaN without emulations."""
        means = emulated_competences(history_of(run, movements), TENTHS)
        first, last = (0, 4) if self.half == 1 else (5, 9)
        return float(means[last] - means[first])


@dataclass(frozen=True)
class Emulated:
    """The share of emulations in a tenth of a run.

    Attributes:
        learner: Whose.
        tenth: Which, from 1 to 10; None for the one from which the competence of emulations grows
            most to the next.
    """

    learner: str
    tenth: int | None = None

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def what(self) -> str:
        """In words."""
        when = "when they pay most" if self.tenth is None else f"in tenth {self.tenth}"
        return f"share of emulations {when}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """Of all vocalisations of that tenth."""
        history = history_of(run, movements)
        chosen = 0 if self.tenth is None else self.tenth - 1
        if self.tenth is None:
            growth = np.diff(emulated_competences(history, TENTHS))
            if np.isnan(growth).all():
                return float("nan")
            chosen = int(np.nanargmax(growth))
        edges = np.linspace(0, len(history), TENTHS + 1).astype(int)
        return float(history.of_mode("emulate")[edges[chosen] : edges[chosen + 1]].mean())


@dataclass(frozen=True)
class _FromLanguage:
    """What is measured between the sounds of a run and those of a language.

    Attributes:
        learner: Whose sounds.
        language: Which language.
        part: The first tenth of the run, or the last.
    """

    learner: str
    language: str
    part: Part

    unit: ClassVar[Unit] = "error"
    of_choices: ClassVar[bool] = True


@dataclass(frozen=True)
class Distance(_FromLanguage):
    """How far sounds are from the nearest sound of a language, in the mean."""

    @property
    def what(self) -> str:
        """In words."""
        return f"distance of {self.part} sounds from language {self.language}"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """The mean over the sounds of that part."""
        apart = _apart(run, movements, self.part, self.language)
        return float(apart.min(axis=1).mean())


@dataclass(frozen=True)
class Reach(_FromLanguage):
    """How near the nearest hundredth of the sounds come to those of a language, in the mean."""

    @property
    def what(self) -> str:
        """In words."""
        return f"distance of language {self.language} from the nearest {self.part} sounds"

    def of(self, run: MeasuredRun, movements: int) -> float:
        """The mean over the language's sounds."""
        apart = _apart(run, movements, self.part, self.language)
        return float(np.quantile(apart, _NEAREST, axis=0).mean())


@dataclass(frozen=True)
class Mistaken:
    """The share of sounds whose language is told wrongly by sounds of other runs.

    Each of 500 sounds of a run, of the learners amid each language, is told by the 15 nearest of
    those of all runs with other seeds. Where sounds do not depend on the language, two in three
    are mistaken.

    Attributes:
        learners: A learner for each language.
        part: Sounds of the first tenth of the run, or of the last.
    """

    learners: tuple[str, ...]
    part: Part

    unit: ClassVar[Unit] = "share"
    of_choices: ClassVar[bool] = True

    @property
    def learner(self) -> str:
        """All of them."""
        return ", ".join(self.learners)

    @property
    def what(self) -> str:
        """In words."""
        return f"share of {self.part} sounds whose language is mistaken"

    def values(
        self, groups: Mapping[str, Sequence[MeasuredRun]], movements: int
    ) -> dict[int | None, float]:
        """For each seed that the runs amid all languages have; NaN if it is the only one."""
        sounds = {
            (language, run.seed): _some(history_of(run, movements), self.part)
            for language, name in enumerate(self.learners)
            for run in groups[name]
        }
        seeds = [
            {seed for language, seed in sounds if language == wanted}
            for wanted in range(len(self.learners))
        ]
        common = sorted(set.intersection(*seeds), key=str)
        return {seed: self._mistaken(sounds, seed, common) for seed in common}

    def _mistaken(
        self,
        sounds: Mapping[tuple[int, int | None], Sounds],
        seed: int | None,
        seeds: Sequence[int | None],
    ) -> float:
        from scipy.spatial import cKDTree

        others = [other for other in seeds if other != seed]
        if not others:
            return float("nan")
        languages = range(len(self.learners))
        known = [sounds[language, other] for language in languages for other in others]
        labels = np.repeat(
            [language for language in languages for _ in others], [len(part) for part in known]
        )
        tree = cKDTree(np.concatenate(known))
        wrong = []
        for language in languages:
            _, nearest = tree.query(sounds[language, seed], min(_NEIGHBOURS, len(labels)))
            votes = np.stack([(labels[nearest] == one).sum(axis=-1) for one in languages])
            wrong.append(float((votes.argmax(axis=0) != language).mean()))
        return float(np.mean(wrong))


def emulated_competences(history: VocalHistory, parts: int) -> FloatArray:
    """Mean competence of emulations in equal parts of a run, NaN where there is none."""
    emulated, edges = history.of_mode("emulate"), np.linspace(0, len(history), parts + 1)
    means = np.full(parts, np.nan)
    for i in range(parts):
        rows = slice(int(edges[i]), int(edges[i + 1]))
        if emulated[rows].any():
            means[i] = history.competences[rows][emulated[rows]].mean()
    return means


def _part(history: VocalHistory, part: Part) -> Sounds:
    count = max(1, len(history) // TENTHS)
    return history.sounds[:count] if part == "early" else history.sounds[-count:]


def _some(history: VocalHistory, part: Part) -> Sounds:
    """500 sounds of a part at most, evenly over it."""
    sounds = _part(history, part)
    chosen: Sounds = sounds[np.linspace(0, len(sounds) - 1, min(_SOUNDS, len(sounds))).astype(int)]
    return chosen


def _apart(run: MeasuredRun, movements: int, part: Part, language: str) -> FloatArray:
    """Distances of sounds from those of a language, shape ``(n, sounds of the language)``."""
    sounds = _part(history_of(run, movements), part)
    ambient = ambient_language(language).sounds
    apart: FloatArray = np.linalg.norm(sounds[:, None] - ambient[None], axis=2)
    return apart
