import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.errors import SpaceError
from sgim.primitives import EvenlySpaced, Intervals, ViaPoints
from sgim.records import Trajectory
from sgim.spaces import Box, FloatArray

LIMITS = np.radians([84, 42, 42, 63, 42, 31.5])
ARM = ViaPoints(
    Box(-LIMITS, LIMITS, names=["base", "shoulder", "elbow", "roll", "wrist", "hand"], unit="rad"),
    EvenlySpaced(points=4, shortest=0.8, longest=3.0),
    scaled=True,
)
MALLET = ViaPoints(
    Box([-1, -1], [1, 1], names=["x", "y"], unit="m"),
    Intervals(points=5, shortest=0.05, longest=0.5, sharpness=16.0),
)
FIXED = ViaPoints(
    Box([-2, -2], [2, 2], names=["shoulder", "elbow"], unit="rad"),
    EvenlySpaced(points=9, shortest=1.0, longest=1.0, width=1 / 16),
    scaled=True,
)
PRIMITIVES = {"arm": ARM, "mallet": MALLET}
BOTH = pytest.mark.parametrize("primitive", PRIMITIVES.values(), ids=PRIMITIVES.keys())


def sample(primitive: ViaPoints, count: int = 1, seed: int = 0) -> FloatArray:
    rng = np.random.default_rng(seed)
    return np.array([primitive.policy_space.sample(rng) for _ in range(count)])


def test_policies_have_the_numbers_that_both_worlds_need() -> None:
    assert ARM.policy_space.dimension == 6 * 4 + 1
    assert (ARM.policy_space.low == 0).all()
    assert (ARM.policy_space.high == 1).all()
    assert MALLET.policy_space.dimension == 5 * 2 + 4
    assert MALLET.policy_space.names[:3] == ("x_1", "y_1", "x_2")
    assert MALLET.policy_space.names[-1] == "interval_4"
    assert MALLET.policy_space.units[9:11] == ("m", "s")


def test_positions_are_the_weighted_mean_of_the_via_points() -> None:
    policy = sample(MALLET)[0]
    points, instants = policy[:10].reshape(5, 2), np.append(0.0, np.cumsum(policy[10:]))
    for time in (0.0, 0.3, instants[-1]):
        weights = np.exp(-16.0 * np.abs(time - instants) ** 2)
        expected = (weights[:, None] * points).sum(axis=0) / weights.sum()
        np.testing.assert_allclose(MALLET.positions(policy[None], [time])[0, 0], expected)


def test_the_width_of_the_weights_is_a_share_of_the_duration() -> None:
    policy = sample(ARM)[0]
    points = (2 * policy[:24].reshape(4, 6) - 1) * LIMITS
    duration = 0.8 + 2.2 * policy[24]
    assert ARM.durations(policy[None])[0] == pytest.approx(duration)
    offsets = 0.4 * duration - np.arange(4) / 3 * duration
    weights = np.exp(-(offsets**2) / (2 * (duration / 6) ** 2))
    expected = (weights[:, None] * points).sum(axis=0) / weights.sum()
    np.testing.assert_allclose(ARM.positions(policy[None], [0.4 * duration])[0, 0], expected)


@BOTH
def test_many_movements_give_bit_for_bit_what_single_ones_give(primitive: ViaPoints) -> None:
    policies, times = sample(primitive, 37), np.linspace(-0.5, 3.5, 101)
    together = primitive.positions(policies, times)
    assert together.shape == (37, 101, len(primitive.joints))
    for policy, positions in zip(policies, together, strict=True):
        assert (primitive.positions(policy[None], times)[0] == positions).all()


@BOTH
def test_each_movement_can_have_times_of_its_own(primitive: ViaPoints) -> None:
    policies = sample(primitive, 3)
    times = np.random.default_rng(0).uniform(0, 3, (3, 20))
    together = primitive.positions(policies, times)
    for policy, own, positions in zip(policies, times, together, strict=True):
        np.testing.assert_array_equal(primitive.positions(policy[None], own)[0], positions)


@BOTH
@given(seed=st.integers(0, 2**32 - 1))
def test_joints_stay_within_the_bounds_of_their_via_points(primitive: ViaPoints, seed: int) -> None:
    policy = sample(primitive, seed=seed)
    positions = primitive.positions(policy, np.linspace(0, 3, 50))[0]
    bounds = LIMITS if primitive is ARM else np.ones(2)
    assert (np.abs(positions) <= bounds + 1e-12).all()


