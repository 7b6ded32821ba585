"""What a solution says of its chances comes true: the stated share of goals is reached."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import ARMS, ThrowingArm, throwing_teachers
from sgim.environments.benchmark_goals import reachable_goals, throwing_goals
from sgim.records import Goal
from sgim.runs import Run
from sgim.spaces import FloatArray


def stated_and_true(
    repertoire: Any, world: Any, goals: Sequence[Goal], radii: Sequence[float]
) -> tuple[FloatArray, FloatArray]:
    """The probabilities that are stated, and the shares of executions that come so near."""
    stated, true = [], []
    for number, goal in enumerate(goals):
        span = world.task.outcome_spaces[goal.kind].range
        rng, misses = np.random.default_rng(number), None
        for radius in radii:
            solution = repertoire.solve(goal.kind, goal.point, radius=radius)
            if misses is None:
                outcomes = [world.execute(solution.policy, None, rng) for _ in range(5)]
                misses = [
                    np.linalg.norm((o[goal.kind] - goal.point) / span) if goal.kind in o else 1.0
                    for o in outcomes
                ]
            assert solution.radius == radius
            stated.append(solution.probability)
            true.append(np.mean(np.array(misses) <= radius))
    return np.array(stated), np.array(true)


def require_calibrated(stated: FloatArray, true: FloatArray, tolerance: float) -> None:
    """Overall, of the goals that seem reachable, and of those that do not."""
    likely = stated >= 0.5
    assert 20 < likely.sum() < len(stated) - 20
    for chosen in (likely, ~likely):
        assert abs(stated[chosen].mean() - true[chosen].mean()) < tolerance


@pytest.mark.parametrize(
    ("arm", "name", "movements"),
    [
        ("7-tight", "random-goal-babbling", 150),
        ("7-tight", "random-goal-babbling", 1000),
        ("7-tight", "sagg-riac", 400),
        ("20-wide", "sagg-riac", 800),
    ],
)
@pytest.mark.parametrize("way", ["nearest", "local"])
def test_of_the_goals_said_to_be_reached_on_noisy_arms_the_stated_share_is(
    arm: str, name: str, movements: int, way: str
) -> None:
    world = ARMS[arm]
    learner = algorithms.make(name, world.task, seed=2)
    Run(learner, world).go(movements)
    goals = reachable_goals(arm)
    stated, true = stated_and_true(learner.by(way), world, goals, (0.01, 0.02, 0.04, 0.08))
    require_calibrated(stated, true, 0.1)


def test_where_nothing_is_noisy_what_was_remembered_is_sure_to_come_again() -> None:
    world, teachers = ThrowingArm(), throwing_teachers()
    learner = algorithms.make("sgim-acts", world.task, list(teachers), seed=2)
    Run(learner, world, teachers).go(800)
    goals = [goal for goal in throwing_goals()[::8] if goal.kind == "throw"]
    stated, true = stated_and_true(learner.by("nearest"), world, goals, (0.005, 0.02, 0.1))
    assert set(stated) == {0.0, 1.0}
    np.testing.assert_array_equal(stated, true)
    # What was not tried is not quite as sure.
    stated, true = stated_and_true(learner, world, goals, (0.005, 0.02, 0.1))
    assert abs(stated.mean() - true.mean()) < 0.05


def test_where_nothing_tells_noise_from_jumps_it_is_cautious() -> None:
    world = ThrowingArm()
    learner = algorithms.make("random", world.task, seed=2)
    for _ in range(500):
        plan = learner.ask()
        learner.tell(plan, world.execute(plan.policy))
    goals = [goal for goal in throwing_goals()[::8] if goal.kind == "throw"]
    stated, true = stated_and_true(learner, world, goals, (0.02, 0.1, 0.3))
    assert stated.mean() < true.mean()


def test_the_wider_the_radius_the_surer_the_goal() -> None:
    world = ARMS["7-tight"]
    learner = algorithms.make("random-goal-babbling", world.task, seed=2)
    Run(learner, world).go(200)
    chances = [
        learner.solve("hand", [0.4, 0.3], radius=radius).probability
        for radius in (0.0, 0.01, 0.03, 0.1, 1.0)
    ]
    assert chances == sorted(chances)  # type: ignore[type-var]
    assert chances[0] < 0.1  # type: ignore[operator]
    assert chances[-1] > 0.9  # type: ignore[operator]
