"""Many runs side by side."""

from __future__ import annotations

import signal
import sqlite3
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from sgim.environments.throwing import ThrowingArm
from sgim.errors import SgimError
from sgim.experiments import Experiment, experiment
from sgim.runs import Interrupted
from sgim.runs.summary import read_run
from sgim.runs.sweep import SweptRun, sweep
from sgim.runs.sweep_run import PlannedRun

THROWING = experiment("throwing")


def planned(
    learners: Iterable[str],
    seeds: Iterable[int],
    movements: int,
    world: Experiment = THROWING,
    evaluate_every: int = 1000,
) -> list[PlannedRun]:
    return [
        PlannedRun(world, learner, seed, movements, evaluate_every=evaluate_every)
        for learner in learners
        for seed in seeds
    ]


def rows(path: Path) -> list[tuple[object, ...]]:
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT * FROM events WHERE event != 'session' ORDER BY seq").fetchall()
    db.close()
    return [row[1:] for row in found]


def test_runs_in_other_processes_are_those_of_this_one(tmp_path: Path) -> None:
    told: list[SweptRun] = []
    results = sweep(
        planned(["sgim-acts", "mimicry:T1"], [0, 4], 150, evaluate_every=50),
        jobs=2,
        out=tmp_path / "side",
        on_end=told.append,
    )
    assert [(r.learner, r.seed) for r in results] == [
        *(("sgim-acts", 0), ("sgim-acts", 4)),
        *(("mimicry:T1", 0), ("mimicry:T1", 4)),
    ]
    assert {r.status for r in results} == {"finished"}
    assert {r.path for r in told} == {r.path for r in results}
    for result in results:
        alone = THROWING.journal_path(result.learner, result.seed, folder=tmp_path / "alone")
        with THROWING.start(result.learner, alone, seed=result.seed, evaluate_every=50) as run:
            run.go(150)
        assert rows(alone) == rows(result.path)


def test_what_is_finished_is_not_repeated_and_what_was_stopped_goes_on(tmp_path: Path) -> None:
    def swept(movements: int) -> list[str]:
        results = sweep(planned(["random"], [0, 1], movements), out=tmp_path)
        assert all(read_run(r.path).movements == 100 for r in results)
        return [r.status for r in results]

    with THROWING.start("random", THROWING.journal_path("random", 0, folder=tmp_path)) as run:
        run.go(30)
    assert swept(100) == ["finished", "finished"]
    before = [path.read_bytes() for path in sorted(tmp_path.iterdir())]
    assert swept(100) == ["known", "known"]
    assert swept(60) == ["known", "known"]
    assert [path.read_bytes() for path in sorted(tmp_path.iterdir())] == before


def test_a_journal_of_another_run_fails_and_is_kept(tmp_path: Path) -> None:
    path = THROWING.journal_path("random", 0, folder=tmp_path)
    with THROWING.start("random", path, batch=7) as run:
        run.go(20)
    before = path.read_bytes()
    (result,) = sweep(planned(["random"], [0], 20), out=tmp_path)
    assert result.status == "failed"
    assert "its batch is 7, but here it is 1" in result.error
    assert path.read_bytes() == before


class Broken(ThrowingArm):
    """A world that always fails."""

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        raise OSError("motor 3 is off")


@pytest.mark.filterwarnings("ignore:the world failed")
def test_a_run_that_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    sweep(planned(["random"], [1], 100), out=tmp_path)
    broken = replace(THROWING, environment=Broken)
    results = sweep(planned(["random"], [0, 1], 100, broken), out=tmp_path)
    assert [r.status for r in results] == ["failed", "known"]
    assert "RunError" in results[0].error
    assert "motor 3 is off" in results[0].error
    assert results[0].attempts == 3


def test_no_runs_or_one_run_twice_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SgimError, match="one or more runs"):
        sweep([], out=tmp_path)
    with pytest.raises(SgimError, match="plan each once"):
        sweep(planned(["random"], [0, 0], 20), out=tmp_path)
    assert not list(tmp_path.iterdir())


def test_ctrl_c_stops_the_sweep_and_the_same_sweep_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    execute, count = ThrowingArm.execute, 0

    def executed(self: ThrowingArm, *arguments: Any) -> Any:
        nonlocal count
        count += 1
        if count == 70:
            signal.raise_signal(signal.SIGINT)
        return execute(self, *arguments)

    monkeypatch.setattr(ThrowingArm, "execute", executed)
    with pytest.raises(Interrupted, match="1 of 3 runs are finished"):
        sweep(planned(["random"], [0, 1, 2], 50), out=tmp_path)
    results = sweep(planned(["random"], [0, 1, 2], 50), out=tmp_path)
    assert [r.status for r in results] == ["known", "finished", "finished"]


@pytest.mark.parametrize("stopped", [False, True])
def test_a_journal_written_elsewhere_is_brought_to_its_place(tmp_path: Path, stopped: bool) -> None:
    out, scratch = tmp_path / "out", tmp_path / "scratch"
    if stopped:
        with THROWING.start("random", THROWING.journal_path("random", 0, folder=out)) as run:
            run.go(30)
    broken = replace(THROWING, environment=Broken)
    plans = [*planned(["random"], [0], 60), *planned(["random"], [1], 60, broken)]
    with pytest.warns(UserWarning, match="the world failed"):
        finished, failed = sweep(plans, out=out, scratch=scratch, retries=0)
    assert (finished.status, failed.status) == ("finished", "failed")
    assert sorted(out.iterdir()) == sorted([finished.path, failed.path])
    assert not list(scratch.iterdir())
    (alone,) = sweep(planned(["random"], [0], 60), out=tmp_path / "alone")
    made, expected = ([r for r in rows(p) if r[0] == "told"] for p in (finished.path, alone.path))
    assert made == expected  # a stop adds an evaluation
