"""Showing how a sweep goes: one bar for all its runs, or plain lines where there is no terminal."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, TextIO

from sgim.runs.progress import duration
from sgim.runs.sweep import SweptRun

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID


class SweepProgress:
    """One bar for many runs: done, failed and time left.

    Where there is no terminal, it is a line every few seconds.

    Args:
        title: What runs.
        total: How many runs there are.
        stream: Where to write; standard error if None.
    """

    seconds = 5.0
    """Least time between lines."""

    def __init__(self, title: str, total: int, stream: TextIO | None = None) -> None:
        self._title = title
        self._total = total
        self._stream = sys.stderr if stream is None else stream
        self._done = self._failed = self._made = 0
        self._begun = self._written = time.monotonic()
        self._bar: Progress | None = None
        self._task: TaskID | None = None

    def __enter__(self) -> SweepProgress:
        if self._stream.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

            self._bar = Progress(
                TextColumn("{task.description}"),
                BarColumn(),
                TextColumn("{task.fields[counts]}"),
                TimeElapsedColumn(),
                console=Console(file=self._stream),
                transient=True,
            )
            self._task = self._bar.add_task(self._title, total=self._total, counts=self._counts())
            self._bar.start()
        else:
            self._write(f"{self._title}: {self._total} runs")
        return self

    def ended(self, run: SweptRun) -> None:
        """Count a run that has ended."""
        if run.status == "failed":
            self._failed += 1
        elif run.status in ("finished", "known"):
            self._done += 1
        self._made += run.status != "known"
        if self._bar is not None and self._task is not None:
            counts = self._counts()
            self._bar.update(self._task, completed=self._done + self._failed, counts=counts)
        elif time.monotonic() - self._written > self.seconds:
            self._write(self._counts())

    def _counts(self) -> str:
        """Such as ``12 of 40 runs done, 1 failed, 3 min left``."""
        counts = f"{self._done} of {self._total} runs done"
        if self._failed:
            counts += f", {self._failed} failed"
        left = self._total - self._done - self._failed
        if self._made and left:  # those that were finished before took no time
            each = (time.monotonic() - self._begun) / self._made
            counts += f", {duration(each * left)} left"
        return counts

    def _write(self, text: str) -> None:
        self._written = time.monotonic()
        print(text, file=self._stream, flush=True)

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.stop()
