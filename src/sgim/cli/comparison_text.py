"""A comparison as two tables: coloured on a terminal, plain elsewhere."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TextIO

from sgim.cli.text import table
from sgim.experiments import EXPERIMENTS
from sgim.runs.comparison import Comparison
from sgim.runs.contrasts import Contrast, Group
from sgim.statistics import Estimate

_COLOURS = {"lower": "green", "higher": "red", "equivalent": "cyan"}


def print_comparison(found: Comparison, stream: TextIO) -> None:
    """Print what was compared, each learner, each against the reference, and the notes."""
    experiment = EXPERIMENTS.get(found.experiment or "")
    unit = f" ({experiment.unit})" if experiment else ""
    title = f"{found.experiment or 'runs'}, {found.kind} error{unit}"
    print(f"{title} at {found.movements[-1]:.0f} movements\n", file=stream)
    _print_table(_group_rows(found.groups), stream)
    if found.contrasts:
        print(
            f"\nagainst {found.reference} (equivalent: within {found.margin:.0%} of the larger)\n",
            file=stream,
        )
        _print_table(_contrast_rows(found.contrasts), stream)
    for note in found.notes:
        print("\n" + textwrap.fill(f"note: {note}", 98, subsequent_indent="  "), file=stream)


def _group_rows(groups: Sequence[Group]) -> list[list[str]]:
    rows = [["learner", "runs", "median", "IQM [95 %]", "area under curve [95 %]"]]
    rows += [
        [g.name, str(len(g.runs)), _number(g.median), _interval(g.middle), _interval(g.area)]
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
                _interval(c.difference, "+"),
                _interval(c.ratio),
                f"{c.p:.2g}",
                f"{c.p_holm:.2g}",
                f"{c.lower:.0%}",
                f"{c.rank_biserial:+.2f}",
                c.verdict,
            ]
        )
    return rows


def _number(value: float, sign: str = "") -> str:
    return f"{value:{sign}.3g}" if value == value else "–"


def _interval(estimate: Estimate, sign: str = "") -> str:
    value, low, high = (float(x) for x in (estimate.value, estimate.low, estimate.high))
    if low != low:
        return _number(value, sign)
    return f"{_number(value, sign)} [{_number(low)}, {_number(high)}]"


def _print_table(rows: Sequence[Sequence[str]], stream: TextIO) -> None:
    if not stream.isatty():
        print(table(rows, right=True), file=stream)
        return
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    shown = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for i, name in enumerate(rows[0]):
        last_words = name == "verdict"
        shown.add_column(name, justify="left" if i == 0 or last_words else "right")
    for row in rows[1:]:
        *cells, last = row
        colour = _COLOURS.get(last.partition(" ")[0], "")
        shown.add_row(*cells, Text(last, style=colour))
    Console(file=stream).print(shown)
