import os
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from sgim.environments import FishingRod
from sgim.environments.fishing.model import FAST, FULL, JOINTS, Variant, rod_model
from sgim.environments.fishing.movement import FISHING, HOME
from sgim.environments.fishing.simulator import Simulator
from sgim.errors import SgimError, SpaceError
from sgim.records import Trajectory
from sgim.spaces import FloatArray
from sgim.testing import check_environment

STILL = FishingRod(0.0)
USUAL = FishingRod()


def random_policies(count: int, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).random((count, 25))


def landings(world: FishingRod, policies: FloatArray, seed: int = 0) -> FloatArray:
    """Where each policy lands; NaN where it does not."""
    rngs = [np.random.default_rng([seed, i]) for i in range(len(policies))]
    outcomes = world.execute_batch(policies, None, rngs)
    nowhere = np.full(2, np.nan)
    return np.array([outcome.get("float", nowhere) for outcome in outcomes])


@pytest.mark.parametrize("world", [STILL, USUAL, FishingRod(1.0, widen=100.0)])
def test_it_keeps_the_promises_of_a_world(world: FishingRod) -> None:
    check_environment(world, trials=10)


def test_the_full_model_keeps_the_promises_of_a_world() -> None:
    check_environment(FishingRod(1.0, fast=False), trials=3)


def test_the_full_model_has_42_degrees_of_freedom() -> None:
    assert mujoco.MjModel.from_xml_string(rod_model(FULL)).nv == 42
    assert mujoco.MjModel.from_xml_string(rod_model(FAST)).nv == 20


@pytest.mark.parametrize("fast", [True, False])
def test_the_float_hangs_at_rest_just_above_the_water_and_half_a_metre_ahead(fast: bool) -> None:
    simulator = Simulator(FAST if fast else FULL)
    assert simulator.rest == pytest.approx([0, 0.55, 0.02], abs=0.01)
    world = FishingRod(0.0, fast=fast)
    assert world.rest == pytest.approx(simulator.rest[:2])
    home = np.append(np.full(24, 0.5), 0.0)
    assert world.execute(home) == {}
    _, path = world.positions(home)
    np.testing.assert_allclose(path[:, -1] - path[0, -1], 0, atol=1e-3)


def test_most_random_movements_drop_the_float_near_where_it_hung() -> None:
    reached = landings(STILL, random_policies(300))
    landed = reached[~np.isnan(reached[:, 0])]
    assert 0.8 < len(landed) / len(reached) < 0.95
    np.testing.assert_allclose(np.median(landed, axis=0), STILL.rest, atol=0.03)
    assert (landed[:, 1] < 0).mean() < 0.05
    assert 0.1 < landed.std(axis=0).min() < landed.std(axis=0).max() < 0.5


def test_the_fast_model_lands_near_the_full_one() -> None:
    policies = random_policies(60, seed=1)
    fast, full = landings(STILL, policies), landings(FishingRod(0.0, fast=False), policies)
    apart = np.linalg.norm(fast - full, axis=1)
    assert np.nanmedian(apart) < 0.02


@pytest.mark.parametrize("fast", [True, False])
def test_the_landing_lies_between_the_positions_before_and_after_it(fast: bool) -> None:
    world = FishingRod(0.0, fast=fast)
    for policy in random_policies(10, seed=2):
        outcome = world.execute(policy)
        _, path = world.positions(policy)
        wet = path[:, -1, 2] <= 0
        assert bool(outcome) == wet.any()
        if not outcome:
            continue
        after = int(np.argmax(wet))
        before, below = path[after - 1, -1], path[after, -1]
        share = before[2] / (before[2] - below[2])
        landing = before[:2] + share * (below - before)[:2]
        np.testing.assert_array_equal(outcome["float"], landing)


def test_the_mirrored_movement_lands_at_the_mirrored_place() -> None:
    policies = random_policies(20, seed=3)
    mirrored = policies.copy()
    for joint, name in enumerate(JOINTS):
        if name in ("base", "forearm", "grip"):
            mirrored[:, joint:24:6] = 1 - mirrored[:, joint:24:6]
    np.testing.assert_allclose(
        landings(STILL, mirrored), landings(STILL, policies) * [-1, 1], atol=2e-3
    )


