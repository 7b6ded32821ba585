"""How a run is shown while it goes on."""

import io
from pathlib import Path
from typing import Any

import pytest

from sgim.experiments import experiment
from sgim.runs.progress import ProgressBar, ProgressLines, duration, progress
from sgim.runs.sweep import SweptRun
from sgim.runs.sweep_progress import SweepProgress

THROWING = experiment("throwing")


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_terminal_has_a_bar_and_anything_else_lines() -> None:
    assert isinstance(progress("a", Terminal()), ProgressBar)
    assert isinstance(progress("a", io.StringIO()), ProgressLines)


def test_the_bar_shows_movements_errors_and_choices(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ProgressBar, "seconds", 0.0)
    terminal = Terminal()
    with THROWING.start("sgim-acts", tmp_path / "a.sgim", evaluate_every=50) as run:
        run.go(100, progress("a title", terminal))
    shown = terminal.getvalue()
    assert "a title" in shown
    assert "50/100" in shown
    assert "throw " in shown
    assert "autonomous " in shown


def test_a_run_without_a_journal_has_a_bar_too() -> None:
    terminal = Terminal()
    run = THROWING.run(THROWING.learner("random"))
    run.go(50, progress("a title", terminal))
    assert "a title" in terminal.getvalue()


def test_lines_are_few(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    THROWING.run(THROWING.learner("random"), evaluate_every=20).go(100, progress("a", stream))
    assert stream.getvalue() == "a: 100 movements\n"
    monkeypatch.setattr(ProgressLines, "seconds", -1.0)
    stream = io.StringIO()
    THROWING.run(THROWING.learner("random"), evaluate_every=50).go(100, progress("a", stream))
    lines = stream.getvalue().splitlines()
    assert [line.split()[0] for line in lines] == ["a:", "0", "50", "100"]
    assert "total 1" in lines[1]


def swept(status: Any) -> SweptRun:
    return SweptRun(Path("a.sgim"), "random", 0, status)


def test_lines_of_a_sweep_are_few() -> None:
    stream = io.StringIO()
    with SweepProgress("throwing", 3, stream) as shown:
        for _ in range(3):
            shown.ended(swept("finished"))
    assert stream.getvalue() == "throwing: 3 runs\n"


def test_a_sweep_shows_runs_done_failed_and_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(SweepProgress, "seconds", -1.0)
    stream = io.StringIO()
    with SweepProgress("throwing", 4, stream) as shown:
        for status in ("known", "finished", "failed", "finished"):
            shown.ended(swept(status))
    first, second, third, last = stream.getvalue().splitlines()[1:]
    assert first == "1 of 4 runs done"
    assert second == "2 of 4 runs done, 0.0 s left"
    assert third == "2 of 4 runs done, 1 failed, 0.0 s left"
    assert last == "3 of 4 runs done, 1 failed"


def test_a_sweep_on_a_terminal_has_one_bar() -> None:
    terminal = Terminal()
    with SweepProgress("a title", 2, terminal) as shown:
        shown.ended(swept("failed"))
        shown.ended(swept("finished"))
    assert "a title" in terminal.getvalue()
    assert "1 of 2 runs done, 1 failed" in terminal.getvalue()


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.04, "0.0 s"),
        (8.2, "8 s"),
        (59.7, "1 min"),
        (200, "3 min"),
        (3600, "1 h 0 min"),
        (7500, "2 h 5 min"),
    ],
)
def test_durations_are_short(seconds: float, text: str) -> None:
    assert duration(seconds) == text
