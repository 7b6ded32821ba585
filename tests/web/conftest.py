"""What the tests of the page share: a journal, a served page, a client that speaks its protocol."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx
import pytest
import websockets

import sgim
from sgim.environments import AirHockey, ThrowingArm
from sgim.experiments import EXPERIMENTS
from sgim.teachers import RemoteTeacher
from sgim.web import Served, serve

from .browsing import VIEWPORT, Hand, chromium

ARM = ThrowingArm()
TABLE = AirHockey()

UPWARD = [(0.0, -2.0 * i) for i in range(1, 14)]
"""A way of the mallet on the screen: straight up, so that the puck comes back to the far border."""


def taught_run(path: Path, learner: str = "sgim-acts", **more: Any) -> sgim.Run:
    """A run of the throwing arm that a person teaches."""
    return sgim.Run(
        sgim.algorithms.make(learner, ARM.task, ["person"], seed=3),
        ARM,
        {"person": RemoteTeacher(600.0)},
        journal=path,
        about={"experiment": "throwing", "learner": learner},
        benchmark=EXPERIMENTS["throwing"].benchmark(ARM),
        evaluate_every=100,
        **more,
    )


@dataclass
class Site:
    """A served page, and what a browser would have of it."""

    served: Served

    @property
    def base(self) -> str:
        parts = urlsplit(self.served.url)
        return f"http://{parts.netloc}"

    @property
    def journal(self) -> Path:
        return self.served.journals[0]

    @property
    def host(self) -> str:
        return urlsplit(self.served.url).netloc

    def cookies(self) -> dict[str, str]:
        answer = httpx.get(self.served.url)
        assert answer.status_code == 303
        return dict(answer.cookies)

    def headers(self) -> dict[str, str]:
        return {"Cookie": "; ".join(f"{k}={v}" for k, v in self.cookies().items())}

    def cut(self) -> None:
        """Break all connections, as a bad network does."""
        for connection in list(self.served._server.server_state.connections):
            connection.loop.call_soon_threadsafe(connection.transport.abort)

    @asynccontextmanager
    async def page(self, name: str, person: str = "Ada") -> AsyncIterator[Client]:
        """A page that has said hello."""
        async with websockets.connect(
            f"ws://{self.host}/socket", origin=self.base, additional_headers=self.headers()
        ) as socket:
            client = Client(socket)
            await client.send(what="hello", version=1, page=name, name=person)
            await client.get("welcome")
            yield client


class Client:
    """The page's end of the websocket."""

    def __init__(self, socket: Any) -> None:
        self.socket = socket

    async def send(self, **message: Any) -> None:
        await self.socket.send(json.dumps(message))

    async def get(self, what: str, when: Callable[[Any], bool] = lambda _: True) -> Any:
        """The next message of a kind for which a condition holds."""
        async with asyncio.timeout(20):
            while True:
                message = json.loads(await self.socket.recv())
                if message["what"] == what and when(message):
                    return message


@pytest.fixture(scope="module")
def journal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that a person teaches, stopped while it asks."""
    path: Path = tmp_path_factory.mktemp("web") / "taught.sgim"
    with taught_run(path) as run:
        run.go(200)
    return path


@pytest.fixture(scope="module")
def site(journal: Path) -> Iterator[Site]:
    """The page of that run, for teaching."""
    with serve(journal, teach=True, port=0) as served:
        yield Site(served)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


@pytest.fixture(scope="module")
def hockey(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """The page of a hockey run that has stopped while it asks."""
    path: Path = tmp_path_factory.mktemp("hockey") / "taught.sgim"
    learner = sgim.algorithms.make("mimicry", TABLE.task, ["person"], seed=3)
    with sgim.Run(
        learner,
        TABLE,
        {"person": RemoteTeacher(3600.0)},
        journal=path,
        about={"experiment": "hockey", "learner": "mimicry"},
    ) as run:
        run.go(60)
    with serve(path, teach=True, port=0) as served:
        yield Site(served)


@pytest.fixture(scope="module")
def opened(browser: Any, hockey: Site) -> Iterator[Hand]:
    """A page that is in control; at its end, it has met no error and asked nobody else."""
    context = browser.new_context(viewport=VIEWPORT, accept_downloads=True)
    page = context.new_page()
    requested: list[str] = []
    page.on("request", lambda request: requested.append(request.url))
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(hockey.served.url)
    yield Hand(page)
    context.close()
    assert not errors
    ours = (f"{hockey.base}/", f"ws://{hockey.host}/", "blob:", "data:")
    assert all(url.startswith(ours) for url in requested), requested


@pytest.fixture
def hand(opened: Hand) -> Hand:
    """The person before that page, who has nothing in hand."""
    page = opened.page
    opened.wait("window.sgim && window.sgim.version() !== null")
    page.set_viewport_size(VIEWPORT)
    page.click("#tab-teach")
    opened.take_control()
    page.select_option("#tempo", "0.5")
    page.focus("#stage")
    if opened.state() != "practice":
        page.keyboard.press("ArrowLeft")
        opened.wait("window.sgim.state() === 'practice'")
    return opened
