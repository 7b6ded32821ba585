"""Exported tables say what the journals say, in the columns that their page documents."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from sgim.events import Opened, Planned, Suggested, Told
from sgim.experiments import experiment
from sgim.records import Goal, Plan
from sgim.runs import Journal
from sgim.runs.summary import read_run
from sgim.runs.tables import tables
from sgim.spaces import Box, Choices
from sgim.task import Task

PAGE = Path(__file__).parent.parent.parent / "docs" / "export.md"
TABLES = ("trials", "episodes", "evaluations")


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, world = tmp_path_factory.mktemp("exported"), experiment("throwing")
    for learner, seed in (("sgim-acts", 3), ("random", 0)):
        path = world.journal_path(learner, seed, folder=folder)
        with world.start(learner, path, seed=seed, evaluate_every=50) as run:
            run.go(120)
    return folder


def test_tables_hold_what_the_journals_hold(sgim, swept: Path, tmp_path: Path) -> None:
    out = tmp_path / "tables"
    said = sgim("export", swept, "--parquet", out)
    assert said.out.split() == [str(out / f"throwing-{name}.parquet") for name in TABLES]
    trials, episodes, evaluations = (
        pq.read_table(out / f"throwing-{name}.parquet").to_pylist() for name in TABLES
    )
    run = read_run(swept / "throwing-sgim-acts-3.sgim")
    mine = [row for row in trials if row["learner"] == "sgim-acts"]
    assert [row["trial"] for row in mine] == list(range(120))
    assert {row["seed"] for row in mine} == {3}
    assert {row["run"] for row in mine} == {"throwing-sgim-acts-3"}
    with Journal.open(run.path, append=False) as journal:
        told = list(journal.events(only=["told"]))
    for row, event in zip(mine, told, strict=True):
        for kind, names in (("throw", ("distance", "height")), ("place", ("angle",))):
            values = [row[f"outcome.{kind}.{name}"] for name in names]
            expected = event.outcome.get(kind, [None] * len(names))
            assert values == list(expected)
    its = [row for row in episodes if row["learner"] == "sgim-acts"]
    assert [row["mode"] for row in its] == run.openings.modes
    assert [row["goal_kind"] for row in its] == run.openings.kinds
    assert [row["trials_before"] for row in its] == run.openings.movements.tolist()
    assert sum(row["trials"] or 0 for row in its) <= 120
    for row in its[:-1]:
        assert row["competence_after"] >= row["competence_before"]
        assert (
            row[
                f"pursued.{row['pursued_kind']}."
                + "distance" * (row["pursued_kind"] == "throw")
                + "angle" * (row["pursued_kind"] == "place")
            ]
            is not None
        )
    found = {
        (row["trials"], row["kind"]): row["error"]
        for row in evaluations
        if row["learner"] == "sgim-acts"
    }
    assert found == {(e.movements, k): x for e in run.evaluations for k, x in e.errors.items()}


def test_columns_are_those_that_the_page_documents(sgim, swept: Path, tmp_path: Path) -> None:
    sgim("export", swept, "--parquet", tmp_path)
    begin, *parts = re.split(r"^### ", PAGE.read_text("utf-8"), flags=re.MULTILINE)
    common = documented(begin)
    for name, part in zip(TABLES, parts, strict=True):
        schema = pq.read_schema(tmp_path / f"throwing-{name}.parquet")
        patterns = [re.escape(c).replace(r"\*", r"[^.]+") for c in [*common, *documented(part)]]
        for column in schema.names:
            assert any(re.fullmatch(pattern, column) for pattern in patterns), column
        for pattern in patterns:
            if "context" not in pattern:
                assert any(re.fullmatch(pattern, column) for column in schema.names), pattern
    unit = pq.read_schema(tmp_path / "throwing-trials.parquet").field("outcome.throw.distance")
    assert unit.metadata == {b"unit": b"m"}


def documented(text: str) -> list[str]:
    """The names in the first column of the tables."""
    rows = re.findall(r"^\| (`.*?) \|", text, flags=re.MULTILINE)
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row)]


def test_labels_contexts_and_open_episodes_have_their_columns(tmp_path: Path) -> None:
    task = Task(
        Box(0, 1), {"object": Choices(["cup", "ball"])}, context_space=Box(0, 1, names=["wind"])
    )
    path, wind = tmp_path / "a.sgim", np.array([0.5])
    with Journal.create(path, {}, task) as journal:
        journal.append(Suggested(Goal("object", "cup")))
        journal.append(Opened(0, "autonomous", Goal("object", "cup"), wind, "suggestion"))
        for number in range(2):
            plan = Plan(number, 0, "autonomous", None, np.array([0.25]), None, wind)
            journal.append(Planned(plan))
        journal.append(Told(0, {"object": "ball"}, 1.5))
    with Journal.open(path, append=False) as journal:
        found = tables(journal, "a")
    values = {name: {k: c.values for k, c in table.items()} for name, table in found.items()}
    assert values["trials"]["outcome.object"] == ["ball"]
    assert values["trials"]["context.wind"] == [0.5]
    assert values["trials"]["seconds"] == [1.5]
    assert values["trials"]["experiment"] == [None]
    assert values["episodes"]["goal.object"] == ["cup"]
    assert values["episodes"]["cause"] == ["suggestion"]
    assert values["episodes"]["trials"] == [None]
    assert values["evaluations"]["error"] == []


def test_runs_of_different_tasks_are_not_mixed(sgim, tmp_path: Path) -> None:
    for name, size in (("a", 1), ("b", 2)):
        task = Task(Box([0] * size, 1), {"spot": Box(0, 1)})
        Journal.create(tmp_path / f"{name}.sgim", {}, task).close()
    said = sgim("export", tmp_path, "--parquet", tmp_path / "out")
    assert said.code == 2
    assert "of another task" in said.err
