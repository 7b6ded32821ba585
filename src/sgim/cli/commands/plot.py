"""``sgim plot``: figures of runs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from tyro.conf import Positional, arg

from sgim.errors import SgimError
from sgim.figures import choices, error_curves, explored
from sgim.runs.summary import RecordedRun, find_journals, read_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def command(
    paths: Annotated[Positional[list[Path]], arg(metavar="PATH…")],
    out: Annotated[Path, arg(metavar="DIR")] = Path("figures"),
    format: Literal["png", "svg"] = "png",  # noqa: A002 - its name on the command line
    each: bool = False,
) -> None:
    """Draw runs: how errors fall, what is chosen over time, and what has been explored.

    Errors are medians over seeds with a band between the quartiles, a line for each learner.
    What has been explored is drawn for one run of each learner, or for each run with --each.

    Examples:
      sgim plot runs/throwing-sgim-acts-0.sgim
      sgim plot runs/throwing --out figures --format svg

    Args:
        paths: Journals, or directories of journals.
        out: Directory of the figures; figures of the same name are replaced.
        format: Format of the figures.
        each: Draw what has been explored for each run.
    """
    groups: dict[str, list[RecordedRun]] = {}
    for path in find_journals(paths):
        run = read_run(path)
        groups.setdefault(run.experiment or "runs", []).append(run)
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SgimError(f"{out} cannot be made ({error.strerror}); choose another --out") from error
    for name, runs in groups.items():
        stem = runs[0].path.stem if len(runs) == 1 else name
        journals = [run.path for run in runs]
        chosen = journals if each else _one_of_each_learner(runs)
        drawings: list[tuple[str, Callable[[], Figure]]] = [
            (f"{stem}-errors", partial(error_curves, journals)),
            (f"{stem}-choices", partial(choices, journals)),
            *((f"{path.stem}-explored", partial(explored, path)) for path in chosen),
        ]
        for title, draw in drawings:
            file = out / f"{title}.{format}"
            try:
                draw().savefig(file)
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
