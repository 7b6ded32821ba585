"""HTML by hand: tags, text and tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def text(words: object) -> str:
    """Words as they are, whatever characters they have."""
    return escape(str(words))


def tag(name: str, *inside: str, **attributes: str | bool) -> str:
    """An element around HTML; ``class_`` is its class, a true attribute has no value."""
    given = []
    for key, value in attributes.items():
        key = key.rstrip("_").replace("_", "-")
        if value is True:
            given.append(f" {key}")
        elif value is not False:
            given.append(f' {key}="{escape(str(value))}"')
    return f"<{name}{''.join(given)}>{''.join(inside)}</{name}>"


def paragraph(words: object) -> str:
    """A paragraph of text."""
    return tag("p", text(words))


def table(
    columns: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "", class_: str = ""
) -> str:
    """A table of cells that are HTML; on a narrow screen each row is a card.

    Args:
        columns: Names of the columns, as text; the first column names the rows.
        rows: The cells.
        caption: What it shows, as text.
        class_: Its class.
    """
    head = tag("tr", *(tag("th", text(name), scope="col") for name in columns))
    body = []
    for first, *rest in rows:
        cells = [tag("th", first, scope="row")]
        cells += [
            tag("td", cell, data_label=name) for name, cell in zip(columns[1:], rest, strict=True)
        ]
        body.append(tag("tr", *cells))
    parts = [tag("caption", text(caption))] if caption else []
    parts += [tag("thead", head), tag("tbody", *body)]
    return tag("div", tag("table", *parts, class_=class_), class_="wide")