@BOTH
def test_joints_stand_still_before_and_after_the_movement(primitive: ViaPoints) -> None:
    policy = sample(primitive)
    end = primitive.durations(policy)[0]
    before, start, last, after = primitive.positions(policy, [-1.0, 0.0, end, end + 9])[0]
    np.testing.assert_array_equal(before, start)
    np.testing.assert_array_equal(after, last)


def test_equal_via_points_are_a_joint_at_rest() -> None:
    policy = np.array([*[0.3, -0.7] * 5, 0.2, 0.2, 0.2, 0.2])
    positions = MALLET.positions(policy[None], np.linspace(0, 2, 9))[0]
    np.testing.assert_allclose(positions, np.tile([0.3, -0.7], (9, 1)), rtol=1e-15)


@BOTH
@pytest.mark.parametrize("seed", range(8))
def test_a_policys_own_trajectory_is_recovered(primitive: ViaPoints, seed: int) -> None:
    policy = sample(primitive, seed=seed)[0]
    trajectory = primitive.trajectory(policy, rate=50)
    fitted, residual = primitive.fit(trajectory)
    assert residual < 1e-6
    assert primitive.policy_space.contains(fitted)
    again = primitive.trajectory(fitted, rate=50)
    np.testing.assert_allclose(again.positions, trajectory.positions, atol=1e-5)
    assert again.times[-1] == pytest.approx(trajectory.times[-1])


@BOTH
def test_a_noisy_movement_is_fitted_to_the_noise(primitive: ViaPoints) -> None:
    clean = primitive.trajectory(sample(primitive, seed=1)[0], rate=100)
    noise = np.random.default_rng(0).normal(0, 0.01, clean.positions.shape)
    noisy = Trajectory(clean.times, clean.positions + noise, clean.joints, clean.unit)
    fitted, residual = primitive.fit(noisy)
    assert residual == pytest.approx(0.01, rel=0.15)
    gap = primitive.positions(fitted[None], clean.times)[0] - clean.positions
    assert np.sqrt(np.mean(gap**2)) < 0.005


@BOTH
def test_no_other_via_points_fit_better(primitive: ViaPoints) -> None:
    times = np.linspace(0, 1.2, 60)
    shape = np.cos(np.outer(times * 5, np.arange(1, len(primitive.joints) + 1)))
    recorded = Trajectory(times, 0.5 * shape, primitive.joints, primitive.unit)
    fitted, residual = primitive.fit(recorded)
    assert residual > 0.01
    rng = np.random.default_rng(0)
    spatial = primitive.timing.points * len(primitive.joints)
    for _ in range(200):
        other = fitted.copy()
        other[:spatial] += rng.normal(0, 1e-3, spatial)
        gap = primitive.positions(primitive.policy_space.clip(other)[None], times)[0]
        rms = np.sqrt(np.mean((gap - recorded.positions) ** 2))
        assert rms >= residual - 1e-9


@BOTH
def test_movements_beyond_the_bounds_are_fitted_within_them(primitive: ViaPoints) -> None:
    times = np.linspace(0, 1, 30)
    far = np.full((30, len(primitive.joints)), 5.0)
    fitted, residual = primitive.fit(Trajectory(times, far, primitive.joints, primitive.unit))
    assert primitive.policy_space.contains(fitted)
    assert residual > 1


@BOTH
def test_a_recording_may_start_at_any_time(primitive: ViaPoints) -> None:
    clean = primitive.trajectory(sample(primitive, seed=2)[0], rate=50)
    later = Trajectory(clean.times + 100, clean.positions, clean.joints, clean.unit)
    assert primitive.fit(later)[1] < 1e-6


def test_joints_are_matched_by_name_and_degrees_converted() -> None:
    policy = sample(ARM)[0]
    clean = ARM.trajectory(policy, rate=50)
    order = [3, 0, 5, 1, 4, 2]
    names = [ARM.joints[i] for i in order]
    shuffled = Trajectory(clean.times, np.degrees(clean.positions)[:, order], names, unit="deg")
    fitted, residual = ARM.fit(shuffled)
    assert residual < 1e-6
    np.testing.assert_allclose(fitted, policy, atol=1e-6)


