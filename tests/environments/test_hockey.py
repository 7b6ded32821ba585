import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.environments import AirHockey, hockey_goals
from sgim.environments.hockey import OBSTACLE, Block, Shot
from sgim.errors import SpaceError
from sgim.records import Outcome, Trajectory
from sgim.spaces import FloatArray

TABLE = AirHockey()
FREE = AirHockey(obstacle=None)
CONTACT = 0.15


def random_policies(count: int, seed: int = 0) -> FloatArray:
    rng = np.random.default_rng(seed)
    return np.array([TABLE.task.policy_space.sample(rng) for _ in range(count)])


def mallet_at(x: float, y: float) -> FloatArray:
    """The policy of a mallet that stands still."""
    return np.array([*[x, y] * 5, 0.2, 0.2, 0.2, 0.2])


def same(one: Outcome, other: Outcome) -> bool:
    return one.keys() == other.keys() and all(
        one[kind].tobytes() == other[kind].tobytes() for kind in one
    )


def velocities(shot: Shot) -> FloatArray:
    """Between collisions, shape ``(k - 1, 2)``."""
    return np.diff(shot.puck, axis=0) / np.diff(shot.times)[:, None]


def mallet_of(shot: Shot, times: FloatArray) -> FloatArray:
    steps = np.arange(len(shot.mallet))
    return np.stack([np.interp(times / 0.005, steps, path) for path in shot.mallet.T], axis=-1)


def distance_to_obstacle(points: FloatArray) -> FloatArray:
    low, high = [OBSTACLE.left, OBSTACLE.bottom], [OBSTACLE.right, OBSTACLE.top]
    return np.linalg.norm(points - np.clip(points, low, high), axis=-1)


SHOTS = TABLE.shots(random_policies(3000, seed=4))


def test_a_batch_gives_bit_for_bit_what_single_movements_give() -> None:
    policies = random_policies(1500)
    batch = TABLE.execute_batch(policies)
    assert {*map(len, batch)} == {0, 1}
    assert all(same(TABLE.execute(p), o) for p, o in zip(policies, batch, strict=True))


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 70))
def test_a_batch_of_any_size_gives_what_single_movements_give(seed: int, count: int) -> None:
    policies = random_policies(count, seed)
    batch = TABLE.execute_batch(policies)
    assert all(same(TABLE.execute(p), o) for p, o in zip(policies, batch, strict=True))


def test_the_same_movement_ends_the_same_in_any_company() -> None:
    policies = random_policies(200)
    forwards, backwards = TABLE.execute_batch(policies), TABLE.execute_batch(policies[::-1])
    assert all(same(a, b) for a, b in zip(forwards, backwards[::-1], strict=True))


def test_an_empty_batch_gives_nothing() -> None:
    assert TABLE.execute_batch([]) == []


def test_outcomes_are_points_of_the_task() -> None:
    box = TABLE.task.outcome_spaces["hit"]
    for outcome in TABLE.execute_batch(random_policies(500)):
        for point in TABLE.task.check_outcome(outcome).values():
            assert box.contains(point)
    assert TABLE.deterministic
    assert TABLE.task.policy_space.dimension == 14
    assert TABLE.sample_context(np.random.default_rng(0)) is None


# What the table does, against closed forms.


def test_an_untouched_puck_gives_no_outcome() -> None:
    policy = mallet_at(-0.8, 0.8)
    assert TABLE.execute(policy) == {}
    [shot] = TABLE.shots([policy])
    assert shot.touches == 0
    assert shot.ending == "bottom border"
    np.testing.assert_allclose(shot.puck, [[0.05, 0], [0.05, -1]])
    np.testing.assert_allclose(shot.times, [0, 2])


def test_a_mallet_at_rest_beneath_the_puck_sends_it_straight_back() -> None:
    [hit] = TABLE.execute(mallet_at(0.05, -0.5))["hit"]
    assert hit == pytest.approx(0.05)
    [shot] = TABLE.shots([mallet_at(0.05, -0.5)])
    np.testing.assert_allclose(velocities(shot), [[0, -0.5], [0, 0.5]], atol=1e-12)
    np.testing.assert_allclose(shot.times, [0, 0.7, 0.7 + 2.7])


