"""In noisy worlds `modern` aims within reach; with and without contexts, whatever the goal box."""

from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.memory import Memory
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.runs import Benchmark, Run
from sgim.spaces import Box, FloatArray
from sgim.task import Task

COUNT = 400


def task(context: bool = False, **options: Any) -> Task:
    box = Box([0, 0], [1, 1])
    return Task(
        Box(0, 1, names=["a", "b"]),
        {"place": box},
        context_space=Box(0, 1) if context else None,
        **options,
    )


def goals_of(one: Task, configuration: str, noise: float) -> FloatArray:
    """Goals of a learner whose outcomes can fill the middle only, about a ninth of all."""
    learner = algorithms.make("sagg-riac", one, configuration=configuration, seed=0)
    rng = np.random.default_rng(0)
    context = np.array([0.5]) if one.context_space is not None else None

    def outcome(policy: FloatArray) -> FloatArray:
        return np.clip(0.35 + 0.3 * policy + rng.normal(0, noise, 2), 0, 1)

    for policy in rng.random((COUNT, 2)):
        learner.observe(Trial(policy, {"place": outcome(policy)}, context))
    points = []
    for _ in range(600):
        plan = learner.ask() if context is None else learner.ask(context)
        assert plan.goal is not None
        points.append(plan.goal.point)
        learner.tell(plan, {"place": outcome(plan.policy)})
    return np.array(points[200:])


def middle(points: FloatArray) -> float:
    return float(np.mean((np.abs(points - 0.5) < 0.2).all(axis=1)))


@pytest.mark.parametrize("context", [False, True])
def test_goals_are_within_reach_where_outcomes_are_noisy(context: bool) -> None:
    heeding = goals_of(task(context), "modern", noise=0.02)
    not_heeding = goals_of(task(context), "modern,beyond_noise=0", noise=0.02)
    assert middle(heeding) > 0.4
    assert middle(heeding) > 2 * middle(not_heeding)


def test_where_there_is_decidedly_no_noise_they_follow_gains() -> None:
    one, other = (
        goals_of(task(), configuration, noise=0.0)
        for configuration in ("modern", "modern,beyond_noise=0")
    )
    assert (one == other).all()


@pytest.mark.parametrize("places", [[[0.5, 0.5]], [[0.1, 0.1], [0.9, 0.9]]])
def test_goals_of_a_smaller_box_are_looked_for_where_they_lie_among_outcomes(
    places: list[list[float]],
) -> None:
    one = task(goal_spaces={"place": Box([0.3, 0.3], [0.5, 0.5])})
    model = NearestModel(Memory(one))
    rng = np.random.default_rng(0)
    for place in rng.uniform(0.25, 0.55, (COUNT, 2)):
        model.update(Trial(rng.random(2), {"place": place}))
    assert model.surrounded("place", np.array(places), None).all()
    assert (model.lacks("place", np.array(places), None) < 0.05).all()


class Puck:
    """A puck that is pushed so far, give or take two per cent of it."""

    def __init__(self, noise: float = 0.02) -> None:
        self.noise, self.deterministic = noise, noise == 0
        self.task = Task(Box([0, 0], [np.pi, 3]), {"puck": Box([-1, 0], [1, 1])})

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> dict[str, FloatArray]:
        distance = policy[1] ** 2 / 6
        if self.noise:
            distance *= 1 + self.noise * rng.standard_normal()
        place = distance * np.array([np.cos(policy[0]), np.sin(policy[0])])
        return {"puck": place} if self.task.outcome_spaces["puck"].contains(place) else {}


def puck_errors(noise: float, heights: tuple[float, ...]) -> list[float]:
    """Errors without noise after 300 and 600 pushes."""
    goals = [Goal("puck", np.array([x, y])) for x in (-0.6, 0.0, 0.6) for y in heights]
    run = Run(
        algorithms.make("sagg-riac", Puck(noise).task, seed=0),
        Puck(noise),
        benchmark=Benchmark(goals, Puck(noise=0)),
        evaluate_every=300,
    )
    return [found.errors["puck"] for found in run.go(600)][1:]


def test_noise_in_proportion_to_outcomes_does_not_hide_a_map_that_is_clear() -> None:
    errors = puck_errors(0.02, (0.2, 0.5, 0.7))
    assert max(errors) < 0.005  # the nearest outcomes are 0.02 off


def test_answers_keep_away_from_where_noise_lets_nothing_be_produced() -> None:
    assert puck_errors(0.2, (0.7, 0.8, 0.9))[-1] < 0.15
