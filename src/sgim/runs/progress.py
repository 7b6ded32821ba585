"""Showing how a run goes: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
import time
from collections import Counter, deque
from typing import TYPE_CHECKING, TextIO

from sgim.events import Evaluated, Opened

if TYPE_CHECKING:
    from rich.live import Live
    from rich.progress import Progress, TaskID

    from sgim.runs.observer import Observer
    from sgim.runs.run import Run

LATELY = 200
"""Episodes over which choices are shown."""


def progress(title: str, stream: TextIO | None = None) -> Observer:
    """An observer that suits a stream: a bar on a terminal, plain lines elsewhere.

    Args:
        title: What runs, in a few words.
        stream: Where to write; standard error if None.
    """
    stream = sys.stderr if stream is None else stream
    return ProgressBar(title, stream) if stream.isatty() else ProgressLines(title, stream)


class ProgressBar:
    """A bar with movements, time left, the latest errors, and the shares of modes lately.

    Args:
        title: What runs.
        stream: The terminal.
    """

    seconds = 0.25
    """How often it is drawn."""

    def __init__(self, title: str, stream: TextIO) -> None:
        self._title = title
        self._stream = stream
        self._live: Live | None = None
        self._bar: Progress | None = None
        self._task: TaskID | None = None
        self._choices = _Choices()
        self._drawn = 0.0

    def started(self, run: Run, target: int) -> None:
        """Draw the bar as it is at the beginning."""
        from rich.console import Console
        from rich.live import Live
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
        from rich.progress import TimeRemainingColumn as Remaining

        console = Console(file=self._stream)
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), Remaining())
        self._bar = Progress(*columns, console=console, auto_refresh=False)
        self._task = self._bar.add_task(self._title, total=target, completed=run.movements)
        # No thread redraws it: that would take time from the learner.
        self._live = Live(console=console, auto_refresh=False, transient=True)
        self._live.start()
        self._choices.skip(run)
        self._draw(run)

    def moved(self, run: Run) -> None:
        """Draw the bar again, if it is time."""
        if time.monotonic() - self._drawn > self.seconds:
            self._draw(run)

    def evaluated(self, run: Run, evaluation: Evaluated) -> None:
        """Draw the bar with the new errors, if it is time."""
        self.moved(run)

    def ended(self, run: Run) -> None:
        """Take the bar away."""
        if self._live is not None:
            self._live.stop()
            self._live = None

    def _draw(self, run: Run) -> None:
        from rich.console import Group
        from rich.text import Text

        if self._live is None or self._bar is None or self._task is None:
            return
        self._bar.update(self._task, completed=run.movements)
        self._choices.update(run)
        lines = [_errors(run.evaluations[-1])] if run.evaluations else []
        lines += [text] if (text := str(self._choices)) else []
        below = [Text(line, style="dim", no_wrap=True, overflow="ellipsis") for line in lines]
        self._live.update(Group(self._bar, *below), refresh=True)
        self._drawn = time.monotonic()


class ProgressLines:
    """A line at an evaluation, at most one every few seconds, and one a minute otherwise.

    Args:
        title: What runs.
        stream: Where to write.
    """

    seconds = 5.0
    """Least time between lines."""

    patience = 60.0
    """Time after which there is a line without an evaluation."""

    def __init__(self, title: str, stream: TextIO) -> None:
        self._title = title
        self._stream = stream
        self._target = 0
        self._begun = self._written = 0.0
        self._first = 0

    def started(self, run: Run, target: int) -> None:
        """Say what begins."""
        self._target, self._first = target, run.movements
        self._begun = self._written = time.monotonic()
        begun = f", {run.movements} of them made" if run.movements else ""
        self._write(f"{self._title}: {target} movements{begun}")

    def moved(self, run: Run) -> None:
        """Write a line if there has been none for long."""
        if time.monotonic() - self._written > self.patience:
            self._line(run)

    def evaluated(self, run: Run, evaluation: Evaluated) -> None:
        """Write a line unless there was one just now."""
        if time.monotonic() - self._written > self.seconds:
            self._line(run)

    def ended(self, run: Run) -> None:
        """Nothing: whoever started the run says how it ended."""

    def _line(self, run: Run) -> None:
        self._written = time.monotonic()
        made = run.movements - self._first
        left = ""
        if made:
            seconds = (self._written - self._begun) * (self._target - run.movements) / made
            left = f", {duration(seconds)} left"
        errors = f": {_errors(run.evaluations[-1])}" if run.evaluations else ""
        self._write(f"{run.movements} of {self._target} movements{left}{errors}")

    def _write(self, text: str) -> None:
        print(text, file=self._stream, flush=True)


class _Choices:
    """Shares of modes among the last episodes, read from the run's journal, if it keeps one."""

    def __init__(self) -> None:
        self._after = 0
        self._modes: deque[str] = deque(maxlen=LATELY)

    def skip(self, run: Run) -> None:
        """Pass over what was recorded before."""
        if run.journal is not None:
            self._after = run.journal.columns("session", "seq")[-1][0]

    def update(self, run: Run) -> None:
        if run.journal is not None:
            for row, event in run.journal.entries(self._after, only=("opened",)):
                assert isinstance(event, Opened)
                self._modes.append(event.mode)
                self._after = row

    def __str__(self) -> str:
        counts = Counter(self._modes).most_common()
        return "  ".join(f"{mode} {n / len(self._modes):.0%}" for mode, n in counts)


def _errors(evaluation: Evaluated) -> str:
    return "  ".join(f"{kind} {error:.3g}" for kind, error in evaluation.errors.items())


def duration(seconds: float) -> str:
    """A time in words: ``0.4 s``, ``8 s``, ``3 min``, ``2 h 5 min``."""
    if seconds < 2:
        return f"{seconds:.1f} s"
    if seconds < 59.5:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"
