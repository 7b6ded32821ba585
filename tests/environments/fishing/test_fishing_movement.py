import numpy as np
import pytest

from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import (
    AMPLITUDES,
    FISHING,
    HOME,
    PRIMITIVE,
    Encoding,
    via_point_path,
)
from sgim.environments.fishing.noise import GAIN, WANDER, WANDER_TIME, disturbed
from sgim.spaces import FloatArray


def test_the_path_is_the_normalised_gaussian_mean_of_the_via_points() -> None:
    points = np.random.default_rng(0).normal(size=(4, 6))
    duration = 1.7
    times = np.linspace(0, duration, 23)
    for t, angles in zip(times, via_point_path(points, duration, times), strict=True):
        at = np.arange(4) * duration / 3
        weights = np.exp(-((t - at) ** 2) / (2 * (duration / 6) ** 2))
        np.testing.assert_allclose(angles, weights @ points / weights.sum())


def test_after_the_duration_the_last_angles_are_held() -> None:
    points = np.random.default_rng(1).normal(size=(4, 6))
    held = via_point_path(points, 1.0, np.array([1.0, 1.2, 5.0]))
    np.testing.assert_array_equal(held, held[[0, 0, 0]])


def test_the_middle_policy_stays_at_home_and_the_corners_are_the_amplitudes_away() -> None:
    times = np.linspace(0, 3, 10)
    np.testing.assert_allclose(FISHING.path(np.full(25, 0.5), times), np.tile(HOME, (10, 1)))
    np.testing.assert_allclose(
        FISHING.path(np.ones(25), times) - HOME, np.tile(AMPLITUDES, (10, 1))
    )
    np.testing.assert_allclose(np.degrees(AMPLITUDES), 0.7 * np.array([120, 60, 60, 90, 60, 45]))


def test_the_last_number_is_the_duration() -> None:
    assert FISHING.duration(np.zeros(25)) == pytest.approx(0.8)
    assert FISHING.duration(np.ones(25)) == pytest.approx(3.0)
    assert FISHING.policy_space.dimension == 25
    assert FISHING.policy_space.names[5:7] == (f"{JOINTS[5]}_1", f"{JOINTS[0]}_2")
    assert FISHING.policy_space.names[-1] == "duration"


def test_an_encoding_of_fixed_duration_has_no_number_for_it() -> None:
    fixed = Encoding(via_points=9, shortest=2.0, longest=2.0)
    assert fixed.policy_space.dimension == 54
    assert fixed.duration(np.zeros(54)) == 2.0


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


def test_the_primitive_of_the_task_is_the_same_encoding() -> None:
    policies = np.random.default_rng(2).random((5, 25))
    times = np.linspace(0, 4, 50)
    assert PRIMITIVE.policy_space.describe() == FISHING.policy_space.describe()
    for policy, angles in zip(policies, PRIMITIVE.positions(policies, times), strict=True):
        np.testing.assert_allclose(FISHING.path(policy, times), angles, atol=1e-12)
