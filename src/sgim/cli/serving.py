"""Keeping a page open until the user stops it."""

from __future__ import annotations

from sgim.web import Served


def keep_serving(page: Served) -> None:
    """Say where the page is, and serve it until Ctrl-C."""
    print(f"open  {page.url}\nstop  Ctrl-C", flush=True)
    try:
        page.wait()
    except KeyboardInterrupt:
        print()
