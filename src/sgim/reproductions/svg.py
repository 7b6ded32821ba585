"""Figures as SVG within a page: they follow its light and its dark colours."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_THEMED = {
    "#000000": "currentColor",
    "#e5e5e5": "var(--line)",
    "#4d4d4d": "var(--grey-dark)",
    "#a6a6a6": "var(--grey)",
    "#d9d9d9": "var(--grey-light)",
}
"""Colours that must differ on a dark page."""


def standalone(figure: Figure) -> str:
    """The figure as an SVG file, the same for the same figure."""
    from matplotlib import rc_context

    stream = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "sgim"}):
        figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None})
    return stream.getvalue()


def inline(drawn: str, title: str, prefix: str, class_: str) -> str:
    """An SVG file's drawing as an element of a page.

    Args:
        drawn: The file's text.
        title: What it shows, for who cannot see it.
        prefix: Of the names within it, so that those of two figures do not meet.
        class_: The element's class.
    """
    body = drawn[drawn.index("<svg") :]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.DOTALL)
    body = re.sub(r'\bid="', f'id="{prefix}-', body)
    body = re.sub(r'(url\(#|href="#)', rf"\g<1>{prefix}-", body)
    for colour, themed in _THEMED.items():
        body = re.sub(colour, themed, body, flags=re.IGNORECASE)
    found = re.search(r'<svg[^>]*?viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*>', body)
    assert found is not None
    width, height = found.groups()
    opened = (
        f'<svg class="{class_}" viewBox="0 0 {width} {height}" role="img" aria-label="{title}" '
        f'style="max-width: {float(width) * 1.5:.0f}px" xmlns:xlink="http://www.w3.org/1999/xlink">'
    )
    return opened + body[found.end() :].strip()
