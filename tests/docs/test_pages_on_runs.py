"""The pages on sweeps and on reproducing: their file and their lines do what is said."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

from sgim.experiments.sweep_plan import plan, read_sweep_file

DOCS = Path(__file__).parent.parent.parent / "docs"


def block(page: str, language: str) -> str:
    """The one block of a page in a language."""
    text = (DOCS / page).read_text("utf-8")
    (found,) = re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)
    return str(found)


def test_the_file_and_the_lines_of_the_page_on_sweeps_plan_and_run(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(block("sweeps.md", "toml"))
    assert len(plan(read_sweep_file(tmp_path / "mine.toml").parts)) == 2 * 8 * 20 + 2 * 2 * 6
    command = [sys.executable, "-W", "error", "-c", block("sweeps.md", "python")]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert [line.split()[:3] for line in lines] == [
        [learner, seed, "finished"] for learner in ("random", "mimicry:T2") for seed in "01"
    ]


def test_the_chapter_on_the_page_on_reproducing_is_one() -> None:
    names: dict[str, Any] = {}
    exec(block("reproducing.md", "python"), names)
    assert len(plan(names["MINE"].to_run(None, quick=False, worlds=False)[0])) == 40
