"""Figures have the panels, lines and labels that they promise."""

import io
import itertools
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from sgim.errors import SgimError
from sgim.events import Opened, Planned, Told
from sgim.experiments import experiment
from sgim.figures import choices, choices_by_kind, error_curves, explored, performance_profiles
from sgim.figures.style import mode_colours
from sgim.records import Plan
from sgim.runs import Journal
from sgim.spaces import Box, Choices
from sgim.task import Task

THROWING = experiment("throwing")


@pytest.fixture
def labelled(tmp_path: Path) -> Path:
    """A journal whose outcomes are labels and points of three coordinates."""
    task = Task(Box(0, 1), {"object": Choices(["cup", "ball"]), "spot": Box([0] * 3, 1)})
    path = tmp_path / "labels.sgim"
    with Journal.create(path, {}, task) as journal:
        journal.append(Opened(0, "random", None, None, "strategy"))
        for i in range(8):
            policy = task.check_policy([i / 8])
            journal.append(Planned(Plan(i, 0, "random", None, policy, None, None)))
            spot = task.outcome_spaces["spot"].check([i / 8, 0.5, 0.5])
            journal.append(Told(i, {"object": "cup" if i % 2 else "ball", "spot": spot}))
    return path


def saved(figure) -> bytes:
    """The figure as PNG; what cannot be laid out or drawn fails here."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=40)
    return stream.getvalue()


def test_error_curves_have_a_panel_a_kind_and_a_line_a_learner(runs: list[Path]) -> None:
    figure = error_curves(runs)
    assert [axes.get_title() for axes in figure.axes] == [
        "throw",
        "place",
        "total (mean of the kinds)",
    ]
    assert figure.axes[0].get_ylabel() == "error (share of the outcome space)"
    for axes in figure.axes:
        assert axes.get_xlabel() == "movements"
        assert len(axes.lines) == 3
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == [
        "mimicry:T2 (3 runs)",
        "random (3 runs)",
        "sgim-acts (3 runs)",
    ]
    assert saved(figure)


def test_a_world_of_one_kind_has_one_panel_in_its_unit(tmp_path: Path) -> None:
    arm = experiment("arm")
    with arm.start("random", tmp_path / "a.sgim", evaluate_every=50) as run:
        run.go(100)
    (axes,) = error_curves([tmp_path / "a.sgim"]).axes
    assert axes.get_title() == "hand"
    assert axes.get_ylabel() == "error (m)"


def test_the_legend_of_a_single_panel_is_within_the_figure(tmp_path: Path) -> None:
    arm = experiment("arm")
    paths = []
    for learner in ("random", "random-goal-babbling", "sagg-riac"):
        for configuration in ("modern", "thesis"):
            paths.append(tmp_path / f"{learner}-{configuration}.sgim")
            with arm.start(learner, paths[-1], configuration=configuration) as run:
                run.go(10)
    figure = error_curves(paths)
    assert saved(figure)
    (legend,) = figure.legends
    box = legend.get_window_extent()
    assert box.x0 >= 0
    assert box.x1 <= figure.bbox.x1
    assert box.y0 >= 0
    assert box.y1 < figure.axes[0].get_window_extent().y0


def test_many_evaluations_have_few_markers(tmp_path: Path) -> None:
    with experiment("arm").start("random", tmp_path / "a.sgim", evaluate_every=1) as run:
        run.go(100)
    (line,) = error_curves([tmp_path / "a.sgim"]).axes[0].lines
    assert len(line.get_xdata()) == 101
    assert len(line.get_xdata()[:: line.get_markevery()]) <= 20


def test_choices_have_a_row_of_two_panels_for_each_learner(runs: list[Path]) -> None:
    figure = choices(runs)
    assert len(figure.axes) == 2 * 3 + 2
    assert figure.axes[0].get_ylabel() == "mimicry:T2\n(3 runs)"
    legends = [[t.get_text() for t in axes.get_legend().get_texts()] for axes in figure.axes[-2:]]
    assert {"random", "mimic T2"} < set(legends[0])
    assert legends[1] == ["place", "throw"]
    assert "no goals" in [text.get_text() for axes in figure.axes for text in axes.texts]
    assert saved(figure)


def test_profiles_rise_from_none_to_all_of_a_learners_runs(runs: list[Path]) -> None:
    figure = performance_profiles(runs)
    assert [axes.get_title() for axes in figure.axes][:2] == ["throw", "place"]
    for axes in figure.axes:
        assert axes.get_xlabel() == "error at most\n(share of the outcome space)"
        for line in axes.lines:
            heights = np.asarray(line.get_ydata(), dtype=float)
            assert (np.diff(heights) >= 0).all()
            assert heights[-1] == 1
            assert {*np.round(3 * heights, 9)} <= {0, 1, 2, 3}
    assert saved(figure)


@pytest.mark.parametrize(
    "draw", [error_curves, performance_profiles, choices, choices_by_kind], ids=lambda d: d.__name__
)
def test_panels_can_be_one_below_the_other(runs: list[Path], draw) -> None:
    wide, narrow = draw(runs), draw(runs, columns=1)
    assert [axes.get_title() for axes in narrow.axes] == [axes.get_title() for axes in wide.axes]
    saved(narrow)
    panels = [axes.get_position() for axes in narrow.axes if axes.axison]
    assert all(above.y0 > below.y0 for above, below in itertools.pairwise(panels))
    assert narrow.get_figwidth() < 0.7 * wide.get_figwidth()


def test_explored_scatters_two_coordinates_and_counts_one(runs: list[Path]) -> None:
    figure = explored(runs[0])
    throw, place, bar = figure.axes
    assert throw.get_xlabel() == "distance (m)"
    assert throw.get_ylabel() == "height (m)"
    assert throw.collections
    assert place.get_xlabel() == "angle (rad)"
    assert place.patches
    assert bar.get_ylabel() == "movement"
    assert saved(figure)


def test_explored_has_bars_for_labels_and_the_first_two_of_many_coordinates(labelled) -> None:
    objects, spots, _ = explored(labelled).axes
    assert [label.get_text() for label in objects.get_xticklabels()] == ["cup", "ball"]
    assert sum(bar.get_height() for bar in objects.patches) == 8
    assert spots.get_xlabel() == "x0"
    assert spots.get_ylabel() == "x1"


def test_what_cannot_be_drawn_is_said(runs: list[Path], labelled: Path, tmp_path: Path) -> None:
    with pytest.raises(SgimError, match="no run was evaluated"):
        error_curves([labelled])
    with pytest.raises(SgimError, match="one experiment, but here are None, throwing"):
        error_curves([labelled, runs[0]])
    with pytest.raises(SgimError, match="no journal"):
        choices([])
    empty = tmp_path / "empty.sgim"
    Journal.create(empty, {}, THROWING.environment().task).close()
    with pytest.raises(SgimError, match="no choices"):
        choices([empty])
    with pytest.raises(SgimError, match="no outcome"):
        explored(empty)


def test_every_mode_has_a_colour_of_its_own() -> None:
    modes = ["autonomous", "random", *(f"{m} T{i}" for m in ("mimic", "emulate") for i in range(5))]
    colours = mode_colours(modes)
    assert set(colours) == set(modes)
    assert len({*colours.values()}) == len(modes)


def test_figures_need_no_display_and_no_global_state(runs: list[Path]) -> None:
    code = (
        "import sys; from sgim.figures import error_curves\n"
        f"error_curves([{str(runs[0])!r}]).savefig(sys.stdout.buffer)\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, timeout=60)
    assert done.stdout.startswith(b"\x89PNG")
