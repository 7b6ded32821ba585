"""The experiments that come with the library run by their names, evaluated and resumed."""

from pathlib import Path

import pytest

from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.runs.summary import read_run


@pytest.mark.parametrize("learner", ["random", "sagg-riac", "mimicry:expert", "sgim-acts"])
def test_hockey_is_run_evaluated_and_resumed_with_every_kind_of_learner(
    learner: str, tmp_path: Path
) -> None:
    hockey = experiment("hockey")
    path = hockey.journal_path(learner, folder=tmp_path)
    for movements in (60, 120):
        with hockey.start(learner, path, evaluate_every=60) as run:
            run.go(movements)
    recorded = read_run(path)
    assert recorded.movements == 120
    assert [evaluation.movements for evaluation in recorded.evaluations] == [0, 60, 120]
    assert recorded.evaluations[0].errors["hit"] == 1.0
    assert all(0 <= e.errors["hit"] <= 1 for e in recorded.evaluations)


def test_hockey_is_as_long_as_in_the_thesis_and_measured_on_41_goals() -> None:
    hockey = experiment("hockey")
    assert hockey.movements == 8000
    assert hockey.learner_name() == "sgim-acts"
    benchmark = hockey.benchmark(hockey.environment())
    assert {kind: len(points) for kind, points in benchmark.goals.items()} == {"hit": 41}
    assert benchmark.distance == "scaled"


def test_the_hockey_teacher_helps_where_it_teaches() -> None:
    hockey = experiment("hockey")
    learner = hockey.learner("mimicry:expert", seed=1000)
    hockey.run(learner).go(200)
    known = [-learner.competence("hit", [goal]) for goal in (0.55, 0.7, 0.85, 0.95)]
    assert max(known) < 0.05


def test_a_vocal_run_is_amid_one_language_or_alone() -> None:
    vocal = experiment("vocal")
    assert vocal.movements == 240_000
    names = [vocal.learner_name(teacher=teacher) for teacher in (None, "none", "1", "3")]
    assert names == ["sagg-riac-gmm", "sagg-riac-gmm", "sgim-acts-gmm:1", "sgim-acts-gmm:3"]
    assert [*vocal.learner("sgim-acts-gmm:2").teachers] == ["2"]
    assert not vocal.learner("sagg-riac-gmm").teachers
    benchmark = vocal.benchmark(vocal.environment())
    assert {kind: len(points) for kind, points in benchmark.goals.items()} == {"sound": 97}


def test_whoever_is_said_to_have_no_teacher_has_none() -> None:
    throwing = experiment("throwing")
    assert throwing.learner_name("sagg-riac", "none") == "sagg-riac:none"
    assert throwing.learner_name(teacher="none") == "sagg-riac"
    assert throwing.label(throwing.learner("sagg-riac:none")) == "sagg-riac"
    with pytest.raises(SgimError, match="one teacher"):
        throwing.learner("mimicry:none")