def test_outcomes_scatter_with_the_factor_of_the_noise() -> None:
    policies = random_policies(30, seed=4)
    away = np.linalg.norm(landings(STILL, policies) - STILL.rest, axis=1)
    repeated = np.repeat(policies[away > 0.2][:1], 12, axis=0)
    spread = [landings(FishingRod(f), repeated).std(axis=0).max() for f in (0.0, 0.1, 1.0)]
    assert spread[0] < 1e-12
    assert 0.002 < spread[1] < spread[2] / 3


def test_a_recorded_movement_of_the_joints_can_be_followed() -> None:
    policy = random_policies(1, seed=5)[0]
    times = np.linspace(0, FISHING.durations(policy[None])[0], 300)
    recorded = Trajectory(times + 7, FISHING.positions(policy[None], times)[0], JOINTS, "rad")
    expected = STILL.execute(policy)["float"]
    np.testing.assert_allclose(STILL.follow(recorded)["float"], expected, atol=1e-3)
    with pytest.raises(SpaceError, match=r"expected base, shoulder, .* in rad"):
        STILL.follow(Trajectory(times, np.tile(HOME, (300, 1)), JOINTS, "deg"))


def test_enlarging_the_box_changes_goals_and_nothing_else() -> None:
    wide = FishingRod(0.0, widen=100.0)
    box = wide.task.outcome_spaces["float"]
    assert box.describe()["high"] == [100.0, 100.0]
    assert wide.task.tolerances["float"] * 200 == pytest.approx(STILL.task.tolerances["float"] * 2)
    policies = random_policies(5)
    np.testing.assert_array_equal(landings(wide, policies), landings(STILL, policies))


@pytest.mark.parametrize("steps", [50, 300])
def test_an_unstable_simulation_is_an_error_and_never_a_landing(
    steps: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    lifted = np.tile(HOME, (steps, 1))
    lifted[:, 2] += np.linspace(0, 1, steps)
    assert Simulator(FAST).land(lifted) is None
    coarse = Simulator(Variant("coarse", segments=8, step=0.03, armature=2.5e-5))
    with pytest.raises(SgimError, match=r"unstable .* count it as failed"):
        coarse.land(lifted)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("for_good", [True, False])
def test_a_float_that_leaps_into_the_water_from_on_high_has_not_landed(
    for_good: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulator = Simulator(FULL)
    lifted = np.tile(HOME, (300, 1))
    lifted[:, 2] += np.minimum(np.linspace(0, 3, 300), 1)
    assert simulator.land(lifted) is None
    assert simulator.end(lifted)[0][2] > 0.2
    step, done = mujoco.mj_step, 0

    def leaping(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        nonlocal done
        step(model, data)
        done += 1
        if done == 200:
            data.qpos[1] -= 3
        elif done == 201 and not for_good:
            data.qpos[1] += 3

    monkeypatch.setattr(mujoco, "mj_step", leaping)
    with pytest.raises(SgimError, match="unstable"):
        simulator.land(lifted)


@pytest.mark.parametrize("broken", [np.nan, 1e12, 1e4])
def test_a_broken_state_is_an_error_and_the_next_movement_is_whole(broken: float) -> None:
    simulator = Simulator(FAST)
    set_points = np.tile(HOME, (50, 1))
    set_points[:, 1] -= np.linspace(0, 1, 50)
    landing = simulator.land(set_points)
    assert landing is not None
    set_points[3, 0] = broken
    with pytest.raises(SgimError, match="unstable"):
        simulator.land(set_points)
    set_points[3, 0] = 0.0
    np.testing.assert_array_equal(simulator.land(set_points), landing)


def test_bad_arguments_are_refused() -> None:
    with pytest.raises(SpaceError, match="noise is -1"):
        FishingRod(-1.0)
    with pytest.raises(SpaceError, match=r"widen is 0\.5"):
        FishingRod(widen=0.5)
    with pytest.raises(SpaceError, match="policy has shape"):
        STILL.execute(np.zeros(24))
    with pytest.raises(SpaceError, match="needs the trial's generator"):
        USUAL.execute(np.zeros(25))


def test_without_mujoco_the_error_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(SgimError, match=r"pip install 'sgim\[mujoco\]'"):
        FishingRod()
