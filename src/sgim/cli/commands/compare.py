"""``sgim compare``: which learner is better, and whether seeds could have decided that."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.comparison_text import print_comparison
from sgim.runs.comparison import compare
from sgim.runs.measured import read_measured
from sgim.runs.summary import find_journals


def command(
    paths: Annotated[Positional[list[Path]], arg(metavar="PATH…")],
    kind: Annotated[str, arg(metavar="KIND")] = "total",
    at: Annotated[
        int | None,
        arg(metavar="MOVEMENTS", help_behavior_hint="(default: the last evaluation that all have)"),
    ] = None,
    against: Annotated[
        str | None,
        arg(metavar="LEARNER", help_behavior_hint="(default: sgim-acts, or else the lowest)"),
    ] = None,
    margin: Annotated[float, arg(metavar="SHARE")] = 0.2,
    seed: int = 0,
    as_json: Annotated[bool, arg(name="json")] = False,
) -> None:
    """Compare learners over seeds: their errors, and whether a difference could be chance.

    The first table has each learner by itself: median and interquartile mean (IQM) of its runs'
    errors, and the area under its learning curve; in brackets, 95 % bootstrap intervals.

    The second has each learner against one of them, paired by seed where seeds are the same: the
    difference and the ratio of the IQMs, the p-value of Wilcoxon's signed-rank test, the same
    corrected by Holm for the number of comparisons, how often the learner's error is the lower
    one, and the rank-biserial effect size r, from -1 (always lower) to 1. Equivalent are learners
    that differ by less than the margin, by two one-sided tests. What is neither is undecided: that
    is no sign of equality, but of too few runs.

    Examples:
      sgim sweep throwing --learners sgim-acts,sagg-riac,random --seeds 0-9 --out runs/throwing
      sgim compare runs/throwing
      sgim compare runs/throwing --kind place --against random --at 4000
      sgim compare runs/throwing --json

    Args:
        paths: Journals, or directories of journals, of one experiment.
        kind: Kind of goal whose errors are compared, or total, the mean of the kinds.
        at: Compare at this evaluation; runs that have not got there are left out.
        against: The learner to compare the others with.
        margin: By which share of the larger error equivalent learners may differ.
        seed: Of the bootstrap.
        as_json: Print JSON with everything, also curves, profiles and the errors of each run.
    """
    runs = [read_measured(path) for path in find_journals(paths)]
    found = compare(runs, kind=kind, at=at, against=against, margin=margin, seed=seed)
    if as_json:
        print(json.dumps(found.as_json(), indent=2, ensure_ascii=False))
        return
    print_comparison(found, sys.stdout)
