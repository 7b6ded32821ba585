"""Help teaches, and a mistake is answered with what to do."""

import subprocess
import sys
from importlib.metadata import version

import pytest

from sgim.cli import COMMANDS


def test_without_arguments_it_says_what_it_can_do(sgim) -> None:
    said = sgim()
    assert said.code == 0
    assert said == sgim("--help") == sgim("-h")
    assert all(f"  {name} " in said.out for name in COMMANDS)


def test_it_says_its_version(sgim) -> None:
    assert sgim("--version").out == f"sgim {version('sgim')}\n"


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_a_help_with_an_example_that_fits_a_terminal(
    sgim, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    said = sgim(name, "--help")
    assert said.code == 0
    assert f"usage: sgim {name}" in said.out
    assert f"sgim {name}" in said.out.partition("Example")[2]
    assert all(len(line) <= 100 for line in said.out.splitlines())


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["rnu"], "Did you mean 'run'?"),
        (["run", "throwin"], "Did you mean 'throwing'?"),
        (["run", "throwing", "--learner", "sag-riac"], "Did you mean 'sagg-riac'?"),
        (["run", "throwing", "--configuration", "these"], "Did you mean 'thesis'?"),
        (["run", "throwing", "--learner", "mimicry", "--teacher", "T4"], "Known: T1, T2, T3"),
        (["run", "throwing", "--learner", "mimicry"], "mimicry:T1 (throws"),
        (["run", "throwing", "--learner", "sagg-riac:T1"], "asks no teacher"),
        (["run", "arm", "--learner", "mimicry"], "arm has none"),
        (["run", "arm", "--teacher", "T1"], "has no teachers"),
        (["run", "throwing", "--seed", "-1"], "seed is -1, expected 0 or more"),
        (["run", "throwing", "--movements", "0"], "movements is 0, expected 1 or more"),
        (["run", "throwing", "--batch", "0"], "batch is 0, expected 1 or more"),
        (["sweep", "throwing", "--learners", "randm", "--seeds", "0"], "Did you mean 'random'?"),
        (["sweep", "throwing", "--learners", "random", "--seeds", "0-x"], "such as 0-19"),
        (["sweep", "throwing", "--learners", "random", "--seeds", "5-3"], "write it upwards"),
    ],
)
def test_a_mistake_is_named_with_what_was_meant_and_nothing_is_written(
    sgim, tmp_path, words: list[str], hint: str
) -> None:
    said = sgim(*words)
    assert said.code == 2
    assert said.err.startswith("sgim: ")
    assert hint in said.err
    assert "Traceback" not in said.err
    assert not list(tmp_path.iterdir())


def test_a_mistyped_option_is_answered_with_the_nearest(sgim) -> None:
    said = sgim("run", "throwing", "--sede", "3")
    assert said.code == 2
    assert "--seed" in said.err


def test_a_journal_that_is_not_there_is_a_failure(sgim) -> None:
    for words in (
        ["show", "no.sgim"],
        ["resume", "no.sgim"],
        ["plot", "no.sgim"],
        ["compare", "no.sgim"],
    ):
        said = sgim(*words)
        assert said.code == 1
        assert "there is no journal no.sgim" in said.err


def test_what_there_is_is_listed_with_a_line_each(sgim) -> None:
    said = sgim("list")
    assert said.code == 0
    lines = said.out.splitlines()
    for name in ("throwing", "arm", "random", "random-goal-babbling", "sagg-riac", "mimicry"):
        assert [line for line in lines if line.startswith(f"  {name} ")]
    for name in ("emulation", "sgim-acts", "thesis", "modern"):
        assert [line for line in lines if line.startswith(f"  {name} ")]
    assert [line for line in lines if "teacher T1: " in line]


def test_whoever_stops_reading_is_not_complained_to() -> None:
    code = "import sys; from sgim.cli import main; sys.exit(main(['list']))"
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    process.wait(60)
