"""Answering where it is not certain whether outcomes are noisy: noise here and there, and jumps."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.helpers import PLANE, plane, random_policies, remember

from sgim import algorithms
from sgim.environments import PlanarArm
from sgim.environments.benchmark_goals import reachable_goals
from sgim.policy import LocalModel, NearestModel, answering_of
from sgim.policy.answering import Answer
from sgim.records import Goal
from sgim.runs import Benchmark, Run, evaluate, open_repertoire
from sgim.spaces import Box
from sgim.task import Task


def missed(model: NearestModel, way: str, goals: list[Goal], outcome: Any) -> float:
    """The mean distance from goals, if they are answered in a way."""
    model.answering = answering_of(way)
    policies = [model.best_policy(goal, None) for goal in goals]
    reached = zip(policies, goals, strict=True)
    return float(np.mean([np.linalg.norm(outcome(p)[g.kind] - g.point) for p, g in reached]))


class Jumps:
    """Outcomes that jump where two parameters change sign: tried at random, it looks like noise."""

    deterministic = True

    def __init__(self) -> None:
        self.task = Task(Box(-np.ones(6), np.ones(6)), {"place": Box([-1, -1], [1, 1])})

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> dict[str, Any]:
        b = np.asarray(policy)
        side, other = np.sign(b[1] * b[2]), np.sign(b[0] - b[4])
        return {"place": np.array([0.5 * (b[0] + side), 0.7 * b[3] + 0.3 * other])}


def test_a_world_that_says_it_is_deterministic_is_believed(tmp_path: Path) -> None:
    world, path = Jumps(), tmp_path / "jumps.sgim"
    goals = [
        Goal("place", world.execute(b)["place"])
        for b in np.random.default_rng(1).uniform(-1, 1, (80, 6))
    ]
    learner = algorithms.make("random-goal-babbling", world.task, seed=3)
    with Run(learner, world, journal=path) as run:
        run.go(1000)
    benchmark = Benchmark(goals, world)
    nearest = evaluate(learner, benchmark, by="nearest")["total"]
    assert evaluate(learner, benchmark)["total"] <= nearest
    opened = open_repertoire(path)
    assert evaluate(opened, benchmark) == evaluate(learner, benchmark)
    # Who only sees the trials takes jumps for noise, and gives up what would come again.
    seen = algorithms.make("random-goal-babbling", world.task, seed=3)
    for number in range(1000):
        seen.observe(learner.model.memory.trial(number))
    assert evaluate(seen, benchmark)["total"] > nearest
    seen.declare_deterministic()
    assert evaluate(seen, benchmark) == evaluate(learner, benchmark)


@pytest.mark.parametrize("uneven", [False, True])
def test_where_noise_is_uneven_a_local_model_answers_where_outcomes_scatter_little(
    uneven: bool,
) -> None:
    rng = np.random.default_rng(0)

    def scatter(policy: Any) -> float:
        return (2.0 if int(20 * policy[0]) % 5 == 0 else 0.1) if uneven else 0.1

    def outcome(policy: Any) -> dict[str, Any]:
        place = plane(policy)["place"] + np.sin(policy @ [3.0, 4.0])
        return {"place": place + scatter(policy) * rng.standard_normal(2)}

    model = remember(PLANE, outcome, random_policies(PLANE, 600))
    model.answering = LocalModel()
    memory = model.memory.kinds["place"]
    known = model.smoothness(memory)
    assert known is not None
    assert known.noisy
    assert known.trusted != uneven
    goals = [Goal("place", outcome(b)["place"]) for b in random_policies(PLANE, 50, 1)]
    keys = model.memory.keys("place", [goal.point for goal in goals], [None] * len(goals))
    wild = {}
    for name in ("nearest", "local"):
        answers = answering_of(name).answers(memory, keys)
        policies = memory.encoded_policies(np.array([answer.row for answer in answers]))
        wild[name] = np.mean([scatter(policy) > 1 for policy in policies])
        assert all(a.policy is None for a in answers) == (uneven or name == "nearest")
    assert (wild["local"] < 0.5 * wild["nearest"]) == uneven


def test_the_map_of_noisy_outcomes_is_known_while_noise_is_undecided() -> None:
    undecided = PlanarArm(40, limit=np.radians(7))
    still = PlanarArm(12, limit=np.radians(10), noise=0)
    for arm, given in ((undecided, True), (still, False)):
        rng = np.random.default_rng(1)
        outcome = partial(arm.execute, context=None, rng=rng)
        model = remember(arm.task, outcome, random_policies(arm.task, 300))
        model.answering = LocalModel()
        memory = model.memory.kinds["hand"]
        known = model.smoothness(memory)
        assert known is not None
        assert not known.noisy
        assert known.noiseless != given
        assert (model.map_of_noisy(memory) is not None) == given


def test_where_outcomes_jump_and_nobody_says_so_a_local_model_is_nearer_than_the_kernel_mean() -> (
    None
):
    task = Task(Box(-1, 1, names=list("abcd")), {"x": Box(-2, 2, names=["u", "v"])})

    def outcome(p: Any) -> dict[str, Any]:
        return {"x": np.array([p[0] + np.sign(p[1] * p[2]), p[3] + np.sign(p[0] - p[3])])}

    model = remember(task, outcome, random_policies(task, 600))
    memory = model.memory.kinds["x"]
    known = model.smoothness(memory)
    assert known is not None
    assert known.uneven
    goals = [Goal("x", outcome(p)["x"]) for p in random_policies(task, 60, 1)]
    error = {way: missed(model, way, goals, outcome) for way in ("kernel", "local")}
    assert error["local"] < 0.9 * error["kernel"]


FOUR = Task(Box(-1, 1, names=list("abcd")), {"x": Box(-2, 2, names=["u", "v"])})


def bumpy(jumps: bool) -> Any:
    """A world in four parameters, with jumps, or with noise of the same size."""
    rng = np.random.default_rng(5)

    def outcome(p: Any) -> dict[str, Any]:
        smooth = np.array([p[0] + p[1] * p[2], p[3] - p[0] * p[1]])
        jump = np.sign(np.sin(40 * p[:2] + np.sin(30 * p[2:])))
        return {"x": smooth + 0.2 * (jump if jumps else rng.standard_normal(2))}

    return outcome


@pytest.mark.parametrize(("jumps", "most"), [(True, 1.1), (False, 0.7)])
def test_what_was_tried_again_tells_jumps_from_noise(jumps: bool, most: float) -> None:
    outcome, policies = bumpy(jumps), random_policies(FOUR, 300)
    model = remember(FOUR, outcome, policies + policies[:20])
    known = LocalModel().smoothness(model.memory.kinds["x"])
    assert known is not None
    assert known.trusted
    assert known.may_jump
    goals = [Goal("x", outcome(p)["x"]) for p in random_policies(FOUR, 100, 1)]
    error = {way: missed(model, way, goals, outcome) for way in ("nearest", "local")}
    assert error["local"] < most * error["nearest"]


def test_what_was_tried_again_tells_how_sure_an_answer_is() -> None:
    """Where jumps come again, so does what is expected."""
    outcome, policies = bumpy(True), random_policies(FOUR, 300)
    model = remember(FOUR, outcome, policies + policies[:20])
    way, memory = LocalModel(), model.memory.kinds["x"]
    goals = [Goal("x", outcome(p)["x"]) for p in random_policies(FOUR, 100, 1)]
    keys = model.memory.keys("x", [goal.point for goal in goals], [None] * len(goals))
    for radius in (0.02, 0.04):  # of the unit box
        stated, near = [], []
        for key, answer in zip(keys, way.answers(memory, keys), strict=True):
            policy = answer.policy
            if policy is None:
                policy = memory.encoded_policies(np.array([answer.row]))[0]
            reached = outcome(FOUR.policy_space.decode(policy))["x"]
            found = FOUR.outcome_spaces["x"].encode(reached)
            may = way.prospects(memory, answer, key)
            stated.append((np.linalg.norm(may - key, axis=1) < radius).mean())
            near.append(np.linalg.norm(found - key) < radius)
        assert np.mean(stated) == pytest.approx(np.mean(near), abs=0.2)


def test_a_map_that_no_longer_takes_anything_for_noise_answers() -> None:
    """What looked like jumps with few trials may turn out smooth with more."""
    task = Task(Box(0, 1, names=list("abc")), {"x": Box(-1, 2, names=["u", "v"])})

    def outcome(p: Any) -> dict[str, Any]:
        return {"x": np.array([p[0] + 0.1 * np.sin(40 * p[1]), p[1] + 0.1 * np.sin(40 * p[0])])}

    policies = random_policies(task, 4100)
    few = LocalModel().smoothness(remember(task, outcome, policies[:1100]).memory.kinds["x"])
    assert few is not None
    assert few.trusted
    assert few.may_jump
    model = remember(task, outcome, policies)
    now = LocalModel().smoothness(model.memory.kinds["x"])
    assert now is not None
    assert now.noise == 0.0
    goals = [Goal("x", outcome(p)["x"]) for p in random_policies(task, 20, 1)]
    assert missed(model, "local", goals, outcome) < missed(model, "nearest", goals, outcome)


def test_what_a_teacher_repeats_tells_nothing_where_no_search_had_reason_to() -> None:
    """Demonstrations may have been chosen for repeating well."""
    rng = np.random.default_rng(5)

    def outcome(p: Any) -> dict[str, Any]:
        smooth = np.array([p[0] + p[1] * p[2], p[3] - p[0] * p[1]])
        return {"x": smooth + rng.normal(0, 0.03, 2)}

    model = remember(FOUR, outcome, random_policies(FOUR, 300))
    memory, goals = model.memory, [Goal("x", outcome(p)["x"]) for p in random_policies(FOUR, 20, 1)]
    known = LocalModel().smoothness(memory.kinds["x"])
    assert known is not None
    assert known.trusted
    assert not known.may_jump
    memory.extend([memory.trial(number) for number in range(60)])
    way, kind = LocalModel(), memory.kinds["x"]
    for key in memory.keys("x", [goal.point for goal in goals], [None] * len(goals)):
        (answer,) = way.answers(kind, key[None])
        again = Answer(answer.row)  # to do what was remembered once more
        assert np.ptp(way.prospects(kind, again, key), axis=0).min() > 0.005
        assert len(np.unique(way.prospects(kind, again, key), axis=0)) == 10


def test_where_there_is_decidedly_no_noise_a_map_that_promises_more_is_followed() -> None:
    world = PlanarArm(3, noise=0.0)
    model = remember(world.task, world.execute, random_policies(world.task, 100))
    goals = reachable_goals("7-tight")
    error = {"nearest": missed(model, "nearest", goals, world.execute)}
    error["seen"] = missed(model, "local", goals, world.execute)
    model.memory.declare_deterministic()
    error["said"] = missed(model, "local", goals, world.execute)
    assert error["seen"] < 0.8 * error["said"]
    assert error["said"] < error["nearest"]
