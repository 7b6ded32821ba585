"""Claims as text: what is declared, the tables of verdicts, and the counts over worlds."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TextIO

import numpy as np

from sgim.claims.claim import Chapter, Claim, Verdict, Verdicts
from sgim.claims.components import Finding
from sgim.claims.plausible import Plausible
from sgim.claims.report import Report
from sgim.claims.words import effect_words, holm_words, p_words
from sgim.cli.statistics_text import print_notes, print_table
from sgim.cli.text import shell, table
from sgim.statistics.words import number

_COLOURS = {"reproduced": "green", "contradicted": "red", "not": "yellow", "no": "dim"}

_WIDTH = 98

_SEEDS = "0-19"
"""Seeds that the listing proposes: twenty, for chapters with many claims."""


def print_chapter(chapter: Chapter, stream: TextIO) -> None:
    """Print the claims as declared, and how to make the runs they need."""
    print(f"{chapter.name}: {chapter.title}", file=stream)
    for claim in chapter.claims:
        _print_claim(claim, stream)
        print(table([[str(part)] for part in claim.components], indent=" " * 7), file=stream)
    folder = f"runs/{chapter.name}-claims"
    print("\nTo decide them:", file=stream)
    for (experiment, settings), learners in chapter.sweeps.items():
        sweep = ["sgim", "sweep", experiment, "--learners", ",".join(learners), "--seeds", _SEEDS]
        sweep += ["--configuration", f"modern,{settings}"] if settings else []
        print(f"  {shell(*sweep, '--out', folder)}", file=stream)
    print(f"  {shell('sgim', 'claims', chapter.name, '--runs', folder)}", file=stream)


def print_report(report: Report, stream: TextIO, *, details: bool) -> None:
    """Print a table for each world, the counts over worlds, and the notes.

    Args:
        report: The verdicts.
        stream: Where to.
        details: Whether to print each claim's sentence and all its components.
    """
    for i, verdicts in enumerate(report.verdicts):
        if i:
            print(file=stream)
        _print_verdicts(verdicts, stream, details)
    for plausible in report.plausible:
        _print_plausible(plausible, stream)
    print_notes(report.notes, stream)


def _print_verdicts(verdicts: Verdicts, stream: TextIO, details: bool) -> None:
    world = verdicts.world
    where = f"{world.experiment}, {world.configuration}, at {world.movements} movements"
    print(f"{where}: {verdicts.chapter.title}\n", file=stream)
    rows = [["claim", "verdict", "effect [95 %]", "p", "Holm", "seeds", "decided by"]]
    rows += [_row(verdict) for verdict in verdicts.verdicts]
    print_table(rows, stream, _COLOURS, ("verdict", "decided by"))
    if any(verdict.claim.by_construction for verdict in verdicts.verdicts):
        print("\n* holds almost by construction", file=stream)
    if details:
        for verdict in verdicts.verdicts:
            _print_claim(verdict.claim, stream)
            if verdict.findings:
                _print_components(verdict.findings, stream)
    print_notes(verdicts.notes, stream)


def _row(verdict: Verdict) -> list[str]:
    mark = " *" if verdict.claim.by_construction else ""
    begin = [verdict.claim.id, f"{verdict.word}{mark}"]
    if verdict.p_holm is None:
        return [*begin, "–", "–", "–", "–", f"needs {', '.join(verdict.needs)}"]
    f = verdict.deciding
    return [*begin, effect_words(f), p_words(f.p), holm_words(verdict), f.runs, str(f.component)]


def _print_claim(claim: Claim, stream: TextIO) -> None:
    indent = " " * 5
    said = f"{claim.id:5}{claim.sentence}"
    print("\n" + textwrap.fill(said, _WIDTH, subsequent_indent=indent), file=stream)
    if claim.reading:
        reading = textwrap.fill(
            f"({claim.reading})", _WIDTH, initial_indent=indent, subsequent_indent=indent
        )
        print(reading, file=stream)
    if claim.by_construction:
        print(f"{indent}It holds almost by construction.", file=stream)


def _print_components(findings: Sequence[Finding], stream: TextIO) -> None:
    rows = [["component", "one", "other", "effect [95 %]", "p", "seeds", "direction"]]
    for f in findings:
        one, other = (number(float(np.median(x))) if len(x) else "–" for x in (f.one, f.other))
        cells = [str(f.component), one, other, effect_words(f), p_words(f.p), f.runs]
        rows.append([*cells, f"{f.direction:+.2f}"])
    print_table(rows, stream)


def _print_plausible(plausible: Plausible, stream: TextIO) -> None:
    several = f"in {len(plausible.worlds)} plausible worlds"
    title = f"{plausible.chapter.name}, {plausible.configuration}, {several}: "
    title += ", ".join(plausible.worlds)
    print("\n" + textwrap.fill(title, _WIDTH, subsequent_indent="  ") + "\n", file=stream)
    rows = [["claim", "holds in", "elsewhere"]]
    for count in plausible.counts:
        elsewhere = "; ".join(f"{w}: {', '.join(names)}" for w, names in count.elsewhere.items())
        holds = f"{count.holds} of {len(count.words)}" if count.words else "no runs"
        rows.append([count.claim.id, holds, elsewhere])
    print_table(rows, stream, words=("elsewhere",))
    print("\n(holds: all its tests point its way, p < .05 before correction)", file=stream)
