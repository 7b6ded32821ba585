"""Formatter, linter, types and documentation: each tool is run as a developer would run it."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PLACES = ["src", "tests", "benchmarks", "docs"]


def run(*command: str) -> None:
    """Run a tool of this interpreter at the root of the repository, and show what it found."""
    done = subprocess.run(
        [sys.executable, "-m", *command],
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=600,
    )
    if done.returncode:
        pytest.fail(f"{' '.join(command)}\n{done.stdout}{done.stderr}", pytrace=False)


def test_the_linter_finds_nothing() -> None:
    run("ruff", "check", "--no-cache", *PLACES)


def test_the_formatter_would_change_nothing() -> None:
    run("ruff", "format", "--no-cache", "--check", "--diff", *PLACES)


def test_every_type_is_right() -> None:
    run("mypy")


def test_the_documentation_builds_without_a_warning(tmp_path: Path) -> None:
    build = ["-W", "--keep-going", "-q", "-b", "html", "-d", str(tmp_path / "doctrees")]
    run("sphinx", *build, "docs", str(tmp_path / "html"))
