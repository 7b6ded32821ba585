"""The runs by which claims are decided: those of one experiment in one configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
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
    """

    experiment: str
    configuration: str
    movements: int
    groups: Mapping[str, Sequence[MeasuredRun]]
    notes: tuple[str, ...]

    @property
    def base(self) -> str:
        """The configuration without what differs from it."""
        return base_of(self.configuration)

    @property
    def settings(self) -> str:
        """What differs from the base; empty if nothing does."""
        return self.configuration.partition(",")[2]

    def values(self, measure: Measure | JointMeasure) -> dict[int | None, float]:
        """The measure of each run of its learner, by seed; or of each seed of its learners."""
        if isinstance(measure, JointMeasure):
            return measure.values(self.groups, self.movements)
        runs = self.groups[measure.learner]
        return {run.seed: measure.of(run, self.movements) for run in runs}


def base_of(configuration: str) -> str:
    """The name of the configuration from which one differs: ``modern`` of ``modern,prior=0.1``."""
    return configuration.partition(",")[0]


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