@pytest.mark.parametrize("offset", [-0.045, -0.03, 0.02])
def test_a_mallet_at_rest_beside_the_course_of_the_puck_reflects_it_about_the_normal(
    offset: float,
) -> None:
    policy = mallet_at(0.05 - offset, -0.5)
    [shot] = FREE.shots([policy])
    height = math.sqrt(CONTACT**2 - offset**2)
    np.testing.assert_allclose(shot.puck[1], [0.05, -0.5 + height], atol=1e-12)
    turned = 2 * math.atan2(offset, height)
    expected = 0.5 * np.array([math.sin(turned), math.cos(turned)])
    np.testing.assert_allclose(velocities(shot)[1], expected, atol=1e-12)
    landing = 0.05 + (1.5 - height) * math.tan(turned)
    assert FREE.execute(policy)["hit"][0] == pytest.approx(landing)


def test_a_mallet_that_rises_head_on_adds_twice_its_speed() -> None:
    policy = np.array([0.05, -1, 0.05, -0.8, 0.05, -0.2, 0.05, 0.4, 0.05, 0.8, *[0.3] * 4])
    [shot] = TABLE.shots([policy])
    [before, after] = velocities(shot)[:2]
    step = int(shot.times[1] / 0.005)
    speed = (shot.mallet[step + 1, 1] - shot.mallet[step, 1]) / 0.005
    assert speed > 0.3
    np.testing.assert_allclose(before, [0, -0.5], atol=1e-12)
    np.testing.assert_allclose(after, [0, 0.5 + 2 * speed], atol=1e-9)
    assert TABLE.execute(policy)["hit"][0] == pytest.approx(0.05)


def test_the_puck_moves_straight_and_at_one_speed_unless_the_mallet_hits_it() -> None:
    bounced = 0
    for shot in SHOTS:
        speeds = np.linalg.norm(velocities(shot), axis=1)
        assert speeds[0] == pytest.approx(0.5)
        met = np.linalg.norm(shot.puck[1:-1] - mallet_of(shot, shot.times[1:-1]), axis=1)
        by_mallet = np.abs(met - CONTACT) < 1e-9
        assert by_mallet.sum() == shot.touches
        kept = ~by_mallet
        np.testing.assert_allclose(speeds[1:][kept], speeds[:-1][kept], rtol=1e-6)
        np.testing.assert_allclose(distance_to_obstacle(shot.puck[1:-1][kept]), 0.05, atol=1e-9)
        bounced += kept.sum()
    assert bounced > 50


def test_a_hit_reflects_the_velocity_relative_to_the_mallet_about_the_line_of_centres() -> None:
    hits = 0
    for shot in SHOTS:
        speeds = velocities(shot)
        for k in range(1, len(shot.puck) - 1):
            time, puck = shot.times[k], shot.puck[k]
            normal = (puck - mallet_of(shot, time)) / CONTACT
            step = int(time / 0.005)
            at_a_sample = abs(time / 0.005 - round(time / 0.005)) < 1e-6
            by_mallet = abs(np.linalg.norm(normal) - 1) < 1e-8
            if not by_mallet or at_a_sample or step + 1 >= len(shot.mallet):
                continue
            mallet = (shot.mallet[step + 1] - shot.mallet[step]) / 0.005
            before, after = speeds[k - 1] - mallet, speeds[k] - mallet
            expected = before - 2 * (before @ normal) * normal
            np.testing.assert_allclose(after, expected, atol=1e-5)
            assert before @ normal < 0
            hits += 1
    assert hits > 500


def test_the_puck_is_never_inside_of_the_obstacle_the_borders_or_a_mallet() -> None:
    for shot in SHOTS[:600]:
        moments = np.linspace(0, shot.times[-1], 700)
        puck = np.stack([np.interp(moments, shot.times, path) for path in shot.puck.T], axis=1)
        assert np.abs(puck).max() <= 1 + 1e-12
        assert distance_to_obstacle(puck).min() >= 0.05 - 1e-9
        apart = np.linalg.norm(puck - mallet_of(shot, moments), axis=1)
        free = np.maximum.accumulate(apart >= CONTACT)  # since a mallet above it went away
        assert (apart[free] >= CONTACT - 1e-9).all()


def test_only_the_top_border_gives_an_outcome_and_it_is_where_the_puck_meets_it() -> None:
    outcomes = TABLE.execute_batch(random_policies(3000, seed=4))
    endings = set()
    for shot, outcome in zip(SHOTS, outcomes, strict=True):
        endings.add(shot.ending)
        assert ("hit" in outcome) == (shot.ending == "top border")
        if "hit" in outcome:
            assert shot.puck[-1, 1] == pytest.approx(1.0)
            assert outcome["hit"][0] == shot.puck[-1, 0]
            assert shot.touches > 0
        elif shot.ending == "side border":
            assert abs(shot.puck[-1, 0]) == pytest.approx(1.0)
        elif shot.ending == "bottom border":
            assert shot.puck[-1, 1] == pytest.approx(-1.0)
    assert endings >= {"top border", "side border", "bottom border"}


