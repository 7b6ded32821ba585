"""How fast a run goes, when that is not as fast as it can."""

from __future__ import annotations

import time

_NAP = 0.02


class Pace:
    """Lets so many movements a second pass.

    Args:
        a_second: Movements a second; infinite for as fast as they come.
    """

    def __init__(self, a_second: float) -> None:
        if not a_second > 0:
            raise ValueError(f"pace is {a_second!r} movements a second, expected more than 0")
        self._between = 1 / a_second
        self._next = time.monotonic()
        self._made = -1

    def is_time(self, movements: int) -> bool:
        """Whether it is time for the next movement; if not, sleeps a little.

        Args:
            movements: How many have been made.
        """
        if self._between == 0.0:
            return True
        now = time.monotonic()
        if movements != self._made:
            self._made = movements
            self._next = max(self._next, now - self._between) + self._between
        if now < self._next:
            time.sleep(min(_NAP, self._next - now))
            return False
        return True
