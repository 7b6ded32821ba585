"""Tables of statistics and their notes: coloured on a terminal, plain elsewhere."""

from __future__ import annotations

import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TextIO

from sgim.cli.text import table


def print_notes(notes: Iterable[str], stream: TextIO) -> None:
    """Print what a reader should know, each note a paragraph."""
    for note in notes:
        print("\n" + textwrap.fill(f"note: {note}", 98, subsequent_indent="  "), file=stream)


def print_table(
    rows: Sequence[Sequence[str]],
    stream: TextIO,
    colours: Mapping[str, str] | None = None,
    words: Collection[str] = (),
) -> None:
    """Print a table, its first row the names of the columns; all but words at the right.

    Args:
        rows: The cells.
        stream: Where to.
        colours: First word of a verdict → the colour in which it is drawn on a terminal.
        words: Names of the columns of words, besides the first, aligned at the left.
    """
    if not stream.isatty():
        at_left = {i for i, name in enumerate(rows[0]) if name in words}
        print(table(rows, right=True, words=at_left), file=stream)
        return
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    left = {"verdict", *words}
    shown = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for i, name in enumerate(rows[0]):
        shown.add_column(name, justify="left" if i == 0 or name in left else "right")
    for row in rows[1:]:
        cells = [
            Text(cell, style=(colours or {}).get(cell.partition(" ")[0], ""))
            if name == "verdict"
            else Text(cell)
            for name, cell in zip(rows[0], row, strict=True)
        ]
        shown.add_row(*cells)
    Console(file=stream).print(shown)
