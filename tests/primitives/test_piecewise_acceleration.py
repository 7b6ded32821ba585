import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.environments.throwing import swing
from sgim.errors import SpaceError
from sgim.primitives import PiecewiseAcceleration
from sgim.primitives.segment_fit import angle_basis, starting_durations
from sgim.records import Trajectory
from sgim.spaces import FloatArray

PRIMITIVE = PiecewiseAcceleration()


def random_policy(seed: int, primitive: PiecewiseAcceleration = PRIMITIVE) -> FloatArray:
    return primitive.policy_space.sample(np.random.default_rng(seed))


def add_noise(trajectory: Trajectory, sd: float) -> Trajectory:
    noise = np.random.default_rng(0).normal(0, sd, trajectory.positions.shape)
    return Trajectory(
        trajectory.times, trajectory.positions + noise, trajectory.joints, trajectory.unit
    )


@given(st.integers(0, 2**32 - 1))
def test_a_trajectory_ends_where_the_swing_ends(seed: int) -> None:
    policy = random_policy(seed)
    trajectory = PRIMITIVE.trajectory(policy, rate=50)
    angles, _ = swing(policy[None])
    assert trajectory.times[-1] == policy[1::2].sum()
    assert trajectory.positions[0, 0] == 0
    assert trajectory.positions[-1, 0] == pytest.approx(angles[0], abs=1e-9)


