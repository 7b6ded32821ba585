"""Runs can be measured again by another way of answering, without learning anew."""

import json
from pathlib import Path

import pytest

from sgim.claims.answered import Answered
from sgim.errors import SgimError, UnknownNameError
from sgim.experiments import experiment
from sgim.runs import Run
from sgim.runs.measured import read_measured


@pytest.fixture(scope="module")
def journal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with evaluations at 0, 20 and 40 movements."""
    path = tmp_path_factory.mktemp("answered") / "hockey.sgim"
    with experiment("hockey").start("mimicry", path, seed=3, evaluate_every=20) as run:
        run.go(40)
    return path


def test_by_its_own_way_a_run_has_the_errors_that_it_had(journal: Path) -> None:
    run = read_measured(journal)
    again = Answered("nearest").measure(run, [20, 40])
    mine = {e.movements: e.errors["hit"] for e in run.evaluations if e.movements}
    assert {e.movements: e.errors["hit"] for e in again.evaluations} == pytest.approx(mine)
    assert again.path == run.path


def test_what_was_measured_is_kept_beside_the_journal(journal: Path) -> None:
    run = read_measured(journal)
    first = Answered("reliable").measure(run, [40])
    kept = journal.with_suffix(".reliable.json")
    errors = json.loads(kept.read_text("utf-8"))
    assert [*errors] == ["40"]
    errors["40"]["total"] = 0.125
    kept.write_text(json.dumps(errors), "utf-8")
    second = Answered("reliable").measure(run, [40, 50])
    assert first.evaluations[0].errors["total"] != 0.125
    assert [e.errors["total"] for e in second.evaluations] == [0.125]


def test_an_unknown_way_and_a_run_without_an_experiment_are_refused(
    journal: Path, tmp_path: Path
) -> None:
    with pytest.raises(UnknownNameError, match="nearest"):
        Answered("nearst").measure(read_measured(journal), [40])
    declared = experiment("hockey")
    learner = declared.learner("random", seed=0)
    path = tmp_path / "alone.sgim"
    with Run(
        learner,
        declared.environment(),
        journal=path,
        benchmark=declared.benchmark(declared.environment()),
        evaluate_every=5,
    ) as run:
        run.go(5)
    with pytest.raises(SgimError, match="no experiment of the library"):
        Answered("nearest").measure(read_measured(path), [5])
