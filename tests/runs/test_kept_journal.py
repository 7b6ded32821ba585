"""A journal made by the first version opens with every later one."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from sgim.experiments import experiment
from sgim.runs import Journal, open_repertoire
from sgim.runs.summary import read_run

KEPT = Path(__file__).parents[1] / "data" / "journal-1.sgim"


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    return Path(shutil.copy(KEPT, tmp_path))


def test_it_opens_and_has_what_was_recorded(journal: Path) -> None:
    run = read_run(journal)
    assert (run.experiment, run.learner, run.configuration, run.seed) == (
        "throwing",
        "sgim-acts",
        "modern",
        0,
    )
    assert run.finished
    assert [e.movements for e in run.evaluations] == [0, 100, 200, 300, 400]
    assert run.evaluations[-1].errors["total"] == 0.035173280651404785


def test_every_event_can_be_read(journal: Path) -> None:
    with Journal.open(journal, append=False) as opened:
        names = [type(event).__name__ for event in opened.events()]
    assert names.count("Told") == 400
    assert names.count("Evaluated") == 5
    assert names.count("Suggested") == names.count("Available") == 1


def test_its_repertoire_answers_as_it_did(journal: Path) -> None:
    repertoire = open_repertoire(journal)
    assert len(repertoire.model.memory) == 400  # type: ignore[attr-defined]
    solution = repertoire.solve("throw", [3.0, 2.0])
    outcome = experiment("throwing").environment().execute(solution.policy, None, None)
    np.testing.assert_allclose(outcome["throw"], solution.expected, rtol=1e-12)
    assert solution.cost < 0.05


def test_it_can_be_gone_on_with(journal: Path) -> None:
    with experiment("throwing").resume(journal, adopt=True) as run:
        assert run.movements == 400
        run.go(450)
    assert read_run(journal).movements == 450
