"""Serving the page from a thread of this process."""

from __future__ import annotations

import ipaddress
import socket
import sys
import threading
import time
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

from sgim.errors import SgimError
from sgim.runs.run import Run
from sgim.web.guard import Guard
from sgim.web.lesson import Lesson
from sgim.web.protocol import LARGEST_MESSAGE
from sgim.web.regions import folded, regions_of
from sgim.web.scenes import Scene, scene_of
from sgim.web.watching import Watched

PORT = 7446
"""Tried first, so that what a browser keeps for the page is found again; S-G-I-M on a telephone."""

LOOPBACK = "127.0.0.1"


class Served:
    """A page that is being served, until `close`; ``with`` closes it.

    Attributes:
        url: Where a browser finds it. Who knows it can watch, and take control.
        journals: What it shows.
    """

    def __init__(
        self, server: Any, thread: threading.Thread, url: str, journals: list[Path]
    ) -> None:
        self.url = url
        self.journals = journals
        self._server = server
        self._thread = thread

    def wait(self) -> None:
        """Serve until it is closed, or the process is interrupted."""
        while self._thread.is_alive():
            self._thread.join(0.5)

    def close(self) -> None:
        """Stop serving."""
        self._server.should_exit = True
        self._thread.join(5.0)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def _repr_html_(self) -> str:
        return f'<a href="{self.url}" target="_blank" rel="noopener">the page of sgim</a>'


def serve(
    *runs: Run | str | Path,
    teach: bool | None = None,
    scene: Scene | None = None,
    port: int | None = None,
    expose: str | None = None,
) -> Served:
    """Serve a page that watches runs, and lets a person teach one.

    Args:
        runs: Runs of this process, or journals of others, finished or going on.
        teach: Whether a person may teach the first of them; None for whether that is a run of
            this process that asks persons.
        scene: How its world looks; None for that of its experiment.
        port: The port; None for 7446, or any if that is taken.
        expose: The one address, other than loopback, to listen on. Whoever reaches it and knows
            the URL controls the page, and the connection is not encrypted.

    Returns:
        The page, whose ``url`` is to be opened in a browser.

    Raises:
        SgimError: If a package is missing, there is no run, a run keeps no journal, or the
            address cannot be used.
        JournalError: If a journal cannot be read, or its run asks nobody.
    """
    uvicorn, site = _imported()
    watched = [_watched(i, run) for i, run in enumerate(runs)]
    if not watched:
        raise SgimError("there is no run to watch")
    first = runs[0]
    if teach is None:
        teach = isinstance(first, Run) and first.asks_persons
    lesson = None
    if teach:
        world = scene or scene_of(watched[0].header.get("experiment"))
        lesson = Lesson(watched[0].path, world, _who(watched[0]))
    address = LOOPBACK if expose is None else _address(expose)
    listening = _listen(address, port)
    number = listening.getsockname()[1]
    guard = Guard(site(watched, lesson).application(), _hosts(address, number), number)
    config = uvicorn.Config(
        guard,
        ws_max_size=LARGEST_MESSAGE,
        ws_per_message_deflate=False,
        ws_ping_interval=20.0,
        limit_concurrency=64,
        timeout_graceful_shutdown=1,
        server_header=False,
        log_level="critical",  # a refused handshake is logged as an error
        access_log=False,
    )
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, args=([listening],), name="sgim-web", daemon=True)
    thread.start()
    while thread.is_alive() and not server.started:
        time.sleep(0.01)
    host = f"[{address}]" if ":" in address else address
    url = f"http://{host}:{number}/?token={guard.token}"
    return Served(server, thread, url, [one.path for one in watched])


def _imported() -> tuple[Any, Any]:
    try:
        import uvicorn
        import websockets  # noqa: F401 - uvicorn uses it

        from sgim.web.application import Site
    except ImportError as error:
        raise SgimError(
            f"the page needs {error.name}, which is not installed; "
            "install it with: pip install 'sgim[web]'"
        ) from error
    return uvicorn, Site


def _watched(number: int, run: Run | str | Path) -> Watched:
    if isinstance(run, Run):
        if run.journal is None:
            raise SgimError("a page reads a run's journal, and this run keeps none: journal=PATH")
        run.journal.commit()
        learner = run.learner
        return Watched(number, run.journal.path, learner.task, lambda: regions_of(learner))
    watched = Watched(number, Path(run))
    regions = folded(watched.path, watched.task, watched.header.get("recipe"))
    return Watched(number, watched.path, watched.task, regions)


def _who(watched: Watched) -> str:
    recipe = watched.header.get("recipe") or {}
    return str(watched.header.get("learner") or recipe.get("learner") or "the learner")


def _address(given: str) -> str:
    try:
        address = ipaddress.ip_address(given)
    except ValueError:
        raise SgimError(f"{given!r} is not an address; give one such as 192.168.1.20") from None
    if address.is_unspecified or address.is_multicast:
        raise SgimError(f"{given} stands for many addresses; give the one to listen on")
    if not address.is_loopback:
        print(
            f"WARNING: the page listens on {given}, beyond this machine, unencrypted. Everybody "
            "on that network who learns its URL can watch the runs, teach, and stop others from "
            "teaching; and the URL crosses the network in clear text.",
            file=sys.stderr,
        )
    return given


def _hosts(address: str, port: int) -> set[str]:
    """The names that are answered."""
    named = f"[{address}]" if ":" in address else address
    hosts = {f"{named}:{port}"}
    if ipaddress.ip_address(address).is_loopback:
        hosts.add(f"localhost:{port}")
    return hosts


def _listen(address: str, port: int | None) -> socket.socket:
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    wanted: Sequence[int] = (PORT, 0) if port is None else (port,)
    for number in wanted:
        listening = socket.socket(family)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((address, number))
            listening.listen(64)
            return listening
        except OSError as error:
            listening.close()
            if number == wanted[-1]:
                raise SgimError(
                    f"cannot listen on {address}, port {number}: {error.strerror}; choose another"
                ) from error
            warnings.warn(
                f"port {number} is taken; the page has another, where the browser does not find "
                "takes that it kept",
                stacklevel=3,
            )
    raise AssertionError
