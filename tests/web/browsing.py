"""A browser for tests: Chromium where it is installed, and how a test moves a hand in it."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import pytest

from sgim.runs.journal_file import connect

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")

REQUIRED = "SGIM_BROWSER_TESTS"
"""Set to ``required``, this makes tests fail that would be skipped without a browser."""

PICTURES = "SGIM_PICTURES"
"""Set to anything, this makes the tests write the pictures of ``docs/images`` again."""

IMAGES = Path(__file__).parent.parent.parent / "docs" / "images"

OPTIONS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-gpu-vsync",
]
VIEWPORT = {"width": 900, "height": 620}


@contextmanager
def chromium() -> Iterator[Any]:
    """The browser; the test is skipped without one, or fails if one is required."""
    path = next((found for name in NAMES if (found := shutil.which(name))), None)
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        path = None
    if path is None:
        words = "no Chromium, or no Playwright: the page is not tested in a browser"
        if os.environ.get(REQUIRED) == "required":
            pytest.fail(words)
        pytest.skip(words)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=OPTIONS)
        yield browser
        browser.close()


def with_profile(browser: Any, profile: Path) -> Any:
    """A browser of its own that can be killed and begun again: a folder keeps what it stores.

    Args:
        browser: Another one, of the same sort.
        profile: The folder.
    """
    path = next(found for name in NAMES if (found := shutil.which(name)))
    return browser.browser_type.launch_persistent_context(
        profile, executable_path=path, args=OPTIONS, viewport=VIEWPORT
    )


def crash(context: Any) -> None:
    """Kill a browser at once, with all its pages."""
    session = context.new_cdp_session(context.pages[0])
    with suppress(Exception):  # it has no time to answer
        session.send("Browser.crash")


class Hand:
    """A person at the page."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def wait(self, expression: str, seconds: float = 30.0) -> Any:
        """Wait until a JavaScript expression holds; the page's policy forbids to do it there."""
        return until(lambda: self.page.evaluate(expression), expression, seconds)

    def wait_text(self, selector: str, words: str, seconds: float = 30.0) -> str:
        """Wait until an element says something."""
        said = lambda: self.page.inner_text(selector)  # noqa: E731
        until(lambda: words in said(), f"{words!r} in {selector}", seconds, said)
        return str(said())

    def picture(self, name: str, size: tuple[int, int] = (1280, 800)) -> None:
        """Make a picture for the documentation, if such are asked for."""
        if not os.environ.get(PICTURES):
            return
        before = self.page.viewport_size
        self.page.set_viewport_size({"width": size[0], "height": size[1]})
        self.page.wait_for_timeout(700)
        self.page.screenshot(path=IMAGES / f"{name}.png")
        self.page.set_viewport_size(before)
        self.page.wait_for_timeout(300)

    def state(self) -> str:
        return str(self.page.evaluate("window.sgim.state()"))

    def tip(self) -> tuple[float, float]:
        x, y = self.page.evaluate("window.sgim.tip()")
        return float(x), float(y)

    def in_control(self) -> None:
        self.wait("window.sgim && window.sgim.control() && window.sgim.tip() !== null")

    def take_control(self) -> None:
        """Be in control, once nobody else is."""
        self.wait("window.sgim && window.sgim.version() !== null")
        self.wait("window.sgim.control() || !document.querySelector('#control').disabled")
        if not self.page.evaluate("window.sgim.control()"):
            self.page.click("#control")
        self.in_control()
        self.page.focus("#stage")

    def begin(self) -> None:
        """Record, and wait until that has begun."""
        self.page.keyboard.press("Space")
        self.wait("window.sgim.state() === 'recording'")

    def drag(self, way: list[tuple[float, float]], *, lift: bool = True) -> None:
        """Lead the tip along a way, in pixels from where it is."""
        x, y = self.tip()
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        for dx, dy in way:
            mouse.move(x + dx, y + dy)
        if lift:
            mouse.up()

    def sweep(self, strokes: list[tuple[float, float]], seconds: float) -> None:
        """Lead the tip by smooth strokes, in pixels, each of which sets in before the last ends."""
        x, y = self.tip()
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        begun, share = time.monotonic(), 0.0
        while share < 1.0:
            share = min(1.0, (time.monotonic() - begun) / seconds)
            ways = [
                _smooth((share - 0.25 * i) / (1 - 0.25 * (len(strokes) - 1)))
                for i in range(len(strokes))
            ]
            mouse.move(
                x + sum(way * dx for way, (dx, _) in zip(ways, strokes, strict=True)),
                y + sum(way * dy for way, (_, dy) in zip(ways, strokes, strict=True)),
            )
        mouse.up()

    def assessed(self) -> str:
        """Stop, and wait until the take is assessed; what it is worth."""
        if self.state() == "recording":
            self.page.keyboard.press("Space")
        self.wait("window.sgim.state() === 'assessed'")
        return str(self.page.inner_text("#worth"))


def _smooth(share: float) -> float:
    """A minimum-jerk movement."""
    s = min(max(share, 0.0), 1.0)
    return s**3 * (10 - 15 * s + 6 * s * s)


def until(
    holds: Callable[[], Any],
    what: str,
    seconds: float = 30.0,
    instead: Callable[[], Any] = lambda: None,
) -> Any:
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if found := holds():
            return found
        time.sleep(0.03)
    raise AssertionError(f"after {seconds:g} s still not: {what}; instead: {instead()}")


def letters(path: Path) -> list[tuple[Any, ...]]:
    """What persons have said to the run of a journal."""
    with connect(path, "mode=ro") as db:
        return db.execute("SELECT what, plan, name, detail FROM letters ORDER BY number").fetchall()
