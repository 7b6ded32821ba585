import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.integrate import solve_ivp

from sgim.environments import ThrowingArm
from sgim.environments.throwing import flight, swing
from sgim.errors import SpaceError
from sgim.records import Outcome
from sgim.spaces import FloatArray

ARM = ThrowingArm()
SPACE = ARM.task.policy_space


def random_policies(count: int, seed: int = 0) -> FloatArray:
    rng = np.random.default_rng(seed)
    policies = rng.random((count, 14))
    policies[:, ::2] = 10 * policies[:, ::2] - 5
    return policies


def policy_of(*segments: tuple[float, float]) -> FloatArray:
    """A policy that begins with (acceleration, duration) pairs and then lasts no longer."""
    policy = np.zeros(14)
    policy[: 2 * len(segments)] = np.ravel(segments)
    return policy


def same(one: Outcome, other: Outcome) -> bool:
    return one.keys() == other.keys() and all(
        one[kind].tobytes() == other[kind].tobytes() for kind in one
    )


within_bounds = st.tuples(
    arrays(np.float64, 7, elements=st.floats(-5, 5)),
    arrays(np.float64, 7, elements=st.floats(0, 1)),
).map(lambda pair: np.stack(pair, axis=1).ravel())


@given(st.lists(within_bounds, min_size=1, max_size=20))
def test_a_batch_gives_bit_for_bit_what_single_movements_give(policies: list[FloatArray]) -> None:
    batch = ARM.execute_batch(policies)
    assert all(same(ARM.execute(p), o) for p, o in zip(policies, batch, strict=True))


def test_a_large_batch_gives_bit_for_bit_what_single_movements_give() -> None:
    policies = random_policies(5000)
    policies[::50, 1::2] *= 1e-3
    batch = ARM.execute_batch(policies)
    assert {kind for outcome in batch for kind in outcome} == {"throw", "place"}
    assert all(same(ARM.execute(p), o) for p, o in zip(policies, batch, strict=True))


def test_an_empty_batch_gives_nothing() -> None:
    assert ARM.execute_batch([]) == []


@pytest.mark.parametrize("policy", random_policies(5, seed=1))
def test_the_swing_is_what_integrating_the_acceleration_gives(policy: FloatArray) -> None:
    angle = speed = 0.0
    for acceleration, duration in policy.reshape(7, 2):

        def motion(t: float, y: FloatArray, a: float = acceleration) -> list[float]:
            return [y[1], a]

        piece = solve_ivp(motion, (0, duration), [angle, speed], rtol=1e-10)
        angle, speed = piece.y[:, -1]
    angles, speeds = swing(policy[None])
    assert angles[0] == pytest.approx(angle, abs=1e-8)
    assert speeds[0] == pytest.approx(speed, abs=1e-8)


@pytest.mark.parametrize("policy", random_policies(10, seed=2))
def test_the_flight_is_what_integrating_gravity_gives(policy: FloatArray) -> None:
    angles, speeds = swing(policy[None])
    angle, speed = float(angles[0]), float(speeds[0])
    start = [math.cos(angle), 1 + math.sin(angle)]
    velocity = [-speed * math.sin(angle), speed * math.cos(angle)]

    def ground(t: float, y: FloatArray) -> float:
        return float(y[1])

    ground.terminal = True  # type: ignore[attr-defined]
    ground.direction = -1  # type: ignore[attr-defined]
    path = solve_ivp(
        lambda t, y: [y[2], y[3], 0.0, -9.81],
        (0, 100),
        [*start, *velocity],
        events=ground,
        rtol=1e-10,
        max_step=0.001 + abs(speed) * 0.001,
    )
    landing = path.y[0, -1] if path.y[0, -1] <= 10 else 20 - path.y[0, -1]
    distance, height = ARM.execute(policy)["throw"]
    assert distance == pytest.approx(landing, abs=1e-6)
    assert height == pytest.approx(path.y[1].max(), abs=1e-3)


