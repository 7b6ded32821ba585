"""Tables and numbers as text."""

from __future__ import annotations

import shlex
from collections.abc import Container, Mapping, Sequence
from pathlib import Path
from typing import Any

from sgim.experiments.recognition_benchmark import TAKEN_FOR
from sgim.runs.summary import RecordedRun
from sgim.spaces import Box, Space

MOST_ROWS = 12
"""Rows of a table of evaluations; of more, every so manieth is shown, up to the last."""


def table(
    rows: Sequence[Sequence[str]],
    *,
    right: bool = False,
    words: Container[int] = (),
    indent: str = "  ",
) -> str:
    """Rows as lines with aligned columns.

    Args:
        rows: The cells.
        right: Whether all columns but the first are aligned at the right.
        words: Columns that are not, because they hold words.
        indent: What each line begins with.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = [
            cell.rjust(width) if right and i and i not in words else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append((indent + "  ".join(cells)).rstrip())
    return "\n".join(lines)


def evaluations(run: RecordedRun, unit: str = "") -> str:
    """The table of a run's errors; empty if it was never evaluated."""
    if not run.evaluations:
        return ""
    kinds = [k for k in run.evaluations[-1].errors if not k.startswith(TAKEN_FOR)]
    every = -(-len(run.evaluations) // MOST_ROWS)
    rows = [["movements", *kinds]]
    for evaluation in run.evaluations[::-every][::-1]:
        errors = [f"{evaluation.errors[kind]:#.3g}" for kind in kinds]
        rows.append([str(evaluation.movements), *errors])
    return f"errors{f' ({unit})' if unit else ''}\n{table(rows, right=True)}"


def choices(run: RecordedRun) -> str:
    """The table of a run's choices by quarter."""
    quarters = run.choices
    rows = [["", "1st quarter", "2nd", "3rd", "4th"]]
    for key, title in (("modes", "mode"), ("kinds", "goal")):
        names = sorted({name for quarter in quarters for name in quarter[key]})
        for name in names:
            shares = (f"{q[key][name]:.0%}" if name in q[key] else "–" for q in quarters)
            rows.append([f"{title} {name}", *shares])
    return f"shares of the episodes begun\n{table(rows, right=True)}"


def troubles(run: RecordedRun) -> str:
    """One line on plans that ended without an outcome; empty if there were none."""
    if not run.troubles:
        return ""
    words = {"declined": "requests declined or not usable"}
    counts = (f"{count} {words.get(how, how)}" for how, count in sorted(run.troubles.items()))
    return f"without an outcome: {', '.join(counts)}"


def coordinates(space: Space, point: Any, spread: Sequence[float] | None = None) -> list[list[str]]:
    """A point as rows ``[name, value with unit]``, with ± its spread if that is given."""
    if not isinstance(space, Box):
        return [["label", str(point)]]
    rows = []
    for i, (name, unit) in enumerate(zip(space.names, space.units, strict=True)):
        about = "" if spread is None else f" ± {spread[i]:.2g}"
        rows.append([name, f"{point[i]:.4g}{about}{f' {unit}' if unit else ''}"])
    return rows


def example_goal(spaces: Mapping[str, Space]) -> str:
    """A goal as it is written on the command line, to show how."""
    kind, space = next(iter(spaces.items()))
    if isinstance(space, Box):
        return f"{kind}={','.join(f'{x:.3g}' for x in (space.low + space.high) / 2)}"
    labels = getattr(space, "labels", ("LABEL",))
    return f"{kind}={labels[0]}"


def shell(*words: str | Path) -> str:
    """A command as it can be pasted into a shell."""
    return shlex.join(map(str, words))


def demonstrations_every(configuration: str, movements: int | None) -> str:
    """A configuration, with a demonstration every so many movements if that is said."""
    if movements is None:
        return configuration
    return f"{configuration},demonstration_every={movements}"
