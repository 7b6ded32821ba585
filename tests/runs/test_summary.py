"""What a journal says of its run without a learner."""

from __future__ import annotations

import sqlite3
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from sgim.errors import JournalError, UnknownNameError
from sgim.events import Ended, Opened, Told
from sgim.experiments import experiment
from sgim.learner import Learner
from sgim.runs import Journal
from sgim.runs.journal_reading import header_of
from sgim.runs.summary import Openings, find_journals, read_run, summarise

THROWING = experiment("throwing")


def remove(path: Path, where: str) -> None:
    with sqlite3.connect(path) as db:
        db.execute(f"DELETE FROM events WHERE {where}")
    db.close()


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("summary") / "a.sgim"
    with THROWING.start("sgim-acts", path, evaluate_every=100, seed=5) as run:
        run.go(400)
    return path


def test_choices_are_shares_of_the_episodes_opened_in_each_quarter(path: Path) -> None:
    movements, quarters = 0, [Counter[str](), Counter(), Counter(), Counter()]
    kinds = [Counter[str](), Counter(), Counter(), Counter()]
    with Journal.open(path, append=False) as journal:
        for event in journal.events():
            if isinstance(event, Told):
                movements += 1
            elif isinstance(event, Opened):
                assert event.goal is not None
                quarter = min(3, movements * 4 // 400)
                quarters[quarter][event.mode] += 1
                kinds[quarter][event.goal.kind] += 1
    choices = read_run(path).choices
    names = {name for counts in quarters for name in counts}
    for found, modes, goals in zip(choices, quarters, kinds, strict=True):
        total = modes.total()
        assert found["modes"] == {name: modes[name] / total for name in names}
        assert found["kinds"] == {k: goals[k] / total for k in ("place", "throw")}


def test_a_summary_is_json_of_the_header_and_the_evaluations(path: Path) -> None:
    facts, run = summarise(path), read_run(path)
    assert facts["learner"] == "sgim-acts"
    assert facts["seed"] == 5
    assert facts["movements"] == 400
    assert facts["finished"] is True
    assert [e["movements"] for e in facts["evaluations"]] == [0, 100, 200, 300, 400]
    assert facts["evaluations"][-1]["cost"] == dict(run.evaluations[-1].errors)


def test_it_can_be_read_while_the_run_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with THROWING.start("mimicry:T2", path) as run:
        run.go(100)
        begun = read_run(path)
        assert begun.finished
        run.go(150)
        assert begun.learner == "mimicry:T2"
        assert (begun.movements, read_run(path).movements) == (100, 150)


def test_a_run_is_finished_when_its_last_movement_is_made_and_evaluated(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with THROWING.start("random", path, evaluate_every=20) as run:
        assert not read_run(path).finished
        run.go(40)
        assert read_run(path).reached(40)
        assert not read_run(path).reached(41)
    remove(path, "seq = (SELECT max(seq) FROM events)")
    cut = read_run(path)
    assert cut.movements == 40
    assert [e.movements for e in cut.evaluations] == [0, 20]
    assert not cut.finished
    with THROWING.resume(path) as run:
        run.go(40)
    assert read_run(path).finished


def test_quarters_not_reached_are_empty(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with THROWING.start("random", path) as run:
        run.go(40)
    with sqlite3.connect(path) as db:
        db.execute("UPDATE events SET detail = '{\"target\": 100}' WHERE event = 'session'")
    db.close()
    run = read_run(path)
    assert not run.finished
    assert run.choices == [
        *[{"modes": {"random": 1.0}, "kinds": {}}] * 2,
        *[{"modes": {}, "kinds": {}}] * 2,
    ]


def test_movements_are_the_trials_told_and_those_that_failed(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    learner: Learner = THROWING.learner("mimicry:T2")
    with Journal.create(path, {}, learner.task) as journal:
        learner.record = journal.append
        asked = learner.ask()
        learner.fail(asked, "the camera broke before the teacher began")
        alone = learner.ask()
        learner.tell(alone, {"throw": [1.0, 2.0]})
        learner.fail(learner.ask(), "the motor broke")
        learner.refuse(learner.ask(), "too fast")
        learner.expire(learner.ask())
    run = read_run(path)
    assert run.movements == learner.movements == 2
    assert run.learner is run.experiment is run.seed is run.target is None
    assert not run.finished
    assert run.summary()["choices"][0]["modes"] == {"mimic T2": 1.0}


def test_windows_hold_what_was_opened_at_their_beginning_but_not_at_their_end() -> None:
    openings = Openings(np.array([0, 5, 10, 19, 20]), ["a", "b", "a", "a", "b"], [None] * 5)
    shares = openings.shares(np.array([0.0, 10.0, 20.0]))
    assert [s["modes"] for s in shares] == [
        {"a": 0.5, "b": 0.5},
        {"a": 2 / 3, "b": 1 / 3},
    ]
    assert [s["kinds"] for s in shares] == [{}, {}]


def test_columns_come_undecoded_and_in_order(path: Path) -> None:
    with Journal.open(path, append=False) as journal:
        told = [e for e in journal.events(only=("told",)) if isinstance(e, Told)]
        assert [plan for (plan,) in journal.columns("told", "plan")] == [e.plan for e in told]
        kinds = [kind for _, kind in journal.columns("told", "seq", "kind")]
        assert kinds == [next(iter(e.outcome)) for e in told]
        with pytest.raises(UnknownNameError, match="'told'"):
            journal.columns("tolt", "plan")
        with pytest.raises(UnknownNameError, match="'plan'"):
            journal.columns("told", "plant")


def test_columns_hold_what_was_appended_just_now(tmp_path: Path) -> None:
    with Journal.create(tmp_path / "a.sgim", {}, THROWING.environment().task) as journal:
        journal.append(Ended(3, "lost", "gone"))
        assert journal.columns("ended", "plan", "name") == [(3, "lost")]


def test_the_header_can_be_read_alone(path: Path, tmp_path: Path) -> None:
    assert header_of(path)["experiment"] == "throwing"
    with pytest.raises(JournalError, match="there is no journal"):
        header_of(tmp_path / "no.sgim")


def test_journals_are_found_in_directories_each_once(tmp_path: Path) -> None:
    inside = tmp_path / "a" / "b"
    inside.mkdir(parents=True)
    (inside / "2.sgim").touch()
    (tmp_path / "a" / "1.sgim").touch()
    (tmp_path / "a" / "1.sgim-wal").touch()
    found = find_journals([tmp_path / "a" / "1.sgim", tmp_path / "a"])
    assert found == [tmp_path / "a" / "1.sgim", inside / "2.sgim"]
    with pytest.raises(JournalError, match="check the path"):
        find_journals([tmp_path / "c"])


def test_what_went_wrong_is_counted(tmp_path) -> None:  # type: ignore[no-untyped-def]
    from sgim import algorithms
    from sgim.environments import ThrowingArm
    from sgim.runs import keep_journal
    from sgim.runs.summary import read_run

    learner = algorithms.mimicry(ThrowingArm().task, "T1")
    with keep_journal(learner, tmp_path / "a.sgim") as learner:
        for _ in range(3):
            plan = learner.answer(learner.ask(), None)
            learner.fail(plan, "the motor is hot")
            for _ in range(4):
                learner.refuse(learner.ask(), "too fast")
    assert read_run(tmp_path / "a.sgim").troubles == {"declined": 3, "failed": 3, "refused": 12}