def test_a_puck_that_is_too_slow_runs_out_of_time() -> None:
    shots = [s for s in TABLE.shots(random_policies(20_000, seed=1)) if s.ending == "time limit"]
    assert shots
    assert all(shot.times[-1] == 6.0 for shot in shots)


def test_a_mallet_that_starts_above_the_puck_and_stays_does_not_hit_it() -> None:
    [shot] = TABLE.shots([mallet_at(0.05, -0.05)])
    assert shot.touches == 0


def test_without_the_obstacle_a_straight_shot_lands_behind_where_it_was() -> None:
    policy = mallet_at(0.005, -0.45)
    assert "hit" in FREE.execute(policy)
    with_obstacle, without = TABLE.shots([policy])[0], FREE.shots([policy])[0]
    assert without.puck[-1, 0] > 0.6
    assert with_obstacle.puck[-1, 0] != pytest.approx(without.puck[-1, 0])


def test_a_mirrored_table_gives_mirrored_outcomes() -> None:
    mirrored = AirHockey(Block(-1.0, OBSTACLE.bottom, -OBSTACLE.left, OBSTACLE.top), (-0.05, 0.0))
    policies = random_policies(2000, seed=2)
    other = policies.copy()
    other[:, :10:2] *= -1
    pairs = zip(TABLE.execute_batch(policies), mirrored.execute_batch(other), strict=True)
    hits = 0
    for here, there in pairs:
        assert here.keys() == there.keys()
        if "hit" in here:
            assert there["hit"][0] == pytest.approx(-here["hit"][0], abs=1e-6)
            hits += 1
    assert hits > 100


def test_later_movements_of_the_mallet_do_not_change_what_happened_before() -> None:
    # Moves the last key point alone; hits before its weight counts stay as they are.
    policy = mallet_at(0.05, -0.3)
    other = policy.copy()
    other[8:10] = [-0.9, 0.9]
    other[10:] = policy[10:] = 0.5
    [one], [two] = TABLE.shots([policy]), TABLE.shots([other])
    np.testing.assert_allclose(one.puck[1], two.puck[1], atol=1e-3)


def test_random_movements_touch_the_puck_and_reach_the_top_as_often_as_the_page_says() -> None:
    shots = TABLE.shots(random_policies(20_000, seed=9))
    assert np.mean([shot.touches > 0 for shot in shots]) == pytest.approx(0.379, abs=0.015)
    ended = np.mean([shot.ending == "top border" for shot in shots])
    assert ended == pytest.approx(0.073, abs=0.008)


def test_a_policy_becomes_a_trajectory_of_the_mallet_and_back() -> None:
    primitive = TABLE.task.primitive
    assert primitive is not None
    policy = random_policies(1, seed=3)[0]
    [shot] = TABLE.shots([policy])
    assert (primitive.joints, primitive.unit) == (("x", "y"), "m")
    times = np.arange(len(shot.mallet) - 1) * 0.005
    recorded = Trajectory(times, shot.mallet[:-1], ["x", "y"], "m")
    fitted, residual = primitive.fit(recorded)
    assert residual < 1e-4
    assert TABLE.task.policy_space.contains(fitted)


def test_goals_are_every_twentieth_of_the_top_border() -> None:
    goals = hockey_goals()
    assert len(goals) == 41
    points = np.array([goal.point[0] for goal in goals])
    assert (points[0], points[-1]) == (-1.0, 1.0)
    np.testing.assert_allclose(np.diff(points), 0.05)
    assert {goal.kind for goal in goals} == {"hit"}


@pytest.mark.parametrize("policy", [np.zeros(13), np.zeros((1, 14)), 3.0])
def test_a_policy_of_another_shape_is_refused(policy: FloatArray) -> None:
    with pytest.raises(SpaceError, match="policy has shape"):
        TABLE.execute(policy)


@pytest.mark.parametrize("policies", [np.zeros((2, 13)), np.zeros(14)])
def test_a_batch_of_another_shape_is_refused(policies: FloatArray) -> None:
    with pytest.raises(SpaceError, match=r"expected \(n, 14\)"):
        TABLE.execute_batch(policies)
