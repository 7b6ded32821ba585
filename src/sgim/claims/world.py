"""The runs by which claims are decided: those of one experiment in one configuration."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from sgim.claims.measures import Measure
from sgim.runs.comparable import select
from sgim.runs.measured import MeasuredRun, read_measured
from sgim.runs.summary import read_run


@dataclass(frozen=True)
class World:
    """Runs that can be compared, learner by learner.

    Attributes:
        experiment: Name of the experiment.
        configuration: Name of the configuration: a base, and after commas what differs from it.
        movements: After how many movements they are compared.
        groups: Name of a learner → its runs, in the order of their seeds.
        notes: What was left out, and what else a reader should know.
        elsewhere: Other worlds of the same base configuration by their names, for claims that
            compare worlds.
    """

    experiment: str
    configuration: str
    movements: int
    groups: Mapping[str, Sequence[MeasuredRun]]
    notes: tuple[str, ...]
    elsewhere: Mapping[str, World] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The experiment, and what differs from the base configuration."""
        return f"{self.experiment} with {self.settings}" if self.settings else self.experiment

    @property
    def base(self) -> str:
        """The configuration without what differs from it."""
        return base_of(self.configuration)

    @property
    def settings(self) -> str:
        """What differs from the base; empty if nothing does."""
        return self.configuration.partition(",")[2]

    def has(self, learner: str) -> bool:
        """Whether there are runs of a learner, here or in the world that its name says."""
        name, where = apart(learner)
        if where is None:
            return name in self.groups
        return where in self.elsewhere and self.elsewhere[where].has(name)

    def values(self, measure: Measure) -> dict[int | None, float]:
        """The measure of each run of its learner, by seed."""
        name, where = apart(measure.learner)
        world = self if where is None else self.elsewhere[where]
        return {run.seed: measure.of(run, world.movements) for run in world.groups[name]}


def base_of(configuration: str) -> str:
    """The name of the configuration from which one differs: ``modern`` of ``modern,prior=0.1``."""
    return configuration.partition(",")[0]


def apart(learner: str) -> tuple[str, str | None]:
    """A learner's name, and the world where its runs are: ``sgim-d:D3 in fishing-wide``."""
    name, _, where = learner.partition(" in ")
    return name, where or None


def linked(worlds: Sequence[World], experiment: str) -> list[World]:
    """The worlds; those of an experiment as it is know the others of their base configuration."""
    return [
        replace(world, elsewhere={w.name: w for w in worlds if w.base == world.base})
        if world.name == experiment
        else world
        for world in worlds
    ]


def read_runs(paths: Iterable[Path], choosers: Container[str | None]) -> list[MeasuredRun]:
    """Read runs; the episodes only of those learners whose choices are asked for.

    Raises:
        JournalError: If one cannot be read.
    """
    runs = map(read_measured, paths)
    return [read_run(run.path) if run.learner in choosers else run for run in runs]


def worlds_of(runs: Iterable[MeasuredRun], at: int | None = None) -> list[World]:
    """Runs by experiment and configuration, those of the shortest names first.

    Args:
        runs: The runs.
        at: The evaluation to compare at, in movements; the last that all of a world have if None.

    Raises:
        SgimError: If runs of one experiment and configuration cannot be compared; the message
            says which, and what to do.
    """
    members: dict[tuple[str, str], list[MeasuredRun]] = {}
    for run in runs:
        key = (str(run.experiment), str(run.configuration))
        members.setdefault(key, []).append(run)
    worlds = []
    for experiment, configuration in sorted(members, key=lambda key: (key[1], key[0])):
        chosen = select(members[experiment, configuration], "total", at)
        movements, notes = chosen.movements[-1], tuple(chosen.notes)
        worlds.append(World(experiment, configuration, movements, chosen.groups, notes))
    return worlds
