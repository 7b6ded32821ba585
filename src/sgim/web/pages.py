"""The pages that are connected: who is in control, and what each is yet to be sent."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

from sgim.web.messages import text_of
from sgim.web.protocol import FromServer, Role

MOST_PAGES = 16
GRACE = 15.0
"""For how long, in s, control is kept for a page that has lost its connection."""

_BACKLOG = 256


class Page:
    """One page.

    Attributes:
        name: Its own name, by which it is known when it connects again; empty before `Hello`.
        person: The name of who sits before it.
        queue: What it is yet to be sent; None to close it.
        lost: Whether it is too slow to be kept.
    """

    def __init__(self) -> None:
        self.name = ""
        self.person = ""
        self.queue: asyncio.Queue[str | None] = asyncio.Queue(_BACKLOG)
        self.lost = False

    def post(self, text: str) -> None:
        """Have a text sent; a page that does not read is given up."""
        try:
            self.queue.put_nowait(text)
        except asyncio.QueueFull:
            self.lost = True


class Pages:
    """All pages; one is in control, the others look on.

    Args:
        clock: Seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._pages: list[Page] = []
        self._holder = ""
        self._person = ""
        self._left: float | None = None
        self._clock = clock

    def __len__(self) -> int:
        return len(self._pages)

    def add(self, page: Page) -> bool:
        """Take in a page, unless there are too many."""
        if len(self._pages) >= MOST_PAGES:
            return False
        self._pages.append(page)
        return True

    def remove(self, page: Page) -> None:
        """Forget a page; its control is kept for a while, should it come again."""
        if page in self._pages:
            self._pages.remove(page)
            if page.name == self._holder and not self._is_here(page.name):
                self._left = self._clock()
            self.tell_roles()

    def greet(self, page: Page, name: str, person: str) -> None:
        """Know a page by its name; it has control again if it had it before."""
        page.name, page.person = name, person
        if name == self._holder:
            self._left = None
        self.tell_roles()

    def controls(self, page: Page) -> bool:
        """Whether a page is in control."""
        return bool(page.name) and page.name == self._holder

    def control(self, page: Page, take: bool) -> bool:
        """Give a page control if nobody has it, or take it back.

        Returns:
            Whether that was possible.
        """
        if not page.name:
            return False
        self.release()
        if take and not self.controls(page):
            if self._holder:
                return False
            self._holder, self._person, self._left = page.name, page.person, None
        elif not take and self.controls(page):
            self._holder, self._person, self._left = "", "", None
        self.tell_roles()
        return True

    def release(self) -> None:
        """Take control from a page that has not come again within its time, and tell the others."""
        if self._left is not None and self._clock() - self._left >= GRACE:
            self._holder, self._person, self._left = "", "", None
            self.tell_roles()

    def tell_all(self, message: FromServer) -> None:
        """Send a message to all pages that have said hello."""
        text = text_of(message)
        for page in self._pages:
            if page.name:
                page.post(text)

    def tell_holder(self, message: FromServer) -> None:
        """Send a message to the page in control."""
        for page in self._pages:
            if self.controls(page):
                page.post(text_of(message))

    def tell_roles(self) -> None:
        """Tell every page whether it is in control."""
        for page in self._pages:
            if page.name:
                role = Role(self.controls(page), self._person, len(self._pages))
                page.post(text_of(role))

    def _is_here(self, name: str) -> bool:
        return any(page.name == name for page in self._pages)
