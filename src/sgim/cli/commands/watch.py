"""``sgim watch``: a page that shows what runs do."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.serving import keep_serving
from sgim.errors import SgimError
from sgim.runs.summary import find_journals

MOST_RUNS = 12


def command(
    runs: Annotated[Positional[tuple[Path, ...]], arg(metavar="RUN…")],
    teach: bool = False,
    port: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: 7446)")] = None,
    expose: Annotated[
        str | None, arg(metavar="ADDRESS", help_behavior_hint="(default: this machine only)")
    ] = None,
) -> None:
    """Serve a page that shows what runs do: finished ones, and those that go on meanwhile.

    Open the address that is printed. It shows errors, what is explored, what is chosen, and the
    best movement for a goal that you click.

    Examples:
      sgim watch runs/throwing-sgim-acts-0.sgim
      sgim watch runs

    Args:
        runs: Journals, or folders of journals.
        teach: Also teach the first of them, a run begun by sgim teach that goes on elsewhere.
        port: Where to listen.
        expose: An address of this machine that others can reach; read docs/security.md first.
    """
    from sgim.web import serve

    journals = find_journals(list(runs))
    if len(journals) > MOST_RUNS:
        raise SgimError(f"{len(journals)} runs were found; a page shows {MOST_RUNS} at most")
    with serve(*journals, teach=teach, port=port, expose=expose) as page:
        keep_serving(page)
