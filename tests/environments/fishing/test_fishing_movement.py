import numpy as np
import pytest

from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import AMPLITUDES, FISHING, HOME
from sgim.environments.fishing.noise import GAIN, WANDER, WANDER_TIME, disturbed
from sgim.spaces import FloatArray


def test_the_path_is_the_normalised_gaussian_mean_of_the_via_points() -> None:
    policy = np.random.default_rng(0).random(25)
    points = HOME + (2 * policy[:24].reshape(4, 6) - 1) * AMPLITUDES
    duration = 0.8 + policy[24] * 2.2
    times = np.linspace(0, duration, 23)
    for t, angles in zip(times, FISHING.positions(policy[None], times)[0], strict=True):
        at = np.arange(4) * duration / 3
        weights = np.exp(-((t - at) ** 2) / (2 * (duration / 6) ** 2))
        np.testing.assert_allclose(angles, weights @ points / weights.sum())


def test_the_middle_policy_stays_at_home_and_the_corners_are_the_amplitudes_away() -> None:
    middle, corner = FISHING.positions([np.full(25, 0.5), np.ones(25)], np.linspace(0, 3, 10))
    np.testing.assert_allclose(middle, np.tile(HOME, (10, 1)))
    np.testing.assert_allclose(corner - HOME, np.tile(AMPLITUDES, (10, 1)))
    np.testing.assert_allclose(np.degrees(AMPLITUDES), 0.7 * np.array([120, 60, 60, 90, 60, 45]))


def test_the_last_number_is_the_duration() -> None:
    np.testing.assert_allclose(FISHING.durations([np.zeros(25), np.ones(25)]), [0.8, 3.0])
    assert FISHING.policy_space.dimension == 25
    assert FISHING.policy_space.names[5:7] == (f"{JOINTS[5]}_1", f"{JOINTS[0]}_2")
    assert FISHING.policy_space.names[-1] == "duration"


def disturbances(factor: float, count: int) -> FloatArray:
    times = np.arange(600) * 0.005
    away = np.tile(HOME + 1.0, (600, 1))
    rng = np.random.default_rng(0)
    return np.array([disturbed(lambda t: away, times, factor, rng) - away for _ in range(count)])


def test_no_factor_no_disturbance() -> None:
    assert np.abs(disturbances(0.0, 2)).max() < 1e-12


def test_set_points_wander_with_the_stated_spread_and_memory() -> None:
    errors = disturbances(1.0, 400)
    wandering = errors[:, 300:] - errors[:, 300:].mean(axis=1, keepdims=True)
    lag = round(WANDER_TIME / 0.005)
    drift = errors[:, 300] - errors[:, 300 + lag]
    # Of an Ornstein-Uhlenbeck process, differences over its time constant: 2 σ² (1 - 1/e).
    assert drift.std() == pytest.approx(WANDER * np.sqrt(2 * (1 - np.exp(-1))), rel=0.05)
    assert wandering.std() < WANDER
    total = errors[:, -1].std()
    assert total == pytest.approx(np.hypot(WANDER, GAIN), rel=0.05)


def test_commands_come_late_from_home() -> None:
    early = disturbances(1.0, 50)[:, 0]
    np.testing.assert_allclose(early, -1.0, atol=1e-12)
    late = disturbances(1.0, 50)[:, 4]
    assert np.abs(late).max() < 0.3
