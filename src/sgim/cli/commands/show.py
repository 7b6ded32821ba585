"""``sgim show``: what a run did."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.going import report
from sgim.cli.text import shell
from sgim.runs.summary import read_run


def command(
    path: Annotated[Positional[Path], arg(metavar="PATH")],
    as_json: Annotated[bool, arg(name="json")] = False,
) -> None:
    """Show what a run did: its errors, and its choices in each quarter. Also while it goes on.

    The choices are shares of the episodes begun: of the modes, and of the kinds of their goals.
    Quarters are of the movements that the run was last asked for.

    Examples:
      sgim show runs/throwing-sgim-acts-0.sgim
      sgim show runs/throwing-sgim-acts-0.sgim --json

    Args:
        path: The journal of the run.
        as_json: Print JSON: experiment, learner, configuration, seed, movements, finished,
            evaluations, choices.
    """
    recorded = read_run(path)
    if as_json:
        print(json.dumps(recorded.summary(), indent=2))
        return
    made = f"{recorded.movements} movements, finished"
    if not recorded.finished:
        made = f"{recorded.movements} of {recorded.target or '?'} movements"
    named = [recorded.experiment, recorded.learner, recorded.configuration]
    title = ", ".join(str(name) for name in named if name is not None)
    seed = "" if recorded.seed is None else f", seed {recorded.seed}"
    print(f"{title or recorded.path}{seed}: {made}\n")
    report(recorded)
    if not recorded.finished and recorded.experiment is None:
        print("\nIf it is not going on now: run the script that made it again")
    elif not recorded.finished:
        print(f"\nIf it is not going on now: {shell('sgim', 'resume', path)}")
