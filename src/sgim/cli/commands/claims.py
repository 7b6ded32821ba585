"""``sgim claims``: what is claimed of learners, and whether runs bear it out."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.claims import CHAPTERS, chapter, report
from sgim.cli.claims_text import print_chapter, print_report
from sgim.runs.summary import find_journals


def command(
    chapters: Annotated[
        Positional[tuple[str, ...]], arg(metavar="CHAPTER…", help_behavior_hint="(default: all)")
    ] = (),
    runs: Annotated[
        Path | None, arg(metavar="DIR", help_behavior_hint="(default: only list the claims)")
    ] = None,
    configuration: Annotated[
        str | None, arg(metavar="NAME", help_behavior_hint="(default: each that has runs)")
    ] = None,
    at: Annotated[
        int | None,
        arg(metavar="MOVEMENTS", help_behavior_hint="(default: the last evaluation that all have)"),
    ] = None,
    by: Annotated[
        str | None,
        arg(metavar="WAY", help_behavior_hint="(default: as the runs were measured)"),
    ] = None,
    seed: int = 0,
    details: bool = False,
    as_json: Annotated[bool, arg(name="json")] = False,
) -> None:
    """Decide, claim by claim, what runs say of the thesis's findings and of its controls.

    Without --runs it lists the claims as they are declared, with the tests that must all hold for
    each, and the sweep that makes the runs they need.

    With --runs there is a table for each experiment and configuration. A claim is reproduced if
    all its tests point its way and the largest of their p-values, corrected by Holm for the number
    of claims, is under .05; not shown if that p is not; contradicted if a test points the other
    way. Shown is the test that decides: the weakest, or the one most clearly against. Its effect
    is the ratio (×) of the errors or the difference of the shares in percentage points. A claim
    whose learners have no runs says which it needs.

    Variants of an experiment, and configurations with settings that differ, are plausible worlds:
    where there are several, a last table counts in how many each claim holds: there, p-values are
    not corrected.

    Examples:
      sgim claims throwing
      sgim sweep throwing --learners sgim-acts,demonstrations-first --seeds 0-19 --out runs/s
      sgim sweep throwing-5 --learners sgim-acts,demonstrations-first --seeds 0-19 --out runs/s
      sgim claims throwing --runs runs/s
      sgim claims throwing --runs runs/s --configuration modern --details
      sgim claims --runs runs/s --json --details

    Args:
        chapters: Chapters whose claims to decide.
        runs: Directory of journals, as sgim sweep writes them.
        configuration: Only runs of this configuration, and of it with other settings.
        at: Decide at this evaluation; runs that have not got there are left out.
        by: Measure the runs again by this way of answering, such as nearest or reliable; what is
            found is kept beside the journals.
        seed: Of the bootstrap.
        details: Also print each claim's sentence and all its tests; in JSON, all tests with the
            numbers of each run.
        as_json: Print JSON.
    """
    chosen = [chapter(name) for name in dict.fromkeys(chapters or CHAPTERS)]
    if runs is None:
        for one in chosen:
            print_chapter(one, sys.stdout)
        return
    found = report(
        find_journals([runs]), chosen, configuration=configuration, at=at, by=by, seed=seed
    )
    if as_json:
        print(json.dumps(found.as_json(details=details), indent=1, ensure_ascii=False))
        return
    print_report(found, sys.stdout, details=details)
