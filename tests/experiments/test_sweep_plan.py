"""Which runs a sweep makes, by names or by a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from sgim.errors import SgimError
from sgim.experiments.sweep_plan import Part, parse_seeds, plan, read_sweep_file

FILE = """
out = "runs/mine"
jobs = 3
seeds = "0-1"

[[sweep]]
experiments = ["throwing", "throwing-5"]
learners = ["sgim-acts", "mimicry"]
teachers = ["T1", "T3"]
configurations = ["modern", "modern,prior=0.1"]

[[sweep]]
experiments = "hockey"
learners = "random"
seeds = [7]
movements = 400
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("text", "seeds"),
    [("0-3", [0, 1, 2, 3]), ("0,3,5-7", [0, 3, 5, 6, 7]), ("4", [4]), ("2, 2-3", [2, 3])],
)
def test_seeds_are_numbers_and_ranges(text: str, seeds: list[int]) -> None:
    assert parse_seeds(text) == seeds


def test_a_file_says_what_to_run_part_by_part_and_how(tmp_path: Path) -> None:
    file = read_sweep_file(written(tmp_path, FILE))
    assert file.settings == {"out": "runs/mine", "jobs": 3}
    runs = plan(file.parts)
    names = {run.path("").name for run in runs}
    assert len(runs) == len(names) == 2 * 2 * 3 * 2 + 1
    assert "throwing-5-mimicry-T3-modern,prior=0.1-1.sgim" in names
    assert "throwing-sgim-acts-0.sgim" in names
    last = runs[-1]
    assert last.path("").name == "hockey-random-7.sgim"
    assert (last.movements, last.evaluate_every, last.batch) == (400, 100, 1)
    assert runs[0].movements == 8000


@pytest.mark.parametrize(
    ("changed", "hint"),
    [
        (("learners =", "lerners ="), "Did you mean 'learners'?"),
        (('seeds = "0-1"', ""), "needs seeds"),
        (('seeds = "0-1"', 'seeds = "5-1"'), "write it upwards"),
        (("jobs = 3", 'jobs = "3"'), "jobs is '3', expected a int"),
        (("movements = 400", "movements = 4.5"), "expected a whole number"),
        (("movements = 400", "movements = 0"), "movements is 0, expected 1 or more"),
        (('"sgim-acts", "mimicry"', '"sgim-atcs"'), "Did you mean 'sgim-acts'?"),
        (('teachers = ["T1", "T3"]', ""), "choose among mimicry:T1"),
        (('teachers = ["T1", "T3"]', 'teachers = ["T9"]'), "Known: T1, T2, T3"),
        (("seeds = [7]", "seeds = [-7]"), "expected such as"),
        (("[[sweep]]", "[[sweep"), "is not TOML"),
        (('experiments = "hockey"', "experiments = 3"), "expected a list of names"),
    ],
)
def test_a_file_that_says_something_else_is_refused(
    tmp_path: Path, changed: tuple[str, str], hint: str
) -> None:
    assert changed[0] in FILE
    with pytest.raises(SgimError) as refused:
        plan(read_sweep_file(written(tmp_path, FILE.replace(*changed))).parts)
    assert hint in str(refused.value)


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SgimError, match="check the path"):
        read_sweep_file(tmp_path / "no.toml")


def test_what_is_planned_twice_is_run_once_and_refused_if_it_differs() -> None:
    part = Part(("throwing",), ("random",), (0, 1))
    assert len(plan([part, replace(part, seeds=(1, 2))])) == 3
    with pytest.raises(SgimError, match="planned twice"):
        plan([part, replace(part, movements=10)])
    with pytest.raises(SgimError, match="nothing to run"):
        plan([replace(part, seeds=())])
