"""``sgim plot``: figures of runs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from tyro.conf import Positional, arg

from sgim.errors import SgimError
from sgim.figures import (
    choices,
    choices_by_kind,
    error_curves,
    errors_by_world,
    explored,
    of_worlds,
    performance_profiles,
    places,
    progress,
)
from sgim.figures.curves import Band
from sgim.figures.style import NothingToDrawError
from sgim.runs.costs import Prices
from sgim.runs.summary import RecordedRun, find_journals, read_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def command(
    paths: Annotated[Positional[list[Path]], arg(metavar="PATH…")],
    out: Annotated[Path, arg(metavar="DIR")] = Path("figures"),
    format: Literal["png", "svg"] = "png",  # noqa: A002 - its name on the command line
    each: bool = False,
    band: Band = "interval",
    robot_seconds: Annotated[float, arg(metavar="SECONDS")] = Prices.robot_seconds,
    person_seconds: Annotated[float, arg(metavar="SECONDS")] = Prices.person_seconds,
) -> None:
    """Draw runs: how errors fall, what is chosen over time, and what has been explored.

    NAME-errors     errors over movements, a line with a band for each learner
    NAME-costs      the same over the time of robot and persons, if anybody was asked
    NAME-profiles   share of a learner's runs whose last error is at most so much
    NAME-choices    modes and kinds of goal chosen over time, all seeds together
    NAME-strategies modes chosen for each kind of goal, by learners that choose both
    NAME-progress   modes chosen over time, and what each gained per movement
    NAME-outcomes   how often each learner's movements ended where
    NAME-goals      how often each learner aimed where
    RUN-explored    what has been explored, for one run of each learner, or for --each

    If there are runs of several experiments, also:
    errors-by-world total errors over movements, a panel for each experiment

    Where objects are recognised, also:
    NAME-recognised pictures recognised over episodes
    RUN-f-measures  how well each object is told apart, and which was manipulated
    NAME-toys       the objects from four sides
    NAME-pictures   some of the pictures by which recognition is measured

    Of vocal runs also:
    NAME-classes    classes of sounds over time in all runs, and the stages counted
    RUN-stages      the same of one run, with the types of sounds in each stage
    RUN-densities   goals, commands and sounds over time
    RUN-sounds      early and mature sounds, and those of the ambient language

    The line is the interquartile mean of the runs and the band its 95 % bootstrap interval at
    each evaluation; with --band quartiles, the median and the quartiles. sgim compare says
    whether learners differ.

    Examples:
      sgim plot runs/throwing-sgim-acts-0.sgim
      sgim plot runs/throwing --out figures --format svg

    Args:
        paths: Journals, or directories of journals.
        out: Directory of the figures; figures of the same name are replaced.
        format: Format of the figures.
        each: Draw what has been explored for each run.
        band: What lines and bands of errors are.
        robot_seconds: What a movement costs where the journal does not say.
        person_seconds: What a request costs, once answered, where the journal does not say.
    """
    prices = Prices(robot_seconds, person_seconds)
    groups: dict[str, list[RecordedRun]] = {}
    for path in find_journals(paths):
        run = read_run(path)
        groups.setdefault(run.experiment or "runs", []).append(run)
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SgimError(f"{out} cannot be made ({error.strerror}); choose another --out") from error
    drawings: list[tuple[str, Callable[[], Figure]]] = []
    if len(groups) > 1:
        everything = [run for runs in groups.values() for run in runs]
        drawings.append(("errors-by-world", partial(errors_by_world, everything, band=band)))
    for name, runs in groups.items():
        stem = runs[0].path.stem if len(runs) == 1 else name
        chosen = [run.path for run in runs] if each else _one_of_each_learner(runs)
        drawings += [
            (f"{stem}-errors", partial(error_curves, runs, band=band)),
            (f"{stem}-costs", partial(error_curves, runs, band=band, prices=prices)),
            *([(f"{stem}-profiles", partial(performance_profiles, runs))] if len(runs) > 1 else []),
            (f"{stem}-choices", partial(choices, runs)),
            (f"{stem}-strategies", partial(choices_by_kind, runs)),
            (f"{stem}-progress", partial(progress, runs)),
            (f"{stem}-outcomes", partial(places, runs, "outcomes")),
            (f"{stem}-goals", partial(places, runs, "goals")),
            *((f"{path.stem}-explored", partial(explored, path)) for path in chosen),
            *of_worlds.drawings(stem, runs, chosen),
        ]
    for title, draw in drawings:
        file = out / f"{title}.{format}"
        try:
            draw().savefig(file)
        except NothingToDrawError:
            continue
        except SgimError as error:
            print(f"no {file}: {error}", file=sys.stderr)
        except OSError as error:
            raise SgimError(
                f"{file} cannot be written ({error.strerror}); choose another --out"
            ) from error
        else:
            print(file)


def _one_of_each_learner(runs: list[RecordedRun]) -> list[Path]:
    first: dict[tuple[str | None, str | None], RecordedRun] = {}
    for run in sorted(runs, key=lambda run: run.seed or 0):
        first.setdefault((run.learner, run.configuration), run)
    return [run.path for run in first.values()]
