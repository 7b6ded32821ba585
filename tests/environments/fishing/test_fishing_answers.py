"""Answers in a world whose noise is heavy-tailed and differs from place to place."""

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments.fishing import FishingRod, fishing_goals
from sgim.runs import Run

pytest.importorskip("mujoco")


def test_of_the_goals_said_to_be_reached_the_stated_share_is() -> None:
    rod = FishingRod()
    learner = algorithms.make("sagg-riac", rod.task, seed=2)
    Run(learner, rod).go(600)
    stated, true = [], []
    for number, goal in enumerate(fishing_goals()[::6]):
        rng = np.random.default_rng(number)
        policy = learner.best_policy(goal.kind, goal.point)
        outcomes = [rod.execute(policy, None, rng) for _ in range(3)]
        misses = [
            float(np.linalg.norm(o["float"] - goal.point)) / 2 if "float" in o else 1.0
            for o in outcomes
        ]
        for radius in (0.02, 0.05, 0.1, 0.2):
            stated.append(learner.solve(goal.kind, goal.point, radius=radius).probability)
            true.append(float(np.mean([miss <= radius for miss in misses])))
    assert abs(np.mean(np.array(stated)) - np.mean(true)) < 0.15
