"""What an experiment is: a world, its teachers, and how a repertoire is measured in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sgim import algorithms, configurations
from sgim.configurations import Configuration
from sgim.environments.base import MinimalEnvironment
from sgim.errors import JournalError, SgimError, UnknownNameError, unknown
from sgim.learner import Learner
from sgim.runs.benchmark import Measures
from sgim.runs.journal import Journal
from sgim.runs.journal_reading import header_of
from sgim.runs.run import Run
from sgim.teachers import RemoteTeacher, Teacher

NO_TEACHER = "none"
"""Said instead of a teacher's name."""


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
        alone: The learner of a run without teachers, when none is named.
        taught: The learner of a run with teachers, when none is named.
        default_teacher: The only teacher of a run for which none is named; None for all,
            `NO_TEACHER` for none if no learner is named either, else all.
        batch: How many movements a run carries out side by side by default.
        evaluate_every: Most movements between evaluations by default.
        variant_of: Name of the experiment of which this is a variant, if it is one.
    """

    name: str
    summary: str
    environment: Callable[[], MinimalEnvironment]
    benchmark: Callable[[MinimalEnvironment], Measures]
    teachers: Mapping[str, str] = field(default_factory=dict)
    make_teachers: Callable[[], Mapping[str, Teacher | RemoteTeacher]] = dict
    unit: str = "share of the outcome space"
    movements: int = 8000
    alone: str = "sagg-riac"
    taught: str = "sgim-acts"
    default_teacher: str | None = None
    batch: int = 1
    evaluate_every: int = 1000
    variant_of: str | None = None

    def learner_name(self, learner: str | None = None, teacher: str | None = None) -> str:
        """The name of a run's learner, given what was said of it.

        Args:
            learner: Its name; None for the experiment's own.
            teacher: Its only teacher; `NO_TEACHER` for none, None if nothing was said.
        """
        if learner is None:
            teacher = self.default_teacher if teacher is None else teacher
            if teacher == NO_TEACHER:
                return self.alone
            learner = self.taught if self.teachers else self.alone
        return learner if teacher is None else f"{learner.partition(':')[0]}:{teacher}"

    def learner(
        self, name: str, *, configuration: str | Configuration = "modern", seed: int = 0
    ) -> Learner:
        """Make a learner by its name on the command line, such as ``mimicry:T1``.

        With ``:none`` it has no teacher.

        Raises:
            UnknownNameError: If learner, teacher or configuration is unknown.
            SgimError: If the learner needs teachers and the experiment has none, or the other
                way round; or if it needs one teacher and that is not named.
        """
        algorithm, colon, teacher = name.partition(":")
        task = self.environment().task
        known = algorithms.algorithms_for(task)
        if algorithm not in known:
            raise unknown("learner", algorithm, known)
        if colon and teacher not in (*self.teachers, NO_TEACHER):
            if not self.teachers:
                raise SgimError(f"{self.name} has no teachers; leave {teacher!r} out")
            raise unknown(f"teacher of {self.name}", teacher, self.teachers)
        chosen = configurations.configuration_of(configuration)
        named = [] if teacher == NO_TEACHER else [teacher]
        usual = [t for t in self.teachers if self.default_teacher in (t, None, NO_TEACHER)]
        teachers: Sequence[str] = named if colon else usual
        try:
            learner = algorithms.make(algorithm, task, teachers, configuration=chosen, seed=seed)
        except UnknownNameError:
            raise
        except SgimError as error:
            if not self.teachers:
                raise SgimError(f"{algorithm} needs a teacher, and {self.name} has none") from error
            shown = "; ".join(f"{algorithm}:{t} ({line})" for t, line in self.teachers.items())
            raise SgimError(f"{algorithm} has one teacher: choose among {shown}") from error
        if colon and named and not learner.teachers:
            raise SgimError(f"{algorithm} asks no teacher; leave {teacher!r} out")
        return learner

    def label(self, learner: Learner) -> str | None:
        """The name on the command line of a learner; None if it has no recipe."""
        if learner.recipe is None:
            return None
        name: str = learner.recipe["learner"]
        asked = [teacher for teacher in self.teachers if teacher in learner.teachers]
        return f"{name}:{','.join(asked)}" if 0 < len(asked) < len(self.teachers) else name

    def journal_path(
        self,
        learner: str,
        seed: int = 0,
        configuration: str = "modern",
        folder: str | Path = "runs",
    ) -> Path:
        """Where the journal of such a run is by default: ``runs/throwing-mimicry-T1-0.sgim``."""
        kind = "" if configuration == "modern" else f"-{configuration}"
        return Path(folder) / f"{self.name}-{learner.replace(':', '-')}{kind}-{seed}.sgim"

    def run(
        self,
        learner: Learner,
        journal: str | Path | None = None,
        *,
        batch: int = 1,
        evaluate_every: int = 1000,
        adopt: bool = False,
        about: Mapping[str, Any] | None = None,
    ) -> Run:
        """A run of this experiment, resumed if the journal exists.

        Args:
            learner: The learner, which has done nothing yet.
            journal: Path of the journal; None to keep none.
            batch: Plans to carry out side by side.
            evaluate_every: Movements between evaluations.
            adopt: Whether to adopt decisions that come out differently on resume.
            about: What else to write in the journal's header.
        """
        environment = self.environment()
        made = self.make_teachers()
        if unknown_ := [name for name in learner.teachers if name not in made]:
            raise SgimError(
                f"{self.name} has no teacher {', '.join(unknown_)}: this learner is taught by a "
                f"person; go on with sgim teach {self.name} --journal PATH"
            )
        label = self.label(learner)
        named = {} if label is None else {"learner": label}
        return Run(
            learner,
            environment,
            {name: made[name] for name in learner.teachers},
            journal=journal,
            benchmark=self.benchmark(environment),
            batch=batch,
            evaluate_every=evaluate_every,
            adopt=adopt,
            about={"experiment": self.name, **named, **(about or {})},
        )

    def start(
        self,
        name: str,
        journal: str | Path,
        *,
        configuration: str = "modern",
        seed: int = 0,
        batch: int = 1,
        evaluate_every: int = 1000,
        warm_start: str | Path | None = None,
    ) -> Run:
        """Begin the run of a named learner, or go on with it if the journal has it already.

        Args:
            name: The learner's name on the command line.
            journal: Path of the journal. One that exists keeps its own ``evaluate_every``.
            configuration: Name of the learner's configuration.
            seed: Of the learner and the world.
            batch: Plans to carry out side by side.
            evaluate_every: Movements between evaluations.
            warm_start: Journal of another run of the same task whose trials are observed first.

        Raises:
            JournalError: If the journal has another run, or one of the two cannot be used.
            SgimError: If the learner cannot be made, as `learner` says.
        """
        learner = self.learner(name, configuration=configuration, seed=seed)
        about = {} if warm_start is None else {"warm_start": str(warm_start)}
        exists = Path(journal).exists()
        if exists:
            self.require_same(journal, learner, batch, warm_start)
            evaluate_every = header_of(journal).get("evaluate_every", evaluate_every)
        elif warm_start is not None:
            Journal.open(warm_start, learner.task, append=False).close()
        run = self.run(learner, journal, batch=batch, evaluate_every=evaluate_every, about=about)
        if warm_start is not None and not exists:
            run.warm_start(warm_start)
        return run

    def require_same(
        self,
        journal: str | Path,
        learner: Learner,
        batch: int = 1,
        warm_start: str | Path | None = None,
    ) -> None:
        """Check that a journal has the run of such a learner.

        Raises:
            JournalError: If it has another; the message says the first difference.
        """
        header, recipe = header_of(journal), learner.recipe or {}
        recorded = header.get("recipe") or {}
        pairs = {
            "experiment": (header.get("experiment"), self.name),
            "learner": (header.get("learner"), self.label(learner)),
            "seed": (recorded.get("seed"), recipe.get("seed")),
            "configuration": (
                (recorded.get("configuration") or {}).get("name"),
                (recipe.get("configuration") or {}).get("name"),
            ),
            "batch": (header.get("batch"), batch),
            "warm start": (
                header.get("warm_start"),
                None if warm_start is None else str(warm_start),
            ),
        }
        for what, (there, here) in pairs.items():
            if there != here:
                raise JournalError(
                    f"{journal} has another run: its {what} is {there}, but here it is {here}; "
                    f"choose another path, or go on with it as it is (`sgim resume {journal}`)"
                )

    def resume(self, journal: str | Path, *, adopt: bool = False) -> Run:
        """A recorded run of this experiment, made again from its journal.

        Args:
            journal: Its path.
            adopt: Whether to adopt decisions that come out differently now.

        Raises:
            JournalError: If it cannot be read, or does not say how its learner is made.
            MismatchError: If a decision comes out differently and is not adopted.
        """
        header = header_of(journal)
        if header.get("recipe") is None:
            raise JournalError(
                f"{journal} does not say how its learner is made; go on with it from Python: "
                "sgim.Run(learner, environment, teachers, journal=…)"
            )
        learner = algorithms.from_recipe(self.environment().task, header["recipe"])
        about = {"warm_start": header["warm_start"]} if "warm_start" in header else {}
        return self.run(
            learner,
            journal,
            batch=header["batch"],
            evaluate_every=header["evaluate_every"],
            adopt=adopt,
            about=about,
        )


def evaluation_interval(movements: int, most: int = 1000) -> int:
    """Movements between evaluations: ``most`` or less, a quarter of the run or less.

    It divides the run evenly where that is possible, so that the last evaluation is at its end.
    """
    least = max(4, -(-movements // most))
    even = (movements // parts for parts in range(least, 2 * least) if movements % parts == 0)
    return next(even, max(1, movements // least))
