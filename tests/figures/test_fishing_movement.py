"""The picture of a movement shows the rig, where the float went, and where it landed."""

import io

import numpy as np
import pytest

from sgim.environments import FishingRod
from sgim.errors import SpaceError
from sgim.figures import fishing_movement

FAST = FishingRod(0.0)


def test_a_movement_is_drawn_until_the_float_lands() -> None:
    policies = np.random.default_rng(0).random((10, 25))
    policy = next(p for p in policies if FAST.execute(p))
    x, y = FAST.execute(policy)["float"]
    figure = fishing_movement(policy, FAST)
    side, above = figure.axes
    assert [side.get_xlabel(), side.get_ylabel()] == ["y (m)", "height (m)"]
    assert [above.get_xlabel(), above.get_ylabel()] == ["x (m)", "y (m)"]
    assert f"({x:.1f}"[:4] in figure.get_suptitle()
    landed = above.lines[-1].get_xydata()[0]
    np.testing.assert_allclose(landed, [x, y], atol=0.1)
    figure.savefig(io.BytesIO(), format="png", dpi=40)


def test_a_movement_that_does_not_land_says_so() -> None:
    figure = fishing_movement(np.append(np.full(24, 0.5), 0.0), FAST)
    assert "has not landed" in figure.get_suptitle()


def test_a_malformed_policy_is_refused() -> None:
    with pytest.raises(SpaceError, match="policy has shape"):
        fishing_movement(np.zeros(3), FAST)
