"""Figures of recognition have the panels, lines and rows that they promise."""

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from sgim.environments import PlanarArm
from sgim.events import Evaluated
from sgim.figures import contact_sheet, database, f_measures, recognised
from sgim.figures.style import NothingToDrawError
from sgim.recognition import FEATURES
from sgim.runs.summary import Openings, RecordedRun
from sgim.spaces import Choices
from sgim.task import Task

TOYS = ("cubes", "dog")
LABELS = Choices(TOYS)
TASK = Task(LABELS, {"view": FEATURES, "toy": LABELS}, goal_spaces={"toy": LABELS})


def run(learner: str, seed: int = 0) -> RecordedRun:
    missed = ((1.0, 1.0), (0.5, 0.25), (0.25, 0.0))
    evaluations = tuple(
        Evaluated(
            movements,
            {"cubes": a, "dog": b, "taken for cubes": b, "taken for dog": a, "total": (a + b) / 2},
        )
        for movements, (a, b) in enumerate(missed)
    )
    recipe = {"configuration": {"name": "modern"}, "seed": seed}
    return RecordedRun(
        Path(f"{learner}-{seed}.sgim"),
        {"experiment": "objects", "learner": learner, "recipe": recipe},
        2,
        {"pictures": dict.fromkeys(TOYS, 64), "digest": "00"},
        evaluations,
        task=TASK,
        movements=2,
        openings=Openings(np.arange(2), ["push", "lift"], ["toy", "toy"], ["cubes", "dog"]),
        troubles={},
    )


def saved(figure: Figure) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=40)
    return stream.getvalue()


def test_recognised_pictures_have_a_panel_a_caregiver_and_a_line_a_learner() -> None:
    runs = [run(f"{name}:{c}", s) for name in ("sgim-acts", "random") for c in ("a", "b")
            for s in range(3)]  # fmt: skip
    figure = recognised(runs)
    assert [axes.get_title() for axes in figure.axes] == ["caregiver: a", "caregiver: b"]
    for axes in figure.axes:
        assert {line.get_label() for line in axes.lines} == {
            "sgim-acts (3 runs)",
            "random (3 runs)",
        }
        assert np.allclose(axes.lines[0].get_ydata(), [0, 40, 56])
    assert saved(figure)


def test_f_measures_have_a_line_a_toy_and_below_what_was_manipulated() -> None:
    upper, lower = f_measures(run("sgim-acts:a")).axes
    cubes, dog = upper.lines
    assert np.allclose(cubes.get_ydata(), [0, 1 / 1.75, 1.5 / 1.75])
    assert np.allclose(dog.get_ydata(), [0, 1.5 / 2.25, 2 / 2.25])
    assert [tick.get_text() for tick in lower.get_yticklabels()] == list(TOYS)
    assert [list(map(tuple, points.get_offsets())) for points in lower.collections] == [
        [(0.0, 0.0)],
        [(1.0, 1.0)],
    ]


def test_runs_that_were_not_measured_by_pictures_have_no_such_figures() -> None:
    other = replace(run("sagg-riac"), task=PlanarArm().task, benchmark={"goals": {"hand": 9}})
    for draw in (recognised, lambda runs: f_measures(runs[0])):
        with pytest.raises(NothingToDrawError, match="no run was measured by pictures"):
            draw([other])


def test_toys_and_pictures_are_drawn() -> None:
    sheet = contact_sheet()
    assert len(sheet.axes) == 4 * 5
    assert [axes.get_title() for axes in sheet.axes[:5]] == ["cubes", "car", "dog", "ball", "bear"]
    assert saved(sheet)
    pictures = database(count=10)
    assert sum(axes.get_visible() for axes in pictures.axes) == 10
    images = [axes.images[0].get_array() for axes in pictures.axes[:2]]
    assert not np.array_equal(*images)
