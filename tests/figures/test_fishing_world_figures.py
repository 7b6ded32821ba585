"""The figures of the fishing world have what they say."""

import numpy as np
import pytest

from sgim.environments.fishing import fishing_demonstrations
from sgim.errors import SgimError
from sgim.figures.fishing_world import (
    demonstrated_joint,
    fishing_goals_and_demonstrations,
    mapped_demonstrations,
    repeated_movements,
)


def test_the_benchmark_and_three_teachers_are_drawn_side_by_side() -> None:
    figure = fishing_goals_and_demonstrations()
    assert [len(axes.lines[0].get_xdata()) for axes in figure.axes] == [355, 127, 127, 127]


def test_recorded_and_mapped_angles_are_drawn_of_every_joint() -> None:
    figure = mapped_demonstrations(fishing_demonstrations(3)[:1])
    (axes,) = figure.axes
    assert len(axes.lines) == 12
    recorded, mapped = (line.get_ydata() for line in axes.lines[:2])
    assert abs(recorded[-1] - mapped[-1]) < 5
    assert "residual" in axes.get_title()


def test_repeated_movements_are_points_of_one_colour_each() -> None:
    policies = np.random.default_rng(0).random((2, 25))
    (axes,) = repeated_movements(policies, repetitions=3).axes
    assert len(axes.lines) == 2
    assert 2 <= len(axes.lines[0].get_xdata()) <= 3


def test_one_joint_is_drawn_for_all_demonstrations_of_three_teachers() -> None:
    figure = demonstrated_joint("wrist")
    assert [len(axes.lines) for axes in figure.axes] == [127, 127, 127]
    with pytest.raises(SgimError, match="expected one of base"):
        demonstrated_joint("knee")
