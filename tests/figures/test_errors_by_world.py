"""Errors in many worlds: a panel for each, the same look for the same learner in all."""

from pathlib import Path

import numpy as np
import pytest

from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.figures import errors_by_world
from sgim.runs.summary import read_run


@pytest.fixture(scope="module")
def worlds(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Two learners on an arm, and one of them in another world."""
    folder, paths = tmp_path_factory.mktemp("worlds"), []
    for name, learner in (
        ("hockey", "random"),
        ("arm-2-tight", "random-goal-babbling"),
        ("arm-2-tight", "random"),
    ):
        paths.append(folder / f"{name}-{learner}.sgim")
        with experiment(name).start(learner, paths[-1], evaluate_every=20) as run:
            run.go(40)
    return paths


def test_each_world_has_a_panel_and_each_learner_one_look(worlds: list[Path]) -> None:
    figure = errors_by_world(worlds)
    hockey, arm = figure.axes[:2]  # in the order in which the library lists them
    assert [axes.get_title().split(" ")[0] for axes in (hockey, arm)] == ["hockey", "arm-2-tight"]
    looks = {
        axes.get_title(): {line.get_label(): line.get_color() for line in axes.lines}
        for axes in (arm, hockey)
    }
    on_arm, on_hockey = looks.values()
    assert len(on_arm) == 2
    assert len(set(on_arm.values())) == 2
    assert on_hockey == {"random": on_arm["random"]}
    assert {text.get_text() for text in figure.legends[0].get_texts()} == set(on_arm)


def test_a_line_has_the_total_errors_from_the_first_movement_on(worlds: list[Path]) -> None:
    (line,) = errors_by_world(worlds[:1]).axes[0].lines
    measured = {e.movements: e.errors["total"] for e in read_run(worlds[0]).evaluations}
    np.testing.assert_array_equal(line.get_xdata(), [20, 40])
    np.testing.assert_allclose(line.get_ydata(), [measured[20], measured[40]])


def test_runs_that_were_never_evaluated_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with experiment("arm-2-tight").start("random", path, evaluate_every=10**6) as run:
        run.benchmark = None
        run.go(5)
    with pytest.raises(SgimError, match="no run was evaluated"):
        errors_by_world([path])
