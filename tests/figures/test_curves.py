"""Lines and bands of learning curves are what their legend says, over movements and over cost."""

from pathlib import Path

import numpy as np
import pytest

from sgim.events import Answered, Told
from sgim.experiments import experiment
from sgim.figures import choices_by_kind, error_curves
from sgim.figures.style import NothingToDrawError
from sgim.runs import Journal
from sgim.runs.costs import Prices
from sgim.runs.summary import read_run
from sgim.statistics import interquartile_mean


def errors_of(paths: list[Path]) -> list[list[float]]:
    return [[e.errors["total"] for e in read_run(path).evaluations] for path in paths]


def band_of(axes) -> np.ndarray:
    """Lower and upper edge at each point, from the polygon drawn."""
    (band,) = axes.collections
    points = band.get_paths()[0].vertices
    edges: dict[float, list[float]] = {}
    for x, y in points:
        edges.setdefault(float(x), []).append(float(y))
    return np.array([[min(ys), max(ys)] for _, ys in sorted(edges.items())]).T


def test_a_curve_is_the_interquartile_mean_of_its_runs_within_its_interval(runs) -> None:
    figure = error_curves(runs[:3])
    axes = figure.axes[2]
    (line,) = axes.lines
    np.testing.assert_array_equal(line.get_xdata(), [0, 50, 100])
    np.testing.assert_allclose(line.get_ydata(), interquartile_mean(errors_of(runs[:3])))
    low, high = band_of(axes)
    assert (low <= line.get_ydata()).all()
    assert (line.get_ydata() <= high).all()
    assert low[2] < high[2]
    assert "interval" in figure.legends[0].get_title().get_text()


def test_a_curve_may_be_the_median_between_the_quartiles(runs) -> None:
    figure = error_curves(runs[:3], band="quartiles")
    low, middle, high = np.percentile(errors_of(runs[:3]), [25, 50, 75], axis=0)
    np.testing.assert_allclose(figure.axes[2].lines[0].get_ydata(), middle)
    np.testing.assert_allclose(band_of(figure.axes[2]), [low, high])
    assert "quartiles" in figure.legends[0].get_title().get_text()


def test_one_run_has_a_line_and_no_legend_of_a_band(runs) -> None:
    figure = error_curves(runs[:1])
    np.testing.assert_allclose(figure.axes[2].lines[0].get_ydata(), errors_of(runs[:1])[0])
    assert figure.legends[0].get_title().get_text() == ""


def test_runs_read_already_are_drawn_as_their_journals(runs) -> None:
    one, other = error_curves(runs[:3]), error_curves([read_run(path) for path in runs[:3]])
    for axes, same in zip(one.axes, other.axes, strict=True):
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), same.lines[0].get_ydata())


def test_a_curve_over_cost_counts_movements_and_answered_requests(runs) -> None:
    path = runs[6]  # mimicry asks once an episode
    figure = error_curves([path], prices=Prices(robot_seconds=2, person_seconds=30))
    movements = requests = 0
    expected = []
    with Journal.open(path, append=False) as journal:
        for event in journal.events(only=["told", "answered", "evaluated"]):
            movements += isinstance(event, Told)
            requests += isinstance(event, Answered)
            if not isinstance(event, Told | Answered):
                expected.append(2 * movements + 30 * requests)
    assert requests > 10
    np.testing.assert_allclose(figure.axes[0].lines[0].get_xdata() * 60, expected)
    label = "time of robot and persons (min)\n2 s a movement, 30 s a request"
    assert figure.axes[0].get_xlabel() == label


def test_there_is_no_curve_over_cost_where_the_cost_is_the_movements(runs) -> None:
    with pytest.raises(NothingToDrawError, match="nobody was asked"):
        error_curves(runs[3:6], prices=Prices())


def test_modes_for_each_kind_of_goal_are_drawn_for_learners_that_choose_both(runs) -> None:
    figure = choices_by_kind(runs)
    place, throw, whole, *_ = figure.axes  # one learner of the three chooses both
    assert place.get_ylabel() == "sgim-acts\n(3 runs)"
    openings = [read_run(path).openings for path in runs[:3]]
    pairs = [p for one in openings for p in zip(one.modes, one.kinds, strict=True)]
    placing = sum(kind == "place" for _, kind in pairs) / len(pairs)
    assert f"goal is place\n({placing:.0%} of the episodes)" in place.get_title()
    assert "goal is throw" in throw.get_title()
    names = [label.get_text() for label in whole.get_yticklabels()]
    lengths = {
        (mode, kind): bar.get_width()
        for kind, bars in zip(("place", "throw"), whole.containers, strict=True)
        for mode, bar in zip(names, bars, strict=True)
    }
    for pair in lengths:
        assert lengths[pair] == pytest.approx(pairs.count(pair) / len(pairs))
    assert sum(lengths.values()) == pytest.approx(1)


def test_there_is_nothing_to_draw_where_nobody_chooses_modes_and_kinds(runs, tmp_path) -> None:
    with pytest.raises(NothingToDrawError, match="no learner chose"):
        choices_by_kind(runs[3:])
    with experiment("arm").start("sagg-riac", tmp_path / "a.sgim") as run:
        run.go(20)
    with pytest.raises(NothingToDrawError, match="no learner chose"):
        choices_by_kind([tmp_path / "a.sgim"])
