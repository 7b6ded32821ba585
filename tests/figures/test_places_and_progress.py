"""Figures of where learners went, and of what their modes gained."""

from pathlib import Path

import numpy as np
import pytest

from sgim.experiments import experiment
from sgim.figures import places, progress
from sgim.figures.style import NothingToDrawError
from sgim.runs.content import goals_of, outcomes_of, progress_of, shown_in, shown_outcomes_of
from sgim.runs.summary import read_run

HOCKEY = experiment("hockey")


@pytest.fixture(scope="module")
def asking(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of a learner that asks its teacher now and then."""
    path = tmp_path_factory.mktemp("asking") / "hockey.sgim"
    with HOCKEY.start("sgim-im", path, evaluate_every=100) as run:
        run.go(200)
    return path


def test_places_have_a_panel_for_each_kind_and_learner(runs: list[Path]) -> None:
    figure = places(runs)
    panels = {
        (axes.get_xlabel(), axes.get_title().partition("\n")[0])
        for axes in figure.axes
        if axes.get_title()
    }
    places_of = {name for label, name in panels if label == "place: angle"}
    assert places_of >= {"mimicry:T2", "sgim-acts"}
    assert ("throw: distance", "random") in panels


def test_goals_are_counted_where_there_are_some(runs: list[Path]) -> None:
    learners = {axes.get_title() for axes in places(runs, "goals").axes}
    assert "sgim-acts" in learners
    assert "random" not in learners
    with pytest.raises(NothingToDrawError, match="no run has goals"):
        places([path for path in runs if "random" in path.name], "goals")


def test_every_outcome_in_view_is_counted_once(asking: Path) -> None:
    (axes,) = places([asking]).axes
    run = read_run(asking)
    inside = run.task.outcome_spaces["hit"].contains
    expected = sum(map(inside, run.produced("hit")))
    assert expected > 20
    assert sum(bar.get_height() for bar in axes.patches) == expected


def test_progress_has_shares_and_gains_of_each_mode(asking: Path, runs: list[Path]) -> None:
    figure = progress([asking])
    shares, gains = figure.axes
    assert gains.get_yscale() == "log"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "autonomous",
        "imitate expert",
    ]
    assert len(shares.patches) == len(gains.patches) == 2
    with pytest.raises(NothingToDrawError, match="several modes"):
        progress([path for path in runs if "random" in path.name])


def test_what_a_run_was_shown_and_aimed_at_is_read_from_its_journal(asking: Path) -> None:
    task, run = HOCKEY.environment().task, read_run(asking)
    asked = [i for i, mode in enumerate(run.openings.modes) if mode == "imitate expert"]
    assert 0 < len(asked) == len(run.shown()) == len(shown_outcomes_of(asking, task, "hit"))
    assert run.shown().shape == (len(asked), 14)
    assert task.policy_space.contains(shown_in(asking, task)[0])
    rows, goals = goals_of(asking, task, "hit")
    assert set(rows.tolist()) == set(range(len(run.openings.modes))) - set(asked)
    assert goals.shape == (len(rows), 1)
    when, points = outcomes_of(asking, task)["hit"]
    assert len(when) == len(points) == len(run.produced("hit"))
    early = run.produced("hit", 100)
    np.testing.assert_array_equal(early, run.produced("hit")[: len(early)])
    assert len(early) == sum(number < 100 for number in when)
    gained = progress_of(asking, task)
    assert set(gained) == {"autonomous", "imitate expert"}
    ends = np.concatenate([ended for ended, _ in gained.values()])
    assert 0 < ends.max() <= 200
