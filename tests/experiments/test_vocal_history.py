"""Vocal runs are read as they happened, and cut into stages."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from sgim.environments import ambient_language
from sgim.environments.vocal.classes import TYPES
from sgim.errors import JournalError
from sgim.experiments import experiment
from sgim.experiments.vocal_history import VocalHistory, read_policies, read_vocal_run
from sgim.experiments.vocal_stages import LABELS, Label, in_order, stages_of
from sgim.runs.journal import Journal
from sgim.runs.replay import iterate_trials

VOCAL = experiment("vocal")


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("vocal") / "run.sgim"
    with VOCAL.start("emulation:1", path, batch=40, evaluate_every=80) as run:
        run.go(120)
    return path


def test_a_history_has_the_sounds_policies_and_goals_of_the_run(path: Path) -> None:
    run = read_vocal_run(path)
    with Journal.open(path, append=False) as journal:
        trials = [*iterate_trials(journal.events())]
    sounds = np.array([trial.outcome["sound"] for trial in trials])
    assert run.history.sounds == pytest.approx(sounds, abs=1e-6)
    assert read_policies(path).tolist() == [trial.policy.tolist() for trial in trials]
    assert run.language == "1"
    assert run.history.names == ("emulate 1",)
    ambient = ambient_language("1").sounds
    ended = run.history.modes >= 0
    apart = np.abs(run.history.goals[ended][:, None] - ambient[None]).max(axis=2).min(axis=1)
    assert apart.max() < 1e-6
    assert np.isnan(run.history.goals[~ended]).all()


def test_competence_falls_with_the_distance_from_the_goal(path: Path) -> None:
    history = read_vocal_run(path).history
    known = ~np.isnan(history.goals[:, 0])
    apart = np.linalg.norm(history.sounds - history.goals, axis=1)
    assert history.competences[known] == pytest.approx(np.exp(-apart[known]), abs=1e-5)


def test_a_run_of_another_world_is_refused(tmp_path: Path) -> None:
    other = tmp_path / "throwing.sgim"
    with experiment("throwing").start("random", other, evaluate_every=10) as run:
        run.go(10)
    with pytest.raises(JournalError, match="not of a vocal tract"):
        read_vocal_run(other)


def history_of(parts: Sequence[tuple[int, str]]) -> VocalHistory:
    """So many sounds of a type, one part after another."""
    level = {"N": 0.0, "C": 0.5, "V": 1.0}
    rows = [[level[a], level[b], 0, 0, 0, 0] for n, (a, b) in parts for _ in range(n)]
    sounds = np.array(rows)
    return VocalHistory(sounds, np.full_like(sounds, np.nan), (), np.full(len(rows), -1))


def test_stages_are_where_the_sounds_change() -> None:
    found = stages_of(history_of([(300, "NN"), (600, "VN"), (300, "CV")]))
    assert [(stage.start, stage.end) for stage in found] == [(0, 300), (300, 900), (900, 1200)]
    assert [stage.label for stage in found] == [*LABELS[:3]]
    assert found[1].types[TYPES.index("VN")] == 1.0
    assert found[2].classes.tolist() == [0.0, 0.0, 1.0]
    assert in_order([stage.label for stage in found])


@pytest.mark.parametrize(
    ("labels", "ordered"),
    [
        ([0, 1, 2], True),
        ([0, 0, 1, 2], True),
        ([0, 3, 1, 2], True),
        ([0, 2], False),
        ([0, 1], False),
        ([0, 1, 2, 1], False),
        ([1, 0, 1, 2], False),
        ([], False),
    ],
)
def test_stages_are_in_order_if_all_come_and_none_goes_back(
    labels: list[int], ordered: bool
) -> None:
    named: list[Label] = [LABELS[i] for i in labels]
    assert in_order(named) == ordered


def test_shares_need_as_many_sounds_as_windows() -> None:
    history = history_of([(30, "NN"), (30, "VV")])
    assert history.shares(2).tolist() == [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    with pytest.raises(JournalError, match="60 vocalisations, too few for 61 windows"):
        history.shares(61)
