"""What a person drew is brought to a movement, judged, and given to the learner."""

from typing import Any

import numpy as np
import pytest

from sgim.environments import throwing_teachers
from sgim.environments.fishing.demonstrators import fishing_demonstrations
from sgim.environments.fishing.leading import HIGH, LOW, LedArm
from sgim.environments.fishing.movement import HOME
from sgim.environments.fishing.rod import FishingRod
from sgim.web.protocol import Assess, GoalPoint
from sgim.web.scenes import Scene, scene_of
from sgim.web.takes import Takes


@pytest.fixture(scope="module", params=["fishing", "hockey", "throwing"])
def scene(request: pytest.FixtureRequest) -> Scene:
    found = scene_of(request.param)
    assert found is not None
    return found


def assess(samples: Any, speed: float = 1.0, goal: GoalPoint | None = None) -> Assess:
    return Assess("t", np.asarray(samples).tolist(), [], speed, goal)


def still(scene: Scene, seconds: float = 1.0) -> np.ndarray[Any, Any]:
    times = np.linspace(0, seconds, 30)
    return np.column_stack([times, np.repeat(scene.home[None], 30, axis=0)])


def test_a_scene_says_all_that_the_page_draws(scene: Scene) -> None:
    described = scene.describe()
    assert described["points"][described["handle"]]
    scene.reset(scene.home)
    points = scene.points()
    assert points.shape == (len(described["points"]), 3)
    for shape in described["moving"]:
        assert max(shape["points"]) < len(points)
    for kind, space in scene.task.goal_spaces.items():
        assert scene.goal(kind, space.sample(np.random.default_rng(0)))


def test_leading_to_where_it_is_held_changes_nothing(scene: Scene) -> None:
    held = scene.held(scene.home)
    assert np.allclose(scene.reach(held, scene.home), scene.home, atol=1e-3)


def test_whatever_is_asked_for_the_joints_stay_within_their_limits(scene: Scene) -> None:
    rng, joints = np.random.default_rng(1), scene.home
    for _ in range(60):
        joints = scene.reach(rng.normal(0, 2, 3), joints)
        assert (joints >= scene.low).all()
        assert (joints <= scene.high).all()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda s: s[:2], "nothing was drawn"),
        (lambda s: s[:, :-1], "nothing was drawn"),
        (lambda s: s[::-1], "do not increase"),
        (lambda s: np.where(np.arange(s.shape[1]) == 1, 99.0, s), "limits"),
        (lambda s: s * np.where(np.arange(s.shape[1]) == 0, 20.0, 1.0), "times as fast"),
    ],
)
def test_a_take_that_cannot_be_a_movement_is_refused_with_the_reason(
    scene: Scene, change: Any, says: str
) -> None:
    worth = Takes(scene).assess(assess(change(still(scene))))
    assert says in worth.problem
    assert worth.shown is None


def test_a_take_of_nothing_new_is_judged(scene: Scene) -> None:
    takes = Takes(scene)
    worth = takes.assess(assess(still(scene)))
    take = takes.get("t")
    assert (take is None) == bool(worth.problem)
    assert worth.shown is not None
    assert worth.fitted is not None
    assert len(worth.curves) == len(scene.joints)


def test_what_is_played_faster_lasts_less(scene: Scene) -> None:
    slow = Takes(scene).assess(assess(still(scene, 1.6), 1.0))
    fast = Takes(scene).assess(assess(still(scene, 1.6), 2.0))
    assert fast.duration == pytest.approx(slow.duration / 2)


def test_a_kinaesthetic_demonstration_reaches_on_the_page_what_it_reached() -> None:
    scene = scene_of("fishing")
    assert scene is not None
    shown = fishing_demonstrations(3)[5]
    recorded, landing = shown.trajectory, shown.outcome["float"]
    assert recorded is not None
    samples = np.column_stack([recorded.times, recorded.positions])
    takes = Takes(scene)
    goal = GoalPoint("float", landing.tolist())
    worth = takes.assess(assess(samples, goal=goal))
    assert np.linalg.norm(np.array(worth.outcome["float"]) - landing) < 0.05
    assert worth.distance is not None
    assert worth.distance < 0.03
    take = takes.get("t")
    assert take is not None
    rod = FishingRod(0.0)
    copied = rod.execute(take.demonstration.policy)
    assert np.allclose(copied["float"], worth.reached["float"])


def test_a_throw_is_what_the_learner_s_copy_throws() -> None:
    scene = scene_of("throwing")
    assert scene is not None
    shown = throwing_teachers()["T1"].demonstrate(None, np.random.default_rng(2))
    assert shown is not None
    primitive: Any = scene.task.primitive
    recorded = primitive.trajectory(shown.policy, 60.0)
    samples = np.column_stack([recorded.times, recorded.positions])
    worth = Takes(scene).assess(assess(samples))
    assert worth.residual < 0.05
    assert worth.outcome == worth.reached


def test_an_arm_that_is_held_still_places_the_ball() -> None:
    scene = scene_of("throwing")
    assert scene is not None
    times = np.linspace(0, 2, 100)
    share = np.clip(times / 1.6, 0, 1)
    angles = 0.8 * share**3 * (10 - 15 * share + 6 * share**2)
    worth = Takes(scene).assess(assess(np.column_stack([times, angles])))
    assert worth.outcome.keys() == {"place"}
    assert worth.outcome["place"][0] == pytest.approx(0.8, abs=0.08)


def test_the_tip_is_brought_where_it_can_be_brought() -> None:
    arm = LedArm()
    rng = np.random.default_rng(4)
    misses = []
    for _ in range(20):
        target = arm.tip(HOME + 0.5 * rng.uniform(LOW - HOME, HIGH - HOME))
        joints, start = HOME, arm.tip(HOME)
        for share in np.linspace(0, 1, 40):
            joints = arm.reach(start + share * (target - start), joints)
        misses.append(float(np.linalg.norm(arm.tip(joints) - target)))
    assert np.median(misses) < 1e-3
    far = arm.tip(arm.reach(np.array([0.0, 5.0, 0.5]), HOME))
    assert far[1] > arm.tip(HOME)[1]


def test_the_world_goes_on_while_the_arm_is_led(scene: Scene) -> None:
    scene.reset(scene.home)
    before = scene.points()
    joints = np.clip(scene.home + 0.3, scene.low, scene.high)
    for _ in range(20):
        scene.advance(joints, 0.05)
    assert not np.allclose(scene.points(), before, atol=0.02)
    scene.reset(scene.home)
    assert np.allclose(scene.points(), before, atol=1e-6)


def test_a_throw_s_flight_ends_where_it_lands() -> None:
    scene = scene_of("throwing")
    assert scene is not None
    shown = throwing_teachers()["T1"].demonstrate(None, np.random.default_rng(0))
    assert shown is not None
    movement = scene.movement(shown.policy)
    ball = movement.frames[-1, 2]
    assert ball[0] == pytest.approx(movement.outcome["throw"][0], abs=1e-6)
    assert ball[1] == pytest.approx(0.0, abs=1e-6)
