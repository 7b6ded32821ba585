"""The command line as its user sees it: what it prints, and its exit code."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from sgim.cli import main


class Said(NamedTuple):
    code: int
    out: str
    err: str


Command = Callable[..., Said]


@pytest.fixture
def sgim(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Command:
    """Carries out a command in a directory of its own."""
    monkeypatch.chdir(tmp_path)

    def command(*words: str | Path) -> Said:
        code = main([str(word) for word in words])
        return Said(code, *capsys.readouterr())

    return command


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The journal of a finished run, only to be read."""
    path = tmp_path_factory.mktemp("finished") / "throwing.sgim"
    assert main(["run", "throwing", "--movements", "300", "--journal", str(path)]) == 0
    return path
