"""Showing, answering and drawing from the command line."""

import json
import math
from pathlib import Path

import pytest

from sgim.runs import Journal
from sgim.runs.repertoire import open_repertoire
from sgim.spaces import Box, Choices
from sgim.task import Task


def test_show_prints_the_promised_json(sgim, finished: Path) -> None:
    said = sgim("show", finished, "--json")
    assert said.code == 0
    facts = json.loads(said.out)
    assert list(facts) == [
        *("experiment", "learner", "configuration", "seed"),
        *("movements", "finished", "evaluations", "choices"),
    ]
    assert facts["experiment"] == "throwing"
    assert facts["learner"] == "sgim-acts"
    assert facts["configuration"] == "modern"
    assert facts["seed"] == 0
    assert facts["movements"] == 300
    assert facts["finished"] is True
    assert [e["movements"] for e in facts["evaluations"]] == [0, 75, 150, 225, 300]
    for evaluation in facts["evaluations"]:
        cost = evaluation["cost"]
        assert list(cost) == ["throw", "place", "total"]
        assert math.isclose(cost["total"], (cost["throw"] + cost["place"]) / 2)
    assert len(facts["choices"]) == 4
    for quarter in facts["choices"]:
        assert list(quarter) == ["modes", "kinds"]
        assert math.isclose(sum(quarter["modes"].values()), 1)
        assert math.isclose(sum(quarter["kinds"].values()), 1)


def test_show_prints_tables(sgim, finished: Path) -> None:
    said = sgim("show", finished)
    assert said.out.startswith("throwing, sgim-acts, modern, seed 0: 300 movements, finished")
    assert "mode autonomous" in said.out


def test_show_says_how_to_go_on_with_what_is_not_finished(sgim, finished, tmp_path) -> None:
    with Journal.open(finished, append=False) as whole:
        header, task = whole.header, whole.task
    Journal.create(tmp_path / "begun.sgim", header, task).close()
    said = sgim("show", "begun.sgim")
    assert said.code == 0
    assert "sgim resume begun.sgim" in said.out
    said = sgim("resume", "begun.sgim")
    assert said.code == 2
    assert "--movements" in said.err


def test_answer_names_coordinates_and_units(sgim, finished: Path) -> None:
    said = sgim("answer", finished, "--goal", "throw=6.5,2.0")
    assert said.code == 0
    assert "distance  6.5 m" in said.out
    assert "acceleration_1" in said.out
    assert "rad/s²" in said.out
    assert "±" in said.out
    assert "seems" in said.out


def test_answer_as_json_is_what_the_repertoire_says(sgim, finished: Path) -> None:
    said = sgim("answer", finished, "--goal", "place=-1.2", "--json")
    facts = json.loads(said.out)
    solution = open_repertoire(finished).solve("place", [-1.2])
    assert facts["kind"] == "place"
    assert facts["goal"] == [-1.2]
    assert facts["policy"] == solution.policy.tolist()
    assert facts["expected"] == solution.expected.tolist()
    assert facts["spread"] == solution.spread.tolist()
    assert facts["cost"] == solution.cost
    assert facts["reachable"] is solution.reachable
    assert facts["names"]["expected"] == ["angle"]
    assert facts["units"]["policy"][:2] == ["rad/s²", "s"]


def test_answer_can_be_asked_in_another_way(sgim, finished: Path) -> None:
    said = sgim("answer", finished, "--goal", "throw=3,2", "--by", "kernel", "--json")
    solution = open_repertoire(finished).by("kernel").solve("throw", [3.0, 2.0])
    assert json.loads(said.out)["policy"] == solution.policy.tolist()


@pytest.mark.parametrize(
    ("goal", "hint"),
    [
        ("thro=1,2", "Did you mean 'throw'?"),
        ("throw", "write KIND=POINT, as in throw="),
        ("throw=1", "(distance m, height m)"),
        ("throw=1,x", "distance in m, height in m"),
        ("throw=1,nan", "finite"),
    ],
)
def test_a_goal_that_is_none_is_explained(sgim, finished: Path, goal: str, hint: str) -> None:
    said = sgim("answer", finished, "--goal", goal)
    assert said.code == 2
    assert hint in said.err


def test_a_kind_that_was_never_produced_has_no_answer(sgim, tmp_path) -> None:
    sgim("run", "throwing", "--learner", "mimicry:T1", "--movements", "20", "--journal", "a.sgim")
    said = sgim("answer", "a.sgim", "--goal", "place=1")
    assert said.code == 1
    assert "'place'" in said.err


def test_a_goal_may_be_a_label(sgim, tmp_path) -> None:
    task = Task(Box(0, 1, names=["grip"]), {"object": Choices(["cup", "ball"])})
    recipe = {"learner": "random", "teachers": [], "configuration": "modern", "seed": 0}
    with Journal.create(tmp_path / "a.sgim", {"recipe": recipe}, task) as journal:
        from sgim.events import Observed
        from sgim.records import Trial

        for grip, label in [(0.1, "cup"), (0.9, "ball")]:
            journal.append(Observed(Trial(task.check_policy([grip]), {"object": label})))
    said = sgim("answer", "a.sgim", "--goal", "object=cup", "--json")
    assert said.code == 0
    assert json.loads(said.out)["policy"] == [0.1]
    assert "label  cup" in sgim("answer", "a.sgim", "--goal", "object=cup").out
    wrong = sgim("answer", "a.sgim", "--goal", "object=cap")
    assert wrong.code == 2
    assert "Did you mean 'cup'?" in wrong.err


@pytest.mark.parametrize("format_", ["png", "svg"])
def test_plot_draws_and_says_where(sgim, finished: Path, tmp_path, format_: str) -> None:
    said = sgim("plot", finished, "--out", "figures", "--format", format_)
    assert said.code == 0
    written = [tmp_path / line for line in said.out.split()]
    assert [path.name for path in written] == [
        f"throwing-{name}.{format_}"
        for name in (
            *("errors", "costs", "choices", "strategies"),
            *("progress", "outcomes", "goals", "explored"),
        )
    ]
    begins = b"\x89PNG" if format_ == "png" else b"<?xml"
    assert all(path.read_bytes().startswith(begins) for path in written)


def test_plot_takes_directories_and_keeps_experiments_apart(sgim, finished, tmp_path) -> None:
    for seed in ("0", "1"):
        sgim("run", "throwing", "--learner", "random", "--movements", "60", "--seed", seed)
    sgim("run", "arm", "--learner", "random", "--movements", "60")
    names = {Path(line).name for line in sgim("plot", "runs", finished).out.split()}
    assert {"throwing-errors.png", "throwing-choices.png", "errors-by-world.png"} < names
    assert {"arm-random-0-errors.png", "arm-random-0-choices.png"} < names
    assert not {"arm-random-0-costs.png", "arm-random-0-strategies.png"} & names
    assert {"throwing-explored.png", "throwing-random-0-explored.png"} < names
    assert "throwing-random-1-explored.png" not in names
    assert "throwing-random-1-explored.png" in sgim("plot", "runs", "--each").out


def test_plot_of_a_directory_without_journals_is_a_failure(sgim, tmp_path) -> None:
    (tmp_path / "empty").mkdir()
    said = sgim("plot", "empty")
    assert said.code == 1
    assert "no journal (*.sgim) in empty" in said.err
