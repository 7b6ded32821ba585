"""What a run has learned, opened for its answers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from sgim import algorithms
from sgim.environments import ThrowingArm
from sgim.environments.benchmark_goals import throwing_goals
from sgim.errors import JournalError
from sgim.runs import Benchmark, Run, evaluate, open_repertoire


def learner() -> Any:
    return algorithms.make("sagg-riac", ThrowingArm().task, "T1", seed=0)


def test_a_repertoire_answers_as_the_run_did_and_can_be_opened_while_it_goes_on(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.sgim"
    with Run(learner(), ThrowingArm(), journal=path) as run:
        run.go(200)
        repertoire = open_repertoire(path)
        policy = run.learner.best_policy("throw", [4.0, 2.0])
        assert (repertoire.best_policy("throw", [4.0, 2.0]) == policy).all()
        run.go(210)
    solution = open_repertoire(path).solve("throw", [4.0, 2.0])
    assert solution.cost < 0.5


def test_a_repertoire_can_be_opened_as_it_was_and_measured_in_any_way(tmp_path: Path) -> None:
    path, world = tmp_path / "a.sgim", ThrowingArm()
    benchmark = Benchmark(throwing_goals()[::30], world)
    with Run(learner(), world, journal=path, benchmark=benchmark, evaluate_every=60) as run:
        measured = {e.movements: e.errors for e in run.go(180)}
    for movements, errors in measured.items():
        early = open_repertoire(path, movements=movements)
        assert len(early.model.memory) == movements  # type: ignore[attr-defined]
        assert evaluate(early, benchmark) == errors
    kernel = evaluate(open_repertoire(path), benchmark, by="kernel")
    assert kernel["throw"] != measured[180]["throw"]


def test_a_journal_without_a_recipe_needs_its_learner(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    made = learner()
    made.recipe = None
    with Run(made, ThrowingArm(), journal=path) as run:
        run.go(20)
    with pytest.raises(JournalError, match=r"with sgim.open\(path, learner=…\)"):
        open_repertoire(path)
    assert len(open_repertoire(path, learner=learner()).model.memory) == 20  # type: ignore[attr-defined]
