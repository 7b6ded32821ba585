import numpy as np
import pytest

from sgim.environments import FishingFloor
from sgim.environments.fishing.floor import FAR, MOVEMENTS, VIEW_LOW
from sgim.environments.fishing.model import BALL_RADIUS, FLOOR
from sgim.environments.fishing.movement import AMPLITUDES, HOME
from sgim.environments.fishing.simulator import Simulator
from sgim.errors import SpaceError
from sgim.spaces import FloatArray
from sgim.testing import check_environment

STILL = FishingFloor(0.0)
LOWERED = np.radians([0.0, 70.0, -110.0, 0.0, 0.0, 0.0])


def policy_to(posture: FloatArray) -> FloatArray:
    """A policy that leads the arm from home to a posture, and stays there."""
    way = np.array([0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0])
    points = way[:, None] * (posture - HOME) / AMPLITUDES
    return np.clip((points.ravel() + 1) / 2, 0, 1)


def test_it_keeps_the_promises_of_a_world() -> None:
    check_environment(FishingFloor(), trials=3)


def test_it_has_54_parameters_and_the_view_is_the_unit_square() -> None:
    assert STILL.task.policy_space.dimension == 54
    box = STILL.task.outcome_spaces["ball"].describe()
    assert (box["low"], box["high"]) == ([0, 0], [1, 1])


def test_a_ball_in_the_air_counts_as_100_away() -> None:
    home = STILL.execute(np.full(54, 0.5))["ball"]
    np.testing.assert_array_equal(home, FAR)
    assert np.linalg.norm(home - [0.5, 0.5]) == 100


def test_a_ball_that_is_lowered_comes_to_rest_on_the_floor_in_view() -> None:
    seen = STILL.execute(policy_to(LOWERED))["ball"]
    assert STILL.task.outcome_spaces["ball"].contains(seen)
    simulator = Simulator(FLOOR)
    times = np.arange(800) * simulator.step
    position, speed = simulator.end(MOVEMENTS.positions([policy_to(LOWERED)], times)[0])
    assert position[2] == pytest.approx(FLOOR.floor + BALL_RADIUS, abs=0.003)  # type: ignore[operator]
    assert speed < 0.02
    np.testing.assert_allclose(seen, position[:2] - VIEW_LOW, atol=1e-9)


def test_a_ball_that_moves_or_lies_out_of_view_counts_as_100_away() -> None:
    lying = np.array([0.1, 0.4, STILL._lying])
    np.testing.assert_allclose(STILL._seen(lying, 0.0), [0.6, 0.4])
    np.testing.assert_array_equal(STILL._seen(lying, 0.1), FAR)
    np.testing.assert_array_equal(STILL._seen(np.array([0.6, 0.4, lying[2]]), 0.0), FAR)
    np.testing.assert_array_equal(STILL._seen(np.array([0.1, 0.4, lying[2] + 0.01]), 0.0), FAR)


def test_bad_arguments_are_refused() -> None:
    with pytest.raises(SpaceError, match="noise is -1"):
        FishingFloor(-1.0)
    with pytest.raises(SpaceError, match="policy has shape"):
        STILL.execute(np.zeros(25))
    with pytest.raises(SpaceError, match="needs the trial's generator"):
        FishingFloor().execute(np.zeros(54))
