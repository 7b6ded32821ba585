"""The server's application: the page's own files, and one websocket for all else."""

from __future__ import annotations

import asyncio
import logging
import mimetypes
from collections.abc import AsyncIterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager, suppress
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from sgim.errors import SgimError
from sgim.web.conversation import Conversation
from sgim.web.flood import Allowance
from sgim.web.lesson import Lesson
from sgim.web.messages import MessageError, parse
from sgim.web.pages import GRACE, Page, Pages
from sgim.web.watching import Watched

_LOG = logging.getLogger("sgim.web")

WATCHING = 1.0
"""Time in s between two looks at the runs."""

LISTENING = 0.2
"""Time in s between two looks at what is asked."""

_QUIET = 15.0
"""Time in s after which a run that has written nothing is taken to have stopped."""

_PATIENCE = 10.0
"""Time in s within which a page must say hello."""

_MALFORMED, _FLOOD, _TOO_MANY = 1008, 1008, 1013


def page_files() -> dict[str, tuple[bytes, str]]:
    """Path → content and type, of the page's files: no path of a request is ever opened."""
    found: dict[str, tuple[bytes, str]] = {}
    _collect(files("sgim.web") / "static", "/", found)
    if "/index.html" in found:
        found["/"] = found["/index.html"]
    return found


def _collect(folder: Traversable, prefix: str, found: dict[str, tuple[bytes, str]]) -> None:
    for entry in folder.iterdir():
        if entry.is_dir():
            _collect(entry, f"{prefix}{entry.name}/", found)
        else:
            kind = mimetypes.guess_type(entry.name)[0] or "application/octet-stream"
            found[prefix + entry.name] = (entry.read_bytes(), kind)


class Site:
    """What is served: runs to be watched, and perhaps one to be taught.

    Args:
        watched: The runs.
        lesson: How one of them is taught; None to only watch.
    """

    def __init__(self, watched: Sequence[Watched], lesson: Lesson | None) -> None:
        self.pages = Pages()
        self._watched = list(watched)
        self._lesson = lesson
        # One thread: what is read and computed there is never used by two at once.
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="sgim-page")
        self._conversation = Conversation(self.pages, self._watched, lesson, self._worker)
        self._files = page_files()
        self._changed = float("-inf")

    def application(self) -> Starlette:
        """The application, to be guarded by `Guard`."""
        routes = [
            WebSocketRoute("/socket", self._socket),
            Route("/{path:path}", self._file, methods=["GET"]),
        ]
        return Starlette(routes=routes, lifespan=self._lifespan)

    @asynccontextmanager
    async def _lifespan(self, _: Starlette) -> AsyncIterator[None]:
        tasks = [asyncio.create_task(self._watch())]
        if self._lesson is not None:
            tasks.append(asyncio.create_task(self._listen(self._lesson)))
        yield
        for task in tasks:
            task.cancel()
        self._worker.shutdown(wait=False, cancel_futures=True)

    async def _file(self, request: Request) -> Response:
        found = self._files.get(request.url.path)
        if found is None:
            return PlainTextResponse("There is no such file.", status_code=404)
        return Response(found[0], media_type=found[1])

    async def _socket(self, socket: WebSocket) -> None:
        page = Page()
        await socket.accept()
        if not self.pages.add(page):
            await socket.close(_TOO_MANY, "too many pages are open")
            return
        sender = asyncio.create_task(_send(socket, page))
        try:
            await self._converse(socket, page)
        except (WebSocketDisconnect, RuntimeError):
            pass
        finally:
            self.pages.remove(page)
            asyncio.get_running_loop().call_later(GRACE + 0.1, self.pages.release)
            sender.cancel()
            with suppress(asyncio.CancelledError, Exception):
                await sender

    async def _converse(self, socket: WebSocket, page: Page) -> None:
        allowance = Allowance()
        while not page.lost:
            try:
                async with asyncio.timeout(None if page.name else _PATIENCE):
                    text = await socket.receive_text()
            except TimeoutError:
                await socket.close(_MALFORMED, "no hello came")
                return
            except KeyError:
                await socket.close(_MALFORMED, "expected text")
                return
            if not allowance.admits(len(text)):
                await socket.close(_FLOOD, "too many messages, or too large ones")
                return
            try:
                message = parse(text)
            except MessageError as error:
                await socket.close(_MALFORMED, f"{error}"[:100])
                return
            await self._conversation.hear(page, message)

    async def _run(self, function: Any, *arguments: Any) -> Any:
        return await asyncio.get_running_loop().run_in_executor(self._worker, function, *arguments)

    async def _watch(self) -> None:
        while True:
            if len(self.pages):
                for watched in self._watched:
                    try:
                        await self._look(watched)
                    except Exception:
                        _LOG.exception("cannot show %s", watched.path)
            await asyncio.sleep(WATCHING)

    async def _look(self, watched: Watched) -> None:
        if not await self._run(watched.look):
            return
        self._changed = asyncio.get_running_loop().time()
        facts = await self._run(watched.facts)
        self.pages.tell_all(facts)
        for outcomes in watched.outcomes():
            self.pages.tell_all(outcomes)

    async def _listen(self, lesson: Lesson) -> None:
        before: Any = None
        while True:
            if len(self.pages):
                try:
                    going = asyncio.get_running_loop().time() - self._changed < _QUIET
                    for said in await self._run(lesson.news):
                        self.pages.tell_all(said)
                    desk = await self._run(lesson.desk, going)
                    self._conversation.desk = desk
                    asked = [(a.plan, round(a.waiting + a.left)) for a in desk.requests]
                    now = (asked, desk.status, desk.time_limit, desk.per_hour, desk.left, going)
                    if now != before:
                        before = now
                        self.pages.tell_all(desk)
                except SgimError as error:
                    _LOG.warning("cannot read what is asked: %s", error)
            await asyncio.sleep(LISTENING)


async def _send(socket: WebSocket, page: Page) -> None:
    with suppress(WebSocketDisconnect, RuntimeError):
        while not page.lost:
            text = await page.queue.get()
            if text is None:
                break
            await socket.send_text(text)
        await socket.close(_TOO_MANY, "the page does not read what it is sent")