@BOTH
def test_two_samples_are_enough_to_fit(primitive: ViaPoints) -> None:
    still = np.zeros((2, len(primitive.joints)))
    fitted, residual = primitive.fit(Trajectory([0, 1], still, primitive.joints, primitive.unit))
    assert residual < 1e-6
    assert primitive.policy_space.contains(fitted)


@pytest.mark.parametrize(
    ("primitive", "trajectory", "message"),
    [
        (MALLET, Trajectory([0, 1], np.zeros((2, 2)), ["x", "z"], "m"), "expected x, y.*lacks y"),
        (MALLET, Trajectory([0, 1], np.zeros((2, 2)), ["x", "y"], "rad"), "in rad, expected m"),
        (MALLET, Trajectory([0, 1], np.zeros((2, 2)), ["x", "y"], "mm"), "in mm, expected m"),
        (ARM, Trajectory([0, 1], np.zeros((2, 1)), ["base"], "rad"), "lacks shoulder, elbow"),
        (ARM, Trajectory([0, 3.1], np.zeros((2, 6)), ARM.joints), "lasts 3.1 s.*0.8 to 3 s"),
        (MALLET, Trajectory([0, 0.1], np.zeros((2, 2)), ["x", "y"], "m"), "0.2 to 2 s"),
    ],
)
def test_a_trajectory_it_cannot_represent_is_refused(
    primitive: ViaPoints, trajectory: Trajectory, message: str
) -> None:
    with pytest.raises(SpaceError, match=message):
        primitive.fit(trajectory)


@BOTH
def test_the_shortest_and_longest_movements_are_fitted(primitive: ViaPoints) -> None:
    for bound in (primitive.policy_space.low, primitive.policy_space.high):
        policy = sample(primitive)[0]
        spatial = primitive.timing.points * len(primitive.joints)
        policy[spatial:] = bound[spatial:]
        fitted, residual = primitive.fit(primitive.trajectory(policy, rate=100))
        assert residual < 1e-6
        np.testing.assert_allclose(fitted[spatial:], policy[spatial:], atol=1e-6)


@pytest.mark.parametrize(
    ("policy", "rate", "message"),
    [
        (np.zeros(13), 50, "policy has shape"),
        (np.full(14, 2.0), 50, "outside its bounds"),
        (np.full(14, 0.2), 0, "rate is 0"),
    ],
)
def test_a_trajectory_that_cannot_be_made_is_refused(
    policy: FloatArray, rate: float, message: str
) -> None:
    with pytest.raises(SpaceError, match=message):
        MALLET.trajectory(policy, rate)


@pytest.mark.parametrize("policies", [np.zeros(14), np.zeros((2, 13))])
def test_policies_of_another_shape_are_refused(policies: FloatArray) -> None:
    with pytest.raises(SpaceError, match=r"expected \(n, 14\)"):
        MALLET.positions(policies, [0.0])


def test_a_fixed_duration_is_no_parameter() -> None:
    (policy,) = sample(FIXED)
    assert policy.shape == (18,)
    assert FIXED.durations(policy[None]) == 1.0
    fitted, residual = FIXED.fit(FIXED.trajectory(policy, rate=50))
    assert residual < 1e-6
    np.testing.assert_allclose(fitted, policy, atol=1e-4)
    with pytest.raises(SpaceError, match="from 1 to 1 s"):
        FIXED.fit(Trajectory([0.0, 1.5], [[0, 0], [1, 1]], FIXED.joints))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Intervals(1, 0.1, 0.5, 16.0), "points is 1"),
        (lambda: Intervals(5, 0.5, 0.5, 16.0), "shortest < longest"),
        (lambda: Intervals(5, 0.1, 0.5, 1e5), "sharpness is 100000"),
        (lambda: EvenlySpaced(4, 0.0, 3.0), "0 < shortest"),
        (lambda: EvenlySpaced(4, 0.8, 3.0, width=1e-3), "width is 0.001"),
        (lambda: ViaPoints(Box([0, 0], [1, 1]), EvenlySpaced(4, 1, 3)), "one unit for all"),
        (
            lambda: ViaPoints(Box([0, 0], [1, 1], unit=["m", "rad"]), EvenlySpaced(4, 1, 3)),
            "one unit for all",
        ),
    ],
)
def test_an_impossible_primitive_is_refused(make, message: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(SpaceError, match=message):
        make()