def test_a_ball_thrown_straight_up_comes_down_where_it_left() -> None:
    [[distance, height]] = flight(np.array([0.0]), np.array([4.0]))
    assert distance == pytest.approx(1.0)
    assert height == pytest.approx(1 + 4**2 / (2 * 9.81))


def test_a_ball_thrown_level_from_the_top_falls_two_metres() -> None:
    [[distance, height]] = flight(np.array([np.pi / 2]), np.array([-3.0]))
    assert distance == pytest.approx(3 * math.sqrt(2 * 2 / 9.81))
    assert height == pytest.approx(2.0)


def test_a_ball_that_leaves_downwards_was_highest_at_release() -> None:
    [[_, height]] = flight(np.array([0.0]), np.array([-4.0]))
    assert height == 1.0


def test_a_ball_let_go_on_the_ground_stays_there() -> None:
    [[distance, height]] = flight(np.array([-np.pi / 2]), np.array([3.0]))
    assert distance == pytest.approx(0.0, abs=1e-12)
    assert height == pytest.approx(0.0, abs=1e-12)


def test_a_ball_that_would_land_behind_the_wall_bounces_back() -> None:
    angles, speeds = np.array([2.4, 2.4]), np.array([-9.0, -10.5])
    times = (speeds * np.cos(angles) + np.sqrt((speeds * np.cos(angles)) ** 2
        + 2 * 9.81 * (1 + np.sin(angles)))) / 9.81  # fmt: skip
    free = np.cos(angles) - speeds * np.sin(angles) * times
    assert free[0] < 10 < free[1]
    landings = flight(angles, speeds)[:, 0]
    np.testing.assert_allclose(landings, [free[0], 20 - free[1]])


def test_the_ball_is_placed_only_below_the_placing_speed() -> None:
    assert set(ARM.execute(policy_of((0.00999, 1.0)))) == {"place"}
    assert set(ARM.execute(policy_of((-0.00999, 1.0)))) == {"place"}
    assert set(ARM.execute(policy_of((0.01, 1.0)))) == {"throw"}


@pytest.mark.parametrize("angle", [0.5, 2.0, 3.0, 3.5, 6.0, -3.0, -3.5])
def test_a_placed_angle_is_wrapped(angle: float) -> None:
    c = angle / 2
    [placed] = ARM.execute(policy_of((c, 1.0), (0, 0.5), (-c, 1.0)))["place"]
    reached = 1.5 * c
    assert -np.pi < placed <= np.pi
    assert placed == pytest.approx((reached + np.pi) % (2 * np.pi) - np.pi)


def test_half_a_turn_either_way_is_placed_at_plus_pi() -> None:
    c = math.pi / 2
    for sign in (1, -1):
        policy = policy_of((sign * c, 1.0), (0, 1.0), (-sign * c, 1.0))
        assert swing(policy[None])[0] == sign * math.pi
        assert ARM.execute(policy)["place"] == math.pi


def test_about_one_random_movement_in_five_hundred_places() -> None:
    _, speeds = swing(random_policies(200_000, seed=3))
    assert np.mean(np.abs(speeds) < 0.01) == pytest.approx(0.0019, abs=0.0004)


def test_outcomes_are_points_of_the_task() -> None:
    for policy in random_policies(20):
        ARM.task.check_policy(policy)
        ARM.task.check_outcome(ARM.execute(policy, None, None))
    assert ARM.deterministic
    assert ARM.sample_context(np.random.default_rng(0)) is None


@pytest.mark.parametrize("policy", [np.zeros(13), np.zeros((1, 14)), 3.0])
def test_a_policy_of_another_shape_is_refused(policy: FloatArray) -> None:
    with pytest.raises(SpaceError, match="policy has shape"):
        ARM.execute(policy)


@pytest.mark.parametrize("policies", [np.zeros((2, 13)), np.zeros(14)])
def test_a_batch_of_another_shape_is_refused(policies: FloatArray) -> None:
    with pytest.raises(SpaceError, match=r"expected \(n, 14\)"):
        ARM.execute_batch(policies)
