"""A Gymnasium environment as a world: real environments, and made-up ones for what is rare."""

import sys
from collections.abc import Callable
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

from sgim.environments import Acrobot, GymnasiumWorld, Rollout
from sgim.environments.gymnasium import Controller
from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.records import Outcome
from sgim.spaces import Box, Space
from sgim.testing import check_environment


class Push:
    """Pushes by the policy's only number for a given number of steps."""

    policy_space: Space = Box(-1.0, 1.0, names=["push"])

    def __init__(self, steps: int) -> None:
        self.steps = steps

    def begin(self, policy: Any) -> Controller:
        left = iter(range(self.steps))
        return lambda observation: None if next(left, None) is None else np.asarray(policy)


class Cart(gym.Env[Any, Any]):
    """A cart that goes where it is pushed, shows one array that it writes into, and ends at 1."""

    observation_space = gym.spaces.Box(-10, 10, (1,), np.float64)
    action_space = gym.spaces.Box(-1, 1, (1,), np.float64)

    def __init__(self) -> None:
        self.place = np.zeros(1)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        spread = (options or {}).get("spread", 0.0)
        self.place[:] = spread * self.np_random.standard_normal()
        return self.place, {"steps": 0}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.place += 0.1 * action
        return self.place, float(self.place[0]), bool(self.place[0] > 1), False, {"steps": 1}


def place(rollout: Rollout) -> Outcome:
    return {"cart": np.array(rollout.observations[-1])}


def cart(steps: int = 5, **settings: Any) -> GymnasiumWorld:
    spaces = {"cart": Box([-2.0], [2.0], unit="m")}
    return GymnasiumWorld(Cart, Push(steps), spaces, place, **settings)


def test_a_rollout_has_what_was_seen_done_and_earned_at_each_step() -> None:
    rollout = cart(3, deterministic=True).rollout([0.5])
    np.testing.assert_allclose(np.ravel(rollout.observations), [0, 0.05, 0.1, 0.15])
    np.testing.assert_allclose(rollout.rewards, [0.05, 0.1, 0.15])
    assert len(rollout.actions) == 3
    assert not rollout.terminated
    assert rollout.info == {"steps": 1}


def test_a_movement_ends_where_the_environment_ends_it() -> None:
    rollout = cart(50, deterministic=True).rollout([1.0])
    assert rollout.terminated
    assert len(rollout.actions) == 11


def test_a_movement_of_no_steps_produces_what_the_reset_shows() -> None:
    rollout = cart(0, deterministic=True).rollout([1.0])
    assert (len(rollout.observations), rollout.info) == (1, {"steps": 0})


def test_a_trial_is_repeated_exactly_by_its_generator_and_options_are_passed_on() -> None:
    world = cart(options={"spread": 0.5})
    seeds = (1, 1, 2)
    a, b, c = (world.execute([0.1], None, np.random.default_rng(s))["cart"] for s in seeds)
    np.testing.assert_array_equal(a, b)
    assert a != c


def test_a_random_environment_needs_the_generator_of_the_trial() -> None:
    with pytest.raises(SgimError, match="pass the trial's generator"):
        cart().execute([0.1])


@pytest.mark.parametrize("make", [cart, Acrobot, lambda: cart(deterministic=True)])
def test_gymnasium_worlds_keep_the_promises_of_an_environment(
    make: Callable[[], GymnasiumWorld],
) -> None:
    check_environment(make(), trials=5)


def test_a_name_that_gymnasium_does_not_know_is_refused() -> None:
    with pytest.raises(SgimError, match="makes no environment 'Acrobat-v1'"):
        GymnasiumWorld("Acrobat-v1", Push(1), {"cart": Box([-1.0], [1.0])}, place)


def test_without_gymnasium_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(SgimError, match=r"pip install 'sgim\[gymnasium\]'"):
        Acrobot()


def test_the_pendulum_hangs_still_without_torque_and_swings_with_it() -> None:
    acrobot, rng = Acrobot(), np.random.default_rng(0)
    still = acrobot.execute(np.zeros(15), None, rng)["tip"]
    np.testing.assert_allclose(still, [0, -2], atol=0.1)
    pushed = [(-1.0) ** i for i in range(15)]
    assert acrobot.execute(pushed, None, rng)["tip"][1] > -1.9


def test_the_torques_that_the_motor_gives_add_up_to_those_commanded() -> None:
    acrobot = Acrobot()
    commands = np.random.default_rng(3).uniform(-1, 1, 15)
    rollout = acrobot.rollout(commands, np.random.default_rng(0))
    given = np.cumsum(np.array(rollout.actions) - 1)
    assert set(rollout.actions) <= {0, 1, 2}
    assert np.abs(given - np.cumsum(np.repeat(commands, 5))).max() <= 0.5 + 1e-9


def test_the_pendulum_is_learned_by_its_name() -> None:
    acrobot = experiment("acrobot")
    learner = acrobot.learner("random-goal-babbling", seed=1000)
    run = acrobot.run(learner, evaluate_every=150)
    run.go(150)
    first, last = run.evaluations[0], run.evaluations[-1]
    assert last.errors["tip"] < 0.6 * first.errors["tip"]
