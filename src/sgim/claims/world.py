"""The runs by which claims are decided: those of one experiment in one configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from sgim.claims.measures import JointMeasure, Measure
from sgim.experiments import EXPERIMENTS
from sgim.runs.comparable import select
from sgim.runs.measured import MeasuredRun, read_measured
from sgim.runs.summary import RecordedRun

Chooser = tuple[str | None, str | None]
ReadRun = Callable[[Path], RecordedRun]


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
        return _named(self.experiment, self.settings)

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
        name, world = self._found(learner)
        return world is not None and name in world.groups

    def values(self, measure: Measure | JointMeasure) -> dict[int | None, float]:
        """The measure of each run of its learner, by seed; or of each seed of its learners."""
        if isinstance(measure, JointMeasure):
            return measure.values(self.groups, self.movements)
        name, world = self._found(measure.learner)
        assert world is not None
        return {run.seed: measure.of(run, world.movements) for run in world.groups[name]}

    def _found(self, learner: str) -> tuple[str, World | None]:
        """A learner's name without its world, and that world; None if it has no runs."""
        name, experiment, settings = apart(learner)
        if not experiment and not settings:
            return name, self
        return name, self.elsewhere.get(_named(experiment or self.experiment, settings))


def _named(experiment: str, settings: str) -> str:
    return f"{experiment} with {settings}" if settings else experiment


def base_of(configuration: str) -> str:
    """The name of the configuration from which one differs: ``modern`` of ``modern,prior=0.1``."""
    return configuration.partition(",")[0]


def apart(learner: str) -> tuple[str, str, str]:
    """A learner's name, its experiment, and settings that differ; empty if as in the world meant.

    ``sgim-d in fishing-wide`` is of another experiment, ``sgim-d with demonstration_every=80`` of
    the same one.
    """
    rest, _, settings = learner.partition(" with ")
    name, _, experiment = rest.partition(" in ")
    return name, experiment, settings


def linked(worlds: Sequence[World], experiment: str) -> list[World]:
    """The worlds, those without settings with what can be compared with them.

    Those of the experiment know all worlds of their base configuration, those of its variants the
    ones of the same variant.
    """

    def near(world: World) -> dict[str, World]:
        return {
            other.name: other
            for other in worlds
            if other.base == world.base and world.experiment in (experiment, other.experiment)
        }

    return [w if w.settings else replace(w, elsewhere=near(w)) for w in worlds]


def read_runs(paths: Iterable[Path], choosers: Mapping[Chooser, ReadRun]) -> list[MeasuredRun]:
    """Read runs; more than their errors only of those learners whose choices are asked for.

    Args:
        paths: The journals.
        choosers: Experiment (or that of which it is a variant) and learner → how to read its runs.

    Raises:
        JournalError: If one cannot be read.
    """
    runs = []
    for path in paths:
        run = read_measured(path)
        read = choosers.get((main_experiment(run), run.learner))
        runs.append(run if read is None else read(path))
    return runs


def main_experiment(run: MeasuredRun) -> str | None:
    """The experiment of a run, or the one of which it is a variant."""
    experiment = EXPERIMENTS.get(run.experiment or "")
    return experiment.variant_of or experiment.name if experiment else run.experiment


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
