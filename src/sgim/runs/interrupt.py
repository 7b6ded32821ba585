"""Ctrl-C as a wish to stop between two movements."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType


class InterruptWish:
    """While it is entered, the first Ctrl-C is only noted; a second one interrupts at once.

    In threads other than the main one, where signals cannot be caught, it does nothing.

    Attributes:
        stop: Whether to stop.
    """

    def __init__(self) -> None:
        self.stop = False
        self._main = threading.current_thread() is threading.main_thread()

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self.stop:
            raise KeyboardInterrupt
        self.stop = True

    def __enter__(self) -> InterruptWish:
        if self._main:
            self._previous = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._main:
            signal.signal(signal.SIGINT, self._previous)
