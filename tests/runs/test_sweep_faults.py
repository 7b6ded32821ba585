"""Sweeps whose workers are killed, on each back end: no run is lost, none is doubled."""

from __future__ import annotations

import os
import signal
import sqlite3
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import cloudpickle
import pytest

from sgim.environments.throwing import ThrowingArm
from sgim.experiments import Experiment, experiment
from sgim.runs.sweep import SweptRun, sweep
from sgim.runs.sweep_run import PlannedRun

THROWING = experiment("throwing")


class Deadly(ThrowingArm):
    """A world that kills the process in which it is, with some movement, as often as is said.

    Args:
        tally: A file with a line for each death so far.
        deaths: How many there are.
        movement: With which movement.
    """

    def __init__(self, tally: Path, deaths: int, movement: int = 60) -> None:
        super().__init__()
        self.tally, self.deaths, self.movement, self.made = tally, deaths, movement, 0

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        self.made += 1
        if self.made == self.movement:
            before = self.tally.read_text() if self.tally.exists() else ""
            if before.count("\n") < self.deaths:
                self.tally.write_text(before + "dead\n")
                os.kill(os.getpid(), signal.SIGKILL)
        return super().execute(policy, context, rng)


def deadly(tally: Path, deaths: int, movement: int = 60) -> Experiment:
    return replace(THROWING, environment=partial(Deadly, tally, deaths, movement))


def runs(tally: Path, deaths: int) -> list[PlannedRun]:
    """Four runs of 100 movements, the second of which kills its worker."""
    worlds = [THROWING, deadly(tally, deaths), THROWING, THROWING]
    return [
        PlannedRun(world, "sgim-acts", seed, 100, evaluate_every=50)
        for seed, world in enumerate(worlds)
    ]


def contents(path: Path) -> list[tuple[Any, ...]]:
    """All events of a journal but the sessions, which have times in them."""
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT * FROM events WHERE event != 'session' ORDER BY seq").fetchall()
    db.close()
    return [row[1:] for row in found]


@pytest.fixture(scope="module", autouse=True)
def _workers_need_not_find_this_file() -> None:
    cloudpickle.register_pickle_by_value(__import__("sys").modules[__name__])


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The same runs, made in this process, where nothing dies."""
    folder = tmp_path_factory.mktemp("undisturbed")
    return [r.path for r in sweep(runs(folder / "tally", 0), out=folder)]


@pytest.mark.parametrize("backend", ["loky", "dask", "ray"])
def test_a_worker_that_is_killed_costs_no_run_and_the_journals_are_the_same_on_every_back_end(
    backend: Any, tmp_path: Path, undisturbed: list[Path]
) -> None:
    tally, out, told = tmp_path / "tally", tmp_path / "out", list[SweptRun]()
    results = sweep(runs(tally, 1), backend=backend, jobs=2, out=out, on_end=told.append)
    assert tally.read_text() == "dead\n"
    assert [r.status for r in results] == ["finished"] * 4
    assert results[1].attempts == 2
    assert sorted(r.path for r in told) == sorted(r.path for r in results)
    # A neighbour that is killed between its last event and its closing leaves SQLite's files beside
    # the finished journal, which belong to it and are read with it.
    beside = ("-wal", "-shm", ".lock")
    there = sorted(path.name for path in out.iterdir() if not path.name.endswith(beside))
    assert there == [path.name for path in undisturbed]
    for result, expected in zip(results, undisturbed, strict=True):
        assert contents(result.path) == contents(expected)


def test_a_run_that_always_kills_its_worker_is_reported_and_takes_no_other_along(
    tmp_path: Path, undisturbed: list[Path]
) -> None:
    results = sweep(runs(tmp_path / "tally", 99), jobs=2, out=tmp_path / "out")
    assert [r.status for r in results] == ["finished", "failed", "finished", "finished"]
    assert results[1].attempts == 3
    assert "died each of 3 times" in results[1].error
    assert (tmp_path / "tally").read_text() == "dead\n" * 3
    for i in (0, 2, 3):
        assert contents(results[i].path) == contents(undisturbed[i])
