import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sgim.environments.hockey_collisions import Block, border_contact, mallet_contacts, reflected
from sgim.errors import SpaceError
from sgim.spaces import FloatArray

BLOCK = Block(left=0.35, bottom=0.25, right=1.0, top=0.40)
RADIUS = 0.05
speeds = st.floats(-3, 3)
places = st.floats(-1, 1)
angles = st.floats(-math.pi, math.pi)


def distance_to_block(x: float, y: float) -> float:
    dx = max(BLOCK.left - x, 0.0, x - BLOCK.right)
    dy = max(BLOCK.bottom - y, 0.0, y - BLOCK.top)
    return math.hypot(dx, dy)


def one_mallet(
    puck: tuple[float, ...], times: list[float], path: list[list[float]], since: float = 0.0
) -> tuple[float, FloatArray, FloatArray]:
    """When a puck (x, y, vx, vy) meets a mallet at a distance of 0.15 from its centre."""
    mallets = np.array(path, dtype=float).T[:, None, :]
    state = np.array(puck, dtype=float)[:, None]
    when, apart, velocity = mallet_contacts(
        state, np.array([since]), np.array(times), mallets, 0.15
    )
    return float(when[0]), apart[:, 0], velocity[:, 0]


# Reflection.


@given(vx=speeds, vy=speeds, angle=angles)
def test_a_wall_at_rest_keeps_the_speed_and_mirrors_the_direction(
    vx: float, vy: float, angle: float
) -> None:
    normal = (math.cos(angle), math.sin(angle))
    rx, ry = reflected((vx, vy), normal, (0.0, 0.0))
    assert math.hypot(rx, ry) == pytest.approx(math.hypot(vx, vy))
    assert rx * normal[0] + ry * normal[1] == pytest.approx(-(vx * normal[0] + vy * normal[1]))
    assert ry * normal[0] - rx * normal[1] == pytest.approx(vy * normal[0] - vx * normal[1])


@given(v=speeds, u=speeds)
def test_a_heavy_wall_met_head_on_adds_twice_its_velocity(v: float, u: float) -> None:
    assert reflected((0.0, v), (0.0, 1.0), (0.0, u)) == (0.0, pytest.approx(2 * u - v))


@given(vx=speeds, vy=speeds, ux=speeds, uy=speeds, angle=angles)
def test_the_speed_relative_to_a_moving_wall_is_kept(
    vx: float, vy: float, ux: float, uy: float, angle: float
) -> None:
    rx, ry = reflected((vx, vy), (math.cos(angle), math.sin(angle)), (ux, uy))
    assert math.hypot(rx - ux, ry - uy) == pytest.approx(math.hypot(vx - ux, vy - uy))


# Borders.


@given(x=places, y=places, vx=speeds, vy=speeds)
def test_the_border_is_met_where_the_line_leaves_the_square(
    x: float, y: float, vx: float, vy: float
) -> None:
    assume(max(abs(vx), abs(vy)) > 1e-3)
    delay, nx, ny = border_contact(x, y, vx, vy)
    end = np.array([x + vx * delay, y + vy * delay])
    assert np.abs(end).max() == pytest.approx(1.0)
    assert (nx, ny) @ end == pytest.approx(-1.0)
    assert vx * nx + vy * ny < 0


def test_a_puck_at_rest_never_meets_the_border() -> None:
    assert border_contact(0.3, 0.2, 0.0, 0.0)[0] == math.inf


# The block.


@pytest.mark.parametrize(
    ("start", "velocity", "expected"),
    [
        ((0.1, 0.3), (0.5, 0.0), (0.4, -1.0, 0.0)),  # its left side
        ((0.7, 0.0), (0.0, 1.0), (0.2, 0.0, -1.0)),  # from below
        ((0.7, 0.9), (0.0, -0.5), (0.9, 0.0, 1.0)),  # from above
        ((0.7, 0.9), (0.0, 0.5), (math.inf, 0.0, 0.0)),  # away
        ((0.1, 0.1), (0.5, 0.0), (math.inf, 0.0, 0.0)),  # past it
    ],
)
def test_the_sides_of_the_block_are_met_a_radius_away(
    start: tuple[float, float], velocity: tuple[float, float], expected: tuple[float, ...]
) -> None:
    assert BLOCK.contact(*start, *velocity, RADIUS) == pytest.approx(expected)


def test_a_corner_is_met_on_the_circle_about_it() -> None:
    # Straight at the corner along the diagonal: back where it came from.
    delay, nx, ny = BLOCK.contact(0.15, 0.05, 1.0, 1.0, RADIUS)
    assert delay == pytest.approx(0.2 - RADIUS / math.sqrt(2))
    assert (nx, ny) == pytest.approx((-math.sqrt(0.5), -math.sqrt(0.5)))


@given(x=places, y=places, angle=angles)
def test_the_block_is_met_where_the_line_first_comes_within_a_radius(
    x: float, y: float, angle: float
) -> None:
    assume(distance_to_block(x, y) > RADIUS + 1e-6)
    vx, vy = math.cos(angle), math.sin(angle)
    delay, nx, ny = BLOCK.contact(x, y, vx, vy, RADIUS)
    gaps = [distance_to_block(x + vx * t, y + vy * t) for t in np.linspace(0, min(delay, 3), 200)]
    assert min(gaps) >= RADIUS - 1e-9
    if delay < math.inf:
        assert gaps[-1] == pytest.approx(RADIUS) or delay > 3
        assert math.hypot(nx, ny) == pytest.approx(1.0)
        assert vx * nx + vy * ny <= 0


