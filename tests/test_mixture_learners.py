"""The learners of chapter 5 are composed as algorithms 5.2.1 and 5.2.2 say, and learn anywhere."""

from __future__ import annotations

import numpy as np
import pytest

from sgim import algorithms
from sgim.configurations import MODERN, THESIS
from sgim.environments import ThrowingArm, throwing_teachers
from sgim.environments.arm import PlanarArm
from sgim.environments.base import Environment
from sgim.environments.benchmark_goals import throwing_goals
from sgim.errors import SettingError, SgimError
from sgim.learner import Learner
from sgim.outcome import AbsoluteProgress, MixtureInterest
from sgim.records import Goal
from sgim.runs import Benchmark, Run

TASK = ThrowingArm().task
REMEDIES = {
    "mixture_starving": 0.0,
    "mixture_bounds": "clip",
    "mixture_answers": "mixture",
    "mixture_scaled": False,
    "interest_weights": "covariance",
    "interest_uniform": 0.0,
    "interest_recent": 0.0,
    "interest_random_modes": 0.0,
}
"""What `modern` does about what goes wrong, and how it is without."""

SHORT = "rest_trials=50,mixture_every=50,mixture_components=8,interest_every=50,interest_window=200"


def error(learner: Learner, world: Environment, goals: list[Goal], movements: int) -> float:
    """The mean error over goals after so many movements, in the unit box."""
    with Run(learner, world, throwing_teachers(), benchmark=Benchmark(goals, world)) as run:
        run.evaluate_every, run.batch = movements, 50
        return run.go(movements)[-1].errors["total"]


def test_the_thesis_has_none_of_the_remedies_and_modern_has_them_all() -> None:
    for name, without in REMEDIES.items():
        assert getattr(THESIS, name) == without
        assert getattr(MODERN, name) != without


def test_first_trials_are_at_rest_and_then_one_movement_is_made_for_each_goal() -> None:
    learner = algorithms.make("sagg-riac-gmm", TASK, configuration=f"modern,{SHORT}")
    modes = []
    for _ in range(120):
        plan = learner.ask()
        modes.append(plan.mode)
        assert (plan.goal is None) == (plan.mode == "rest")
        assert learner.tell(plan, ThrowingArm().execute(plan.policy)).closed
    assert modes == ["rest"] * 50 + ["autonomous"] * 70


def test_the_strategy_is_one_more_choice_of_the_interest_map() -> None:
    learner = algorithms.make("sgim-acts-gmm", TASK, ["T1"], configuration=f"modern,{SHORT}")
    assert list(learner.strategy.modes) == ["autonomous", "emulate T1", "rest"]
    error(learner, ThrowingArm(), throwing_goals()[::50], 300)
    modes = {plan.mode for plan in learner.ask_batch(100)}
    assert modes == {"autonomous", "emulate T1"}
    with pytest.raises(SgimError, match="sgim-acts-gmm emulates: name one or more teachers"):
        algorithms.make("sgim-acts-gmm", TASK)


def test_the_control_differs_in_nothing_but_progress() -> None:
    control, learner = (
        algorithms.make(name, TASK, configuration="thesis")
        for name in ("goal-babbling-gmm", "sagg-riac-gmm")
    )
    assert control.recipe is not None
    assert learner.recipe is not None
    settings, others = control.recipe["configuration"], learner.recipe["configuration"]
    assert {k for k in settings if settings[k] != others[k]} == {"interest_weights"}
    assert settings["interest_weights"] == "none"


@pytest.mark.parametrize(
    ("interest", "made"), [("mixture", MixtureInterest), ("alp-gmm", AbsoluteProgress)]
)
@pytest.mark.parametrize("name", ["sagg-riac", "sgim-acts", "sgim-d"])
def test_other_learners_can_choose_by_mixtures_too(
    name: str, interest: str, made: type[object]
) -> None:
    learner = algorithms.make(name, TASK, ["T1"], configuration=f"modern,interest={interest}")
    assert isinstance(getattr(learner.strategy, "interest", None), made)
    assert error(learner, ThrowingArm(), throwing_goals()[::50], 600) < 0.4


def test_mixtures_learn_to_throw_and_to_reach() -> None:
    learner = algorithms.make("sagg-riac-gmm", TASK, configuration=f"modern,{SHORT}", seed=1)
    assert error(learner, ThrowingArm(), throwing_goals()[::10], 3000) < 0.25
    arm = PlanarArm(3, noise=0)
    rng = np.random.default_rng(0)
    postures = [arm.task.policy_space.sample(rng) for _ in range(60)]
    goals = [Goal("hand", outcome["hand"]) for outcome in arm.execute_batch(postures)]
    learner = algorithms.make("sagg-riac-gmm", arm.task, configuration=f"modern,{SHORT}", seed=1)
    assert error(learner, arm, goals, 3000) < 0.05


def test_mixtures_learn_where_the_context_varies() -> None:
    arm = PlanarArm(3, noise=0, vary_start=True)
    learner = algorithms.make("sagg-riac-gmm", arm.task, configuration=f"modern,{SHORT}", seed=1)
    with Run(learner, arm, batch=50) as run:
        run.go(1500)
    rng = np.random.default_rng(0)
    distances = []
    for _ in range(30):
        base = arm.sample_context(rng)
        posture = arm.task.policy_space.sample(rng)
        point = arm.execute(posture, base)["hand"]
        reached = arm.execute(learner.best_policy("hand", point, base), base)["hand"]
        distances.append(float(np.linalg.norm(reached - point)))
    assert np.mean(distances) < 0.2


@pytest.mark.parametrize(
    "setting",
    ["mixture_components=0", "interest_recent=1.5", "mixture_first_rate=0.0", "rest_trials=-1"],
)
def test_settings_out_of_range_are_refused(setting: str) -> None:
    with pytest.raises(SettingError, match=setting.partition("=")[0]):
        algorithms.make("sagg-riac-gmm", TASK, configuration=f"modern,{setting}")