def test_a_trajectory_has_the_accelerations_of_its_policy() -> None:
    policy = np.stack([[5, -5, 2, 0, -1, 3, 1], np.full(7, 0.5)], axis=1).ravel()
    angles = PRIMITIVE.trajectory(policy, rate=100).positions[:, 0]
    accelerations = np.diff(angles[:351], 2) * 100**2
    np.testing.assert_allclose(accelerations[25::50], policy[::2], atol=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_a_noise_free_movement_is_fitted_almost_exactly(seed: int) -> None:
    trajectory = PRIMITIVE.trajectory(random_policy(seed), rate=50)
    policy, residual = PRIMITIVE.fit(trajectory)
    assert residual < 1e-3
    assert PRIMITIVE.policy_space.contains(policy)
    assert policy[1::2].sum() == pytest.approx(trajectory.times[-1])
    again = PRIMITIVE.trajectory(policy, rate=50).positions[-1]
    assert again == pytest.approx(trajectory.positions[-1], abs=5e-3)


@pytest.mark.parametrize("seed", range(3))
def test_a_noisy_movement_is_fitted_to_the_noise(seed: int) -> None:
    clean = PRIMITIVE.trajectory(random_policy(seed), rate=50)
    policy, residual = PRIMITIVE.fit(add_noise(clean, 0.02))
    assert residual == pytest.approx(0.02, rel=0.2)
    gap = angle_basis(clean.times, policy[1::2]) @ policy[::2] - clean.positions[:, 0]
    assert np.sqrt(np.mean(gap**2)) < 0.01


def test_a_recording_may_start_at_any_time() -> None:
    clean = PRIMITIVE.trajectory(random_policy(0), rate=50)
    later = Trajectory(clean.times + 100, clean.positions, clean.joints, clean.unit)
    policy, residual = PRIMITIVE.fit(later)
    assert residual < 1e-3
    assert policy[1::2].sum() == pytest.approx(clean.times[-1])


def test_a_recording_in_degrees_is_fitted_as_one_in_radians() -> None:
    clean = PRIMITIVE.trajectory(random_policy(0), rate=50)
    degrees = Trajectory(clean.times, np.degrees(clean.positions), clean.joints, "deg")
    _, residual = PRIMITIVE.fit(degrees)
    assert residual < 1e-3


def test_a_fit_is_deterministic() -> None:
    trajectory = add_noise(PRIMITIVE.trajectory(random_policy(1), rate=30), 0.01)
    np.testing.assert_array_equal(PRIMITIVE.fit(trajectory)[0], PRIMITIVE.fit(trajectory)[0])


def test_the_residual_tells_a_movement_that_cannot_be_made() -> None:
    times = np.linspace(0, 1, 50)
    jump = Trajectory(times, np.where(times < 0.5, 0.0, 1.0)[:, None], ["shoulder"])
    policy, residual = PRIMITIVE.fit(jump)
    assert residual > 0.05
    assert PRIMITIVE.policy_space.contains(policy)


@pytest.mark.parametrize("duration", [1e-3, 6.99, 7.0])
def test_the_shortest_and_longest_movements_are_fitted(duration: float) -> None:
    policy = np.stack([[5, -5, 5, -5, 5, -5, 0], np.full(7, duration / 7)], axis=1).ravel()
    fitted, residual = PRIMITIVE.fit(PRIMITIVE.trajectory(policy, rate=20))
    assert residual < 1e-4
    assert PRIMITIVE.policy_space.contains(fitted)
    assert fitted[1::2].sum() == pytest.approx(duration)


def test_two_samples_are_enough_to_fit() -> None:
    policy, residual = PRIMITIVE.fit(Trajectory([0, 1], [[0], [0.5]], ["shoulder"]))
    assert residual < 1e-6
    assert PRIMITIVE.policy_space.contains(policy)


def test_an_arm_at_rest_is_fitted_by_no_acceleration() -> None:
    policy, residual = PRIMITIVE.fit(
        Trajectory(np.arange(20) / 10, np.zeros((20, 1)), ["shoulder"])
    )
    assert residual == pytest.approx(0.0, abs=1e-9)
    assert PRIMITIVE.policy_space.contains(policy)


@pytest.mark.parametrize("segments", [1, 100])
def test_any_number_of_segments_can_be_fitted(segments: int) -> None:
    primitive = PiecewiseAcceleration(segments, joint="elbow")
    policy = np.stack([np.full(segments, 2.0), np.full(segments, 0.05)], axis=1).ravel()
    assert primitive.fit(primitive.trajectory(policy, rate=20))[1] < 1e-6


def test_the_first_start_finds_the_segments_of_a_noise_free_movement() -> None:
    policy = np.stack([[5, -5, 2, -4, 4, -3, 1], np.full(7, 0.5)], axis=1).ravel()
    trajectory = PRIMITIVE.trajectory(policy, rate=100)
    start = next(starting_durations(trajectory.times, trajectory.positions[:, 0], 7, 5.0, 1.0))
    np.testing.assert_allclose(start, 0.5, atol=0.1)


@pytest.mark.parametrize(
    ("trajectory", "message"),
    [
        (Trajectory([0, 1], [[0], [1]], ["elbow"]), "joints elbow in rad, expected shoulder"),
        (Trajectory([0, 1], [[0], [1]], ["shoulder"], unit="turns"), "in turns, expected"),
        (Trajectory([0, 1], [[0, 0], [1, 1]], ["shoulder", "elbow"]), "shoulder, elbow"),
        (Trajectory([0, 7.1], [[0], [1]], ["shoulder"]), "can represent 7 s"),
    ],
)
def test_a_trajectory_it_cannot_represent_is_refused(trajectory: Trajectory, message: str) -> None:
    with pytest.raises(SpaceError, match=message):
        PRIMITIVE.fit(trajectory)


@pytest.mark.parametrize(
    ("policy", "rate", "message"),
    [
        (np.zeros(14), 50, "lasts 0 s"),
        (np.full(14, 2.0), 50, "outside its bounds"),
        (np.zeros(12), 50, "policy has shape"),
        (np.full(14, 0.5), 0, "rate is 0"),
    ],
)
def test_a_trajectory_that_cannot_be_made_is_refused(
    policy: FloatArray, rate: float, message: str
) -> None:
    with pytest.raises(SpaceError, match=message):
        PRIMITIVE.trajectory(policy, rate)


def test_an_impossible_primitive_is_refused() -> None:
    with pytest.raises(SpaceError, match="segments=0"):
        PiecewiseAcceleration(segments=0)