def test_an_empty_block_is_refused() -> None:
    with pytest.raises(SpaceError, match="left < right"):
        Block(0.5, 0.0, 0.5, 1.0)


# The mallet.


def test_a_mallet_at_rest_is_met_when_the_centres_are_a_contact_apart() -> None:
    when, apart, velocity = one_mallet((0, 0, 0, -0.5), [0, 1, 2], [[0, -0.4]] * 3)
    assert when == pytest.approx(0.5)
    np.testing.assert_allclose(apart, [0, 0.15], atol=1e-12)
    np.testing.assert_array_equal(velocity, [0, 0])


def test_a_mallet_met_off_its_middle_turns_the_normal() -> None:
    # Its centre is 0.09 to the side: contact at a height of √(0.15² − 0.09²) = 0.12 above it.
    when, apart, _ = one_mallet((0.09, 0, 0, -0.5), [0, 2], [[0, -0.4]] * 2)
    assert when == pytest.approx(0.28 / 0.5)
    np.testing.assert_allclose(apart, [0.09, 0.12], atol=1e-12)


def test_a_moving_mallet_is_met_head_on_at_their_closing_speed() -> None:
    when, apart, velocity = one_mallet((0, 0, 0, -0.5), [0, 1], [[0, -0.6], [0, 0.4]])
    assert when == pytest.approx((0.6 - 0.15) / 1.5)
    np.testing.assert_allclose(velocity, [0, 1])
    vx, vy = reflected((0.0, -0.5), tuple(apart / np.hypot(*apart)), tuple(velocity))
    assert (vx, vy) == pytest.approx((0.0, 2.5))


def test_a_mallet_catches_up_with_a_puck() -> None:
    path = [[0, -0.5], [0, -0.5], [0, 1.5]]
    when, _, velocity = one_mallet((0, 0, 0, 0.5), [0, 1, 2], path)
    # From 1 s on the gap of 1.0 closes at 1.5 m/s.
    assert when == pytest.approx(1 + (1.0 - 0.15) / 1.5)
    np.testing.assert_allclose(velocity, [0, 2])


def test_a_mallet_that_passes_between_samples_is_met() -> None:
    when, _, _ = one_mallet((0, 0, 0, 0), [0, 1], [[-1, 0.1], [1, 0.1]])
    assert when == pytest.approx(0.5 - math.sqrt(0.15**2 - 0.1**2) / 2)


@pytest.mark.parametrize("height", [0.1501, 0.5])
def test_a_mallet_that_passes_by_is_not_met(height: float) -> None:
    assert one_mallet((0, 0, 0, 0), [0, 1], [[-1, height], [1, height]])[0] == math.inf


def test_only_what_comes_after_the_flight_began_counts() -> None:
    path = [[-1, 0], [1, 0], [1, 0], [-1, 0]]
    assert one_mallet((0, 0, 0, 0), [0, 1, 2, 3], path, since=0.0)[0] == pytest.approx(0.425)
    assert one_mallet((0, 0, 0, 0), [0, 1, 2, 3], path, since=0.6)[0] == pytest.approx(2.425)


def test_a_puck_beneath_a_mallet_is_met_only_after_they_have_been_apart() -> None:
    out_and_back = [[-0.1, 0], [0.1, 0], [0.5, 0], [-0.5, 0]]
    when, _, _ = one_mallet((0, 0, 0, 0), [0, 1, 2, 3], out_and_back)
    assert when == pytest.approx(2 + 0.35)


@given(seed=st.integers(0, 2**32 - 1))
def test_contacts_of_many_pucks_are_those_of_each(seed: int) -> None:
    rng = np.random.default_rng(seed)
    times, n = np.linspace(0, 2, 9), 12
    mallets = rng.uniform(-1, 1, (2, n, 9))
    pucks, since = rng.uniform(-1, 1, (4, n)), rng.uniform(0, 1.9, n)
    when, apart, velocities = mallet_contacts(pucks, since, times, mallets, 0.15)
    for i in range(n):
        one = slice(i, i + 1)
        alone = mallet_contacts(pucks[:, one], since[one], times, mallets[:, one], 0.15)
        assert when[i] == alone[0][0]
        np.testing.assert_array_equal(apart[:, i], alone[1][:, 0])
        np.testing.assert_array_equal(velocities[:, i], alone[2][:, 0])


@given(seed=st.integers(0, 2**32 - 1))
def test_the_first_contact_is_where_the_distance_first_falls_to_the_contact_radius(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    times = np.linspace(0, 2, 6)
    path = rng.uniform(-1, 1, (6, 2))
    puck = rng.uniform(-1, 1, 4)
    moments = np.linspace(0, 2, 4001)
    mallet = np.stack([np.interp(moments, times, path[:, k]) for k in (0, 1)])
    gaps = np.hypot(*(puck[:2, None] + puck[2:, None] * moments - mallet))
    assume(gaps[0] > 0.15)
    when, apart, _ = one_mallet(tuple(puck), times.tolist(), path.tolist())
    before = gaps[moments < when]
    assert (before >= 0.15 - 1e-9).all()
    if when < math.inf:
        assert np.hypot(*apart) == pytest.approx(0.15)
        assert gaps[np.searchsorted(moments, when) - 1] == pytest.approx(0.15, abs=5e-3)
