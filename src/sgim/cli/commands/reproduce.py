"""``sgim reproduce``: a chapter of the thesis made again, with a report."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.sweeping import Where, sweep_and_say
from sgim.cli.text import shell
from sgim.errors import SgimError
from sgim.experiments.sweep_plan import parse_seeds, plan
from sgim.reproductions import reproduction
from sgim.reproductions.page import page
from sgim.reproductions.result import Result, conclude


def command(
    chapter: Annotated[Positional[str], arg(metavar="CHAPTER")],
    seeds: Annotated[
        str | None, arg(metavar="0-19", help_behavior_hint="(default: the chapter's)")
    ] = None,
    quick: bool = False,
    worlds: bool = False,
    out: Annotated[
        Path | None, arg(metavar="DIR", help_behavior_hint="(default: reproductions/CHAPTER)")
    ] = None,
    where: Annotated[Where, arg(name="")] = Where(),  # noqa: B008 - frozen
) -> int:
    """Make a chapter of the thesis again: its runs, its figures, its claims, and a report.

    Everything is in one folder: report.html, which needs no network and no other file; claims.json
    with the verdicts; figures as SVG; and the journals. What is in the folder already is not run
    again: after a stop, give the same command again. A run that fails is left out, and reported.

    Examples:
      sgim reproduce throwing --quick
      sgim reproduce throwing --seeds 0-19 --worlds --out reproductions/throwing

    Args:
        chapter: throwing, hockey, …; a name that is not known is answered with all that are.
        seeds: Seeds, such as 0-19 or 0,3,5-7.
        quick: A first look: few seeds, short runs, and only the first configuration.
        worlds: Also run in other plausible worlds, and count in how many each claim holds.
        out: The folder.
        where: Where the runs are made.
    """
    it = reproduction(chapter)
    folder = out or Path("reproductions") / (f"{chapter}-quick" if quick else chapter)
    chosen = None if seeds is None else parse_seeds(seeds)
    main, others = it.to_run(chosen, quick=quick, worlds=worlds)
    planned = plan([*main, *others])
    swept = sweep_and_say(it.name, planned, folder / "runs", where)
    if not swept.runs:
        return swept.code
    words = ["sgim", "reproduce", chapter, *(["--seeds", seeds] if seeds else [])]
    words += [*(["--quick"] if quick else []), *(["--worlds"] if worlds else [])]
    print("deciding and drawing …", file=sys.stderr)
    result = conclude(
        it,
        swept.runs,
        main,
        others,
        command=shell(*words, "--out", folder),
        quick=quick,
    )
    _write(result, folder)
    print(f"report   {folder / 'report.html'}")
    print(f"claims   {folder / 'claims.json'}")
    print(f"figures  {folder / 'figures'}")
    return swept.code


def _write(result: Result, folder: Path) -> None:
    figures = folder / "figures"
    try:
        figures.mkdir(parents=True, exist_ok=True)
        for section in result.sections:
            for picture in section.pictures:
                if picture.wide:
                    name = f"{section.experiment}-{section.configuration}-{picture.drawing.name}"
                    (figures / f"{name}.svg").write_text(picture.wide, "utf-8")
        claims = json.dumps(result.claims, indent=1, ensure_ascii=False)
        (folder / "claims.json").write_text(claims + "\n", "utf-8")
        made = time.strftime("%d %B %Y")
        (folder / "report.html").write_text(page(result, made), "utf-8")
    except OSError as error:
        raise SgimError(
            f"{folder} cannot be written ({error.strerror}); choose another --out"
        ) from error
