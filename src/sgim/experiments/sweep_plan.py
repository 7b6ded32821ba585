"""Which runs a sweep makes: every experiment with every learner, configuration and seed."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from sgim.errors import SgimError, UnknownNameError, unknown
from sgim.experiments.experiment import Experiment, evaluation_interval
from sgim.experiments.registry import experiment as find_experiment
from sgim.runs.sweep_run import PlannedRun


@dataclass(frozen=True)
class Part:
    """A product of names and seeds: a run for each combination.

    Attributes:
        experiments: Names of experiments.
        learners: Names of learners, such as ``sgim-acts`` and ``mimicry:T1``.
        seeds: The seeds.
        configurations: Names of the learners' configurations, with settings that differ.
        teachers: For learners that ask one teacher which is not named: a run for each of these.
        movements: Movements of each run; the experiment's if None.
        batch: Plans to carry out side by side within a run; the experiment's if None.
        evaluate_every: Movements between evaluations; if None, at most the experiment's and a
            quarter of a run.
    """

    experiments: tuple[str, ...]
    learners: tuple[str, ...]
    seeds: tuple[int, ...]
    configurations: tuple[str, ...] = ("modern",)
    teachers: tuple[str, ...] = ()
    movements: int | None = None
    batch: int | None = None
    evaluate_every: int | None = None

    def runs(self) -> list[PlannedRun]:
        """The runs, experiment by experiment, learner by learner.

        Raises:
            UnknownNameError: If a name is unknown.
            SgimError: If a learner cannot be made, or a number is too small.
        """
        for name in ("movements", "batch", "evaluate_every"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise SgimError(f"{name} is {value}, expected 1 or more")
        found = []
        for name, configuration in itertools.product(self.experiments, self.configurations):
            world = find_experiment(name)
            movements = world.movements if self.movements is None else self.movements
            batch = world.batch if self.batch is None else self.batch
            every = self.evaluate_every or evaluation_interval(movements, world.evaluate_every)
            for learner in self._learners(world, configuration):
                found += [
                    PlannedRun(world, learner, seed, movements, configuration, batch, every)
                    for seed in self.seeds
                ]
        return found

    def _learners(self, world: Experiment, configuration: str) -> list[str]:
        found = []
        for name in self.learners:
            try:
                world.learner(name, configuration=configuration)
            except UnknownNameError:
                raise
            except SgimError:
                if ":" in name or not self.teachers or not world.teachers:
                    raise
                for one in self.teachers:
                    world.learner(f"{name}:{one}", configuration=configuration)
                found += [f"{name}:{one}" for one in self.teachers]
            else:
                found.append(name)
        return found


def plan(parts: Iterable[Part]) -> list[PlannedRun]:
    """The runs of all parts, each once.

    Raises:
        SgimError: If there is none, a run is planned in two ways, or `Part.runs` refuses.
    """
    found: dict[Path, PlannedRun] = {}
    for part in parts:
        for run in part.runs():
            known = found.setdefault(run.path(""), run)
            if known != run:
                raise SgimError(
                    f"{run.path('')} is planned twice, with other movements, batch or evaluations; "
                    "plan it once, or write to two folders"
                )
    if not found:
        raise SgimError("there is nothing to run; name experiments, learners and seeds")
    return [*found.values()]


def parse_seeds(text: str) -> list[int]:
    """The numbers that ``0,3,5-7`` stands for.

    Raises:
        SgimError: If it is not of that form.
    """
    seeds: dict[int, None] = {}
    for part in text.split(","):
        first, dash, last = part.strip().partition("-")
        if not first.isdecimal() or (dash and not last.isdecimal()):
            raise SgimError(f"seeds {text!r}: expected numbers and ranges, such as 0-19 or 0,3-5")
        numbers = range(int(first), int(last or first) + 1)
        if not numbers:
            raise SgimError(f"seeds {text!r}: the range {part} has no number; write it upwards")
        seeds.update(dict.fromkeys(numbers))
    return list(seeds)


@dataclass(frozen=True)
class SweepFile:
    """What a sweep file says.

    Attributes:
        parts: What to run.
        settings: How: ``out``, ``backend``, ``scheduler``, ``address``, ``jobs``, ``retries``,
            ``scratch``, those that it has.
    """

    parts: tuple[Part, ...]
    settings: Mapping[str, Any]


SETTINGS: Mapping[str, type] = {
    **dict.fromkeys(("out", "backend", "scheduler", "address", "scratch"), str),
    **dict.fromkeys(("jobs", "retries"), int),
}
"""Keys of a sweep file that say how to run, and what they hold."""

_NAMES = ("experiments", "learners", "configurations", "teachers")
_NUMBERS = ("movements", "batch", "evaluate_every")


def read_sweep_file(path: Path) -> SweepFile:
    """Read a TOML file with a sweep.

    Its keys are those of `Part` and `SETTINGS`; tables ``[[sweep]]`` are parts, which take from
    the top of the file what they do not say themselves.

    Raises:
        SgimError: If it cannot be read, is not TOML, or says something else.
    """
    import tomllib

    try:
        found = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise SgimError(f"{path} cannot be read ({error.strerror}); check the path") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SgimError(f"{path} is not TOML: {error}") from error
    parts = found.pop("sweep", [{}])
    if not isinstance(parts, list) or not all(isinstance(part, dict) for part in parts):
        raise SgimError(f"{path}: parts of a sweep are written as tables [[sweep]]")
    settings = {key: found.pop(key) for key in [*found] if key in SETTINGS}
    for key, value in settings.items():
        if not isinstance(value, SETTINGS[key]) or isinstance(value, bool):
            raise SgimError(f"{path}: {key} is {value!r}, expected a {SETTINGS[key].__name__}")
    return SweepFile(tuple(_part(path, {**found, **part}) for part in parts), settings)


def _part(path: Path, found: Mapping[str, Any]) -> Part:
    known = {field.name for field in fields(Part)}
    for key in found:
        if key not in known:
            raise unknown(f"key of {path}", key, known | {*SETTINGS} | {"sweep"})
    for key in ("experiments", "learners", "seeds"):
        if key not in found:
            raise SgimError(f"{path}: each part of a sweep needs {key}; this one has {[*found]}")
    said: dict[str, Any] = {"seeds": _seeds(path, found["seeds"])}
    for key in _NAMES:
        if key in found:
            value = found[key]
            names = [value] if isinstance(value, str) else value
            if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
                raise SgimError(f"{path}: {key} is {value!r}, expected a list of names")
            said[key] = tuple(names)
    for key in _NUMBERS:
        if key in found:
            if type(found[key]) is not int:
                raise SgimError(f"{path}: {key} is {found[key]!r}, expected a whole number")
            said[key] = found[key]
    return Part(**said)


def _seeds(path: Path, value: Any) -> tuple[int, ...]:
    if isinstance(value, str):
        return tuple(parse_seeds(value))
    seeds = [value] if type(value) is int else value
    if not isinstance(seeds, list) or not all(type(seed) is int and seed >= 0 for seed in seeds):
        raise SgimError(f"{path}: seeds are {value!r}, expected such as '0-19' or [0, 3]")
    return tuple(seeds)
