"""The air hockey table is drawn with what happens on it."""

import io

import numpy as np
import pytest

from sgim.environments import AirHockey
from sgim.errors import SgimError
from sgim.figures import hockey_shots
from sgim.spaces import FloatArray

STRAIGHT_BACK = np.array([*[0.05, -0.5] * 5, *[0.2] * 4])
OUT_OF_THE_WAY = np.array([*[-0.8, 0.8] * 5, *[0.2] * 4])


def random_policies(count: int) -> FloatArray:
    rng = np.random.default_rng(0)
    return np.array([AirHockey().task.policy_space.sample(rng) for _ in range(count)])


def test_every_movement_has_a_panel_that_says_how_it_ended() -> None:
    figure = hockey_shots([STRAIGHT_BACK, OUT_OF_THE_WAY])
    assert [axes.get_title() for axes in figure.axes] == ["hit at 0.05", "not touched"]
    (legend,) = figure.legends
    assert {"puck", "obstacle"} < {text.get_text() for text in legend.get_texts()}


def test_a_panel_has_the_paths_and_the_circles_of_a_hit() -> None:
    hit, missed = hockey_shots([STRAIGHT_BACK, OUT_OF_THE_WAY]).axes
    paths = [line.get_xydata() for line in hit.lines]
    assert any(np.allclose(path, [[0.05, 0], [0.05, -0.35], [0.05, 1]]) for path in paths
               if np.shape(path) == (3, 2))  # fmt: skip
    # Table and obstacle, then where the puck ended, and mallet and puck where they met.
    assert len(hit.patches) == 2 + 1 + 2
    assert len(missed.patches) == 2 + 1


def test_a_free_table_is_drawn_without_the_obstacle() -> None:
    (axes,) = hockey_shots([OUT_OF_THE_WAY], AirHockey(obstacle=None)).axes
    assert len(axes.patches) == 1 + 1


@pytest.mark.parametrize("count", [1, 5, 12])
def test_any_number_up_to_twelve_can_be_laid_out(count: int) -> None:
    stream = io.BytesIO()
    hockey_shots(random_policies(count)).savefig(stream, format="png", dpi=40)
    assert stream.getvalue().startswith(b"\x89PNG")


@pytest.mark.parametrize("count", [0, 13])
def test_too_many_or_too_few_are_refused(count: int) -> None:
    with pytest.raises(SgimError, match=f"{count} movements came, expected 1 to 12"):
        hockey_shots(random_policies(count))
