"""``sgim watch`` and ``sgim teach``: what they refuse, and what others say of a taught run."""

from pathlib import Path

import pytest
from tests.web.conftest import taught_run

from sgim.cli import main


def said(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(arguments) != 0
    return capsys.readouterr().err


def test_a_lesson_needs_movements_and_a_pace(capsys: pytest.CaptureFixture[str]) -> None:
    assert "movements is 0" in said(capsys, "teach", "hockey", "--movements", "0")
    assert "pace is -1" in said(capsys, "teach", "hockey", "--pace", "-1")


def test_only_worlds_with_a_scene_are_taught(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["teach", "arm"]) == 2


def test_what_cannot_be_watched_is_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert "no journal" in said(capsys, "watch", str(tmp_path / "none.sgim"))
    assert "no journal" in said(capsys, "watch", str(tmp_path))


def test_a_run_that_asks_nobody_is_not_taught(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "a.sgim"
    run = ["run", "throwing", "--learner", "random", "--movements", "4", "--journal", str(path)]
    assert main(run) == 0
    assert "asks nobody" in said(capsys, "watch", str(path), "--teach", "--port", "0")


def test_a_taught_run_is_shown_and_to_be_resumed_by_teaching(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "a.sgim"
    with taught_run(path) as run:
        run.go(20)
    assert main(["show", str(path)]) == 0
    again = said(capsys, "resume", str(path), "--movements", "40")
    assert "sgim teach throwing" in again
