"""Comparing runs from the command line."""

import io
import json
from pathlib import Path

import numpy as np
import pytest

from sgim.cli import main
from sgim.cli.comparison_text import print_comparison
from sgim.runs.comparison import compare
from sgim.runs.measured import read_measured
from sgim.runs.summary import find_journals, read_run


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("swept")
    words = "sweep throwing --learners random,mimicry:T2 --seeds 0-5 --movements 80 --jobs 1 --out"
    assert main([*words.split(), str(folder)]) == 0
    return folder


def test_a_folder_of_journals_is_two_tables(sgim, swept: Path) -> None:
    said = sgim("compare", swept, "--against", "random")
    assert said.code == 0
    lines = said.out.splitlines()
    assert lines[0] == "throwing, total error (share of the outcome space) at 80 movements"
    assert sorted(line.split()[0] for line in lines[3:5]) == ["mimicry:T2", "random"]
    assert "6 pairs" in said.out
    assert "lower" in said.out
    assert "\x1b" not in said.out
    assert said.err == ""


def test_json_has_everything(sgim, swept: Path) -> None:
    facts = json.loads(sgim("compare", swept, "--json", "--kind", "place", "--at", "40").out)
    assert facts["at"] == 40
    assert facts["movements"] == [0, 20, 40]
    assert [group["seeds"] for group in facts["groups"]] == [[0, 1, 2, 3, 4, 5]] * 2
    for group in facts["groups"]:
        for path, errors in zip(group["journals"], group["errors"], strict=True):
            recorded = [e.errors["place"] for e in read_run(path).evaluations][:3]
            assert errors == recorded
        assert len(group["curve"]["value"]) == len(group["curve"]["low"]) == 3
        last = [errors[-1] for errors in group["errors"]]
        shares = [np.mean(np.array(last) <= t) for t in facts["thresholds"]]
        assert group["profile"] == pytest.approx(shares)
    (comparison,) = facts["comparisons"]
    assert comparison["test"].startswith("Wilcoxon")
    assert comparison["verdict"]
    assert facts["notes"]


def test_on_a_terminal_the_table_is_drawn(swept: Path) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    stream = Terminal()
    print_comparison(compare([read_measured(p) for p in find_journals([swept])]), stream)
    assert "───" in stream.getvalue()


@pytest.mark.parametrize(
    ("words", "code", "hint"),
    [
        (["--kind", "plac"], 2, "Did you mean 'place'?"),
        (["--against", "radnom"], 2, "Did you mean 'random'?"),
        (["--at", "70"], 2, "evaluated at 70 movements; there are some at 20, 40, 60, 80"),
        (["--margin", "2"], 2, "share between 0 and 1"),
        (["--seed", "-1"], 2, "seed is -1, expected 0 or more"),
        (["empty"], 1, "no journal (*.sgim) in empty"),
        (["nowhere"], 1, "there is no journal nowhere"),
    ],
)
def test_a_mistake_is_named_with_what_to_do(
    sgim, tmp_path: Path, swept: Path, words: list[str], code: int, hint: str
) -> None:
    (tmp_path / "empty").mkdir()
    said = sgim("compare", swept, *words)
    assert said.code == code
    assert hint in said.err
    assert said.out == ""


def test_experiments_are_not_mixed(sgim, swept: Path) -> None:
    sgim("run", "arm", "--learner", "random", "--movements", "80")
    said = sgim("compare", "runs", swept)
    assert said.code == 2
    assert "runs of arm, throwing, whose errors do not compare" in said.err


def test_runs_of_other_lengths_need_an_evaluation_that_each_has(sgim, swept: Path) -> None:
    sgim("run", "throwing", "--learner", "sagg-riac", "--movements", "40")
    said = sgim("compare", "runs", swept)
    assert said.code == 2
    assert "such as --at 40" in said.err
    assert sgim("compare", "runs", swept, "--at", "40").code == 0
