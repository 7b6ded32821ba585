"""How much a page may send."""

from __future__ import annotations

import time
from collections.abc import Callable


class Allowance:
    """So many messages and bytes a second, and a few seconds' worth at once.

    Args:
        messages: Messages a second.
        bytes_: Bytes a second.
        seconds: For how many seconds' worth there may be a burst.
        clock: Seconds.
    """

    def __init__(
        self,
        messages: float = 150.0,
        bytes_: float = 400_000.0,
        seconds: float = 4.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._rates = (messages, bytes_)
        self._seconds = seconds
        self._left = [messages * seconds, bytes_ * seconds]
        self._clock = clock
        self._then = clock()

    def admits(self, size: int) -> bool:
        """Whether a message of so many bytes may pass; it is counted."""
        now = self._clock()
        gone, self._then = now - self._then, now
        for i, (rate, cost) in enumerate(zip(self._rates, (1.0, float(size)), strict=True)):
            self._left[i] = min(rate * self._seconds, self._left[i] + gone * rate) - cost
        return min(self._left) >= 0.0
