"""What an experiment is: a world, its teachers, and how a repertoire is measured in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from sgim import algorithms
from sgim.configurations import Configuration
from sgim.environments.base import MinimalEnvironment
from sgim.errors import SgimError, unknown
from sgim.learner import Learner
from sgim.runs.benchmark import Benchmark
from sgim.runs.run import Run
from sgim.teachers import Teacher


@dataclass(frozen=True)
class Experiment:
    """A declaration of an experiment.

    Attributes:
        name: Its name on the command line.
        summary: One line that says what is learned.
        environment: Makes the world.
        benchmark: Makes the benchmark for a world.
        teachers: Teacher's name → one line that says what it shows.
        make_teachers: Makes the teachers.
        unit: Unit of the benchmark's errors.
        movements: How many movements a run has by default.
    """

    name: str
    summary: str
    environment: Callable[[], MinimalEnvironment]
    benchmark: Callable[[MinimalEnvironment], Benchmark]
    teachers: Mapping[str, str] = field(default_factory=dict)
    make_teachers: Callable[[], Mapping[str, Teacher]] = dict
    unit: str = "share of the outcome space"
    movements: int = 8000

    def learner(
        self, name: str, *, configuration: str | Configuration = "modern", seed: int = 0
    ) -> Learner:
        """Make a learner by its name on the command line, such as ``mimicry:T1``.

        Raises:
            UnknownNameError: If learner, teacher or configuration is unknown.
            SgimError: If the learner needs teachers and the experiment has none.
        """
        algorithm, colon, teacher = name.partition(":")
        if colon and teacher not in self.teachers:
            raise unknown(f"teacher of {self.name}", teacher, self.teachers)
        teachers: Sequence[str] = [teacher] if colon else list(self.teachers)
        if algorithm not in algorithms.ALGORITHMS:
            raise unknown("learner", algorithm, algorithms.ALGORITHMS)
        return algorithms.make(
            algorithm, self.environment().task, teachers, config=configuration, seed=seed
        )

    def run(
        self,
        learner: Learner,
        journal: str | Path | None = None,
        *,
        batch: int = 1,
        adopt: bool = False,
    ) -> Run:
        """A run of this experiment, resumed if the journal exists."""
        environment = self.environment()
        made = self.make_teachers()
        return Run(
            learner,
            environment,
            {name: made[name] for name in learner.teachers},
            journal=journal,
            benchmark=self.benchmark(environment),
            batch=batch,
            adopt=adopt,
            about={"experiment": self.name},
        )

    def resume(self, journal: str | Path, recipe: Mapping[str, object], **options: bool) -> Run:
        """A recorded run of this experiment, made again from the recipe in its journal."""
        if recipe is None:
            raise SgimError("the journal has no recipe for its learner")
        learner = algorithms.from_recipe(self.environment().task, recipe)
        return self.run(learner, journal, **options)
