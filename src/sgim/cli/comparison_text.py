"""A comparison as two tables: coloured on a terminal, plain elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from sgim.cli.statistics_text import print_notes, print_table
from sgim.experiments import EXPERIMENTS
from sgim.runs.comparison import Comparison
from sgim.runs.contrasts import Contrast, Group
from sgim.statistics.words import interval, number

_COLOURS = {"lower": "green", "higher": "red", "equivalent": "cyan"}


def print_comparison(found: Comparison, stream: TextIO) -> None:
    """Print what was compared, each learner, each against the reference, and the notes."""
    experiment = EXPERIMENTS.get(found.experiment or "")
    unit = f" ({experiment.unit})" if experiment else ""
    title = f"{found.experiment or 'runs'}, {found.kind} error{unit}"
    print(f"{title} at {found.movements[-1]:.0f} movements\n", file=stream)
    print_table(_group_rows(found.groups), stream)
    if found.contrasts:
        print(
            f"\nagainst {found.reference} (equivalent: within {found.margin:.0%} of the larger)\n",
            file=stream,
        )
        print_table(_contrast_rows(found.contrasts), stream, _COLOURS)
    print_notes(found.notes, stream)


def _group_rows(groups: Sequence[Group]) -> list[list[str]]:
    rows = [["learner", "runs", "median", "IQM [95 %]", "area under curve [95 %]"]]
    rows += [
        [g.name, str(len(g.runs)), number(g.median), interval(g.middle), interval(g.area)]
        for g in groups
    ]
    return rows


def _contrast_rows(contrasts: Sequence[Contrast]) -> list[list[str]]:
    names = "learner|runs|difference [95 %]|ratio [95 %]|p|Holm|lower in|r|verdict"
    rows = [names.split("|")]
    for c in contrasts:
        one, other = c.counts
        rows.append(
            [
                c.name,
                f"{one} pairs" if c.seeds is not None else f"{one}, {other}",
                interval(c.difference, "+"),
                interval(c.ratio),
                f"{c.p:.2g}",
                f"{c.p_holm:.2g}",
                f"{c.lower:.0%}",
                f"{c.rank_biserial:+.2f}",
                c.verdict,
            ]
        )
    return rows
