"""``sgim resume``: go on with a run."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.going import go, say_finished
from sgim.cli.text import shell
from sgim.errors import JournalError, MismatchError, SgimError
from sgim.experiments import experiment as find_experiment
from sgim.runs.summary import read_run


def command(
    path: Annotated[Positional[Path], arg(metavar="PATH")],
    movements: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: as it was begun)")
    ] = None,
    adopt: bool = False,
) -> int:
    """Go on with a run that was stopped, or extend one that is finished.

    It goes on exactly as if it had never stopped. If another version of a library, or another
    processor, decides otherwise than is recorded, it says so and stops; with --adopt it then
    keeps every trial, takes the recorded decisions as they are, and goes on from there.

    Examples:
      sgim resume runs/throwing-sgim-acts-0.sgim
      sgim resume runs/throwing-sgim-acts-0.sgim --movements 16000

    Args:
        path: The journal of the run.
        movements: How many movements to make in all, those already made included.
        adopt: Take recorded decisions as they are where they come out differently now.
    """
    recorded = read_run(path)
    if recorded.experiment is None:
        raise JournalError(
            f"{path} is of no experiment that sgim knows; go on with it from Python: "
            "sgim.Run(learner, environment, teachers, journal=…)"
        )
    if movements is None and recorded.finished:
        say_finished(recorded)
        return 0
    target = movements if movements is not None else recorded.target
    if target is None:
        raise SgimError(f"{path} was never begun; say how many movements to make: --movements N")
    if movements is not None and movements <= recorded.movements:
        raise SgimError(
            f"{path} has {recorded.movements} movements already; --movements counts them all, so "
            f"give more than that"
        )
    try:
        run = find_experiment(recorded.experiment).resume(path, adopt=adopt)
    except MismatchError as error:
        print(
            f"sgim: {path} cannot be resumed exactly: {error}.\nAnother version of a library or "
            "another processor wrote it. To keep every trial, take the recorded decisions as they "
            f"are, and go on:\n  {shell('sgim', 'resume', path, '--adopt')}",
            file=sys.stderr,
        )
        return 1
    if run.difference is not None:
        print(f"adopted the recorded decisions: {run.difference}", file=sys.stderr)
    return go(run, path, target)
