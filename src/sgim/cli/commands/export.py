"""``sgim export``: runs as tables."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.runs.parquet import write_parquet
from sgim.runs.summary import find_journals


def command(
    paths: Annotated[Positional[list[Path]], arg(metavar="PATH…")],
    parquet: Annotated[Path, arg(metavar="DIR")],
) -> None:
    """Export runs as tidy tables in Parquet, three files an experiment.

    NAME-trials       a row a trial: its episode, mode, policy and outcome
    NAME-episodes     a row an episode: mode and goal chosen, goal pursued, competence
    NAME-evaluations  a row an evaluation and kind of goal: the error

    Each row says of which run, learner, configuration and seed it is.

    Examples:
      sgim export runs/throwing --parquet tables
      sgim export runs/throwing-sgim-acts-0.sgim --parquet tables

    Args:
        paths: Journals, or directories of journals.
        parquet: Directory of the tables; tables of the same name are replaced.
    """
    for file in write_parquet(find_journals(paths), parquet):
        print(file)
