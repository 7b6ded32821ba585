import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.environments import ARMS, ObstacleArm, PlanarArm, drawn_arm
from sgim.errors import SpaceError
from sgim.spaces import FloatArray
from sgim.testing import check_environment

ARM = ObstacleArm(noise=0.0)
FREE = PlanarArm(ARM.joints, limit=ARM.limit, low=(-1, -1), noise=0.0)


def points_on(arm: ObstacleArm, posture: FloatArray) -> FloatArray:
    """Points spaced densely along the links, shape ``(m, 2)``."""
    angles = np.cumsum(posture)
    along = np.column_stack((np.cos(angles), np.sin(angles))) * arm.lengths[:, None]
    starts = np.cumsum(along, axis=0) - along
    return np.concatenate([starts + t * along for t in np.linspace(0, 1, 200)])


@given(seed=st.integers(0, 2**32 - 1))
def test_a_movement_ends_at_its_posture_unless_a_link_meets_the_obstacle_on_the_way(
    seed: int,
) -> None:
    posture = np.random.default_rng(seed).uniform(-ARM.limit, ARM.limit, ARM.joints)
    gaps = [
        np.linalg.norm(points_on(ARM, share * posture) - ARM.centre, axis=1).min()
        for share in np.linspace(0, 1, 100)
    ]
    hand = ARM.execute(posture)["hand"]
    if min(gaps) > ARM.radius + 0.02:
        np.testing.assert_array_equal(hand, FREE.execute(posture)["hand"])
    elif min(gaps) < ARM.radius - 0.02:
        assert (hand != FREE.execute(posture)["hand"]).all()


@given(seed=st.integers(0, 2**32 - 1))
def test_the_hand_is_never_inside_the_obstacle(seed: int) -> None:
    postures = np.random.default_rng(seed).uniform(-ARM.limit, ARM.limit, (50, ARM.joints))
    assert (np.linalg.norm(ARM.hands(postures) - ARM.centre, axis=1) >= ARM.radius).all()


def test_the_obstacle_hides_what_lies_behind_it_from_a_single_link() -> None:
    arm = ObstacleArm(1, centre=(0.5, 0.5), radius=0.1, noise=0.0)
    blocked, free = arm.execute([1.2])["hand"], arm.execute([-1.2])["hand"]
    assert np.arctan2(*blocked[::-1]) < np.pi / 4
    np.testing.assert_allclose(np.arctan2(*free[::-1]), -1.2)


@pytest.mark.parametrize("name", [n for n, arm in ARMS.items() if isinstance(arm, ObstacleArm)])
def test_arms_with_obstacles_keep_the_promises_of_an_environment(name: str) -> None:
    check_environment(ARMS[name])
    check_environment(ARMS[name].without_noise())


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"centre": (0.5, 0.05)}, "the stretched arm touches the obstacle"),
        ({"radius": 0.0}, "a positive number"),
        ({"centre": (0.5, 0.5, 0.5)}, "expected x, y"),
    ],
)
def test_an_impossible_obstacle_is_refused(changes: dict[str, object], message: str) -> None:
    with pytest.raises(SpaceError, match=message):
        ObstacleArm(**changes)


def test_a_drawn_arm_is_the_same_each_time_and_differs_from_the_others() -> None:
    for number in range(20):
        once, twice = drawn_arm(number), drawn_arm(number)
        posture = np.full(once.joints, 0.1)
        np.testing.assert_array_equal(once.hands(posture[None]), twice.hands(posture[None]))
        assert once.task.describe() == twice.task.describe()
    arms = [drawn_arm(number) for number in range(20)]
    assert len({arm.joints for arm in arms}) > 5
    assert 3 < sum(isinstance(arm, ObstacleArm) for arm in arms) < 17
