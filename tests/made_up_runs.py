"""Made-up runs of throwing in which every claim holds, and what can be changed in them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from sgim.claims.world import World, worlds_of
from sgim.environments import ThrowingArm
from sgim.events import Evaluated
from sgim.runs.summary import Openings, RecordedRun

MOVEMENTS = 4000
EPISODES = 400
"""Episodes in each quarter of a run."""

TASK = ThrowingArm().task
SOCIAL = ("mimic T1", "mimic T2", "mimic T3", "emulate T1", "emulate T2", "emulate T3")

ERRORS = {
    "sgim-acts": (0.001, 0.010),
    "random": (0.030, 0.020),
    "sagg-riac": (0.200, 0.0105),
    "mimicry:T1": (1.000, 0.022),
    "mimicry:T2": (0.0125, 0.350),
    "mimicry:T3": (1.000, 0.350),
    "emulation:T1": (0.600, 0.030),
    "emulation:T2": (0.100, 0.040),
    "emulation:T3": (0.090, 0.044),
    "uniform-choice": (0.0023, 0.0138),
    "round-robin": (0.020, 0.012),
    "demonstrations-first": (0.002, 0.012),
    "demonstrations-first-sagg-riac": (0.002, 0.0125),
}
"""Each learner's final errors in placing and in throwing."""


@dataclass(frozen=True)
class Choices:
    """With which probabilities sgim-acts chooses.

    Attributes:
        autonomous: To explore alone, by quarter.
        placing: A goal that is a placing, by quarter.
        to_place: Weights of the social modes, in the order of `SOCIAL`, if the goal is a placing.
        to_throw: If it is a throw.
    """

    autonomous: Sequence[float] = (0.4, 0.5, 0.6, 0.6)
    placing: Sequence[float] = (0.54, 0.6, 0.65, 0.68)
    to_place: Sequence[float] = (0.03, 0.3, 0.04, 0.03, 0.3, 0.3)
    to_throw: Sequence[float] = (0.3, 0.1, 0.02, 0.2, 0.19, 0.19)

    def draw(self, rng: np.random.Generator) -> Openings:
        """The episodes of a run."""
        modes: list[str] = []
        kinds: list[str | None] = []
        for alone, placing in zip(self.autonomous, self.placing, strict=True):
            for kind in rng.choice(["place", "throw"], EPISODES, p=[placing, 1 - placing]):
                weights = np.array(self.to_place if kind == "place" else self.to_throw)
                social = (1 - alone) * weights / weights.sum()
                modes.append(str(rng.choice(["autonomous", *SOCIAL], p=[alone, *social])))
                kinds.append(str(kind))
        movements = np.linspace(0, MOVEMENTS, len(modes), endpoint=False).astype(np.int64)
        return Openings(movements, modes, kinds)


@dataclass(frozen=True)
class MadeUp:
    """Runs to be made up.

    Attributes:
        errors: Learner → its errors in placing and in throwing.
        choices: Those of sgim-acts.
        seeds: The seeds.
        experiment: The experiment.
        configuration: The configuration.
        scatter: Standard deviation of the logarithms of the errors, from seed to seed.
        teachers: The teachers that sgim-acts has.
    """

    errors: Mapping[str, tuple[float, float]] = field(default_factory=lambda: ERRORS)
    choices: Choices = Choices()
    seeds: Sequence[int] = range(12)
    experiment: str = "throwing"
    configuration: str = "modern"
    scatter: float = 0.02
    teachers: Sequence[str] = ("T1", "T2", "T3")

    def but(self, *, choices: Mapping[str, Any] | None = None, **errors: Any) -> "MadeUp":
        """The same with other choices, or other errors of learners (``_`` for ``-`` and ``:``)."""
        names = {name.replace("-", "_").replace(":", "_"): name for name in self.errors}
        changed = {names[name]: value for name, value in errors.items()}
        return replace(
            self,
            errors={**self.errors, **changed},
            choices=replace(self.choices, **(choices or {})),
        )

    def without(self, learner: str) -> "MadeUp":
        """The same without a learner."""
        kept = {name: errors for name, errors in self.errors.items() if name != learner}
        return replace(self, errors=kept)

    def runs(self) -> list[RecordedRun]:
        """The runs, the last learner first."""
        return [self._run(name, seed) for name in [*self.errors][::-1] for seed in self.seeds]

    def world(self) -> World:
        """The runs as a world."""
        (world,) = worlds_of(self.runs())
        return world

    def _run(self, learner: str, seed: int) -> RecordedRun:
        rng = np.random.default_rng([seed, [*ERRORS].index(learner)])
        place, throw = self.errors[learner] * np.exp(rng.normal(0, self.scatter, 2))
        errors = {"place": place, "throw": throw, "total": (place + throw) / 2}
        openings = (
            self.choices.draw(rng)
            if learner == "sgim-acts"
            else Openings(np.zeros(0, dtype=np.int64), [], [])
        )
        recipe = {
            "configuration": {"name": self.configuration},
            "seed": seed,
            "teachers": [*self.teachers],
        }
        return RecordedRun(
            Path(f"{learner.replace(':', '-')}-{seed}.sgim"),
            {"experiment": self.experiment, "learner": learner, "recipe": recipe, "batch": 1},
            MOVEMENTS,
            {"goals": {"place": 3, "throw": 3}, "digest": "00"},
            (Evaluated(0, dict.fromkeys(errors, 1.0)), Evaluated(MOVEMENTS, errors)),
            task=TASK,
            movements=MOVEMENTS,
            openings=openings,
            troubles={},
        )


HOLDS = MadeUp()
"""Every claim holds."""
