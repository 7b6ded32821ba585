"""Sweeps from the command line."""

from pathlib import Path

import pytest

from sgim.cli.commands.sweep import parse_seeds
from sgim.runs.summary import read_run

SWEEP = ["sweep", "throwing", "--learners", "random,mimicry:T2", "--movements", "60"]


@pytest.mark.parametrize(
    ("text", "seeds"),
    [("0-3", [0, 1, 2, 3]), ("0,3,5-7", [0, 3, 5, 6, 7]), ("4", [4]), ("2, 2-3", [2, 3])],
)
def test_seeds_are_numbers_and_ranges(text: str, seeds: list[int]) -> None:
    assert parse_seeds(text) == seeds


def test_a_sweep_makes_a_journal_a_run_and_repeats_none(sgim, tmp_path) -> None:
    said = sgim(*SWEEP, "--seeds", "0-1", "--out", "out", "--jobs", "1")
    assert said.code == 0
    assert "4 of 4 runs are finished: out" in said.out
    names = {path.name for path in Path(tmp_path, "out").iterdir()}
    assert names == {
        f"throwing-{learner}-{seed}.sgim" for learner in ("random", "mimicry-T2") for seed in (0, 1)
    }
    again = sgim(*SWEEP, "--seeds", "0-2", "--out", "out", "--jobs", "1")
    assert "6 of 6 runs are finished, 4 of them before: out" in again.out


def test_a_run_that_fails_is_reported_and_does_not_stop_the_others(sgim, tmp_path) -> None:
    broken = tmp_path / "out" / "throwing-random-0.sgim"
    broken.parent.mkdir()
    broken.write_text("not a journal")
    said = sgim(*SWEEP, "--seeds", "0-1", "--out", "out", "--jobs", "2")
    assert said.code == 1
    assert "3 of 4 runs are finished" in said.out
    assert "throwing-random-0.sgim failed" in said.err
    assert "Traceback" in said.err
    assert "is not a journal" in said.err
    assert read_run(tmp_path / "out" / "throwing-mimicry-T2-1.sgim").finished
