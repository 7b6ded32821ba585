"""The ways of answering: which remembered policy, or which other, a goal is answered with."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.helpers import PLANE, plane, random_policies, remember

from sgim import algorithms
from sgim.environments import ARMS, PlanarArm, ThrowingArm
from sgim.environments.benchmark_goals import reachable_goals, throwing_goals
from sgim.errors import SgimError, UnknownNameError
from sgim.memory import Memory
from sgim.policy import ANSWERING, LocalModel, NearestModel, Reliable, answering_of
from sgim.records import Goal, Trial
from sgim.runs import Benchmark, Run, evaluate
from sgim.spaces import Box, Choices
from sgim.task import Task

ARM = ARMS["7-tight"]
WAYS = list(ANSWERING)


def learned(name: str, world: Any, movements: int, seed: int = 1) -> Any:
    learner = algorithms.make(name, world.task, seed=seed)
    Run(learner, world).go(movements)
    return learner


@pytest.fixture(scope="module")
def noisy() -> Any:
    return learned("random-goal-babbling", ARM, 600)


@pytest.fixture(scope="module")
def reach() -> Benchmark:
    return Benchmark(reachable_goals("7-tight"), ARM.without_noise(), "metric")


def test_a_local_model_answers_much_better_than_the_luckiest_outcome(
    noisy: Any, reach: Benchmark
) -> None:
    errors = {way: evaluate(noisy, reach, by=way)["total"] for way in ("nearest", "local")}
    assert errors["local"] < 0.6 * errors["nearest"]


@pytest.mark.parametrize(
    ("name", "world", "goals"),
    [
        ("sagg-riac", ThrowingArm(), throwing_goals()[::5]),
        ("random-goal-babbling", ARM.without_noise(), reachable_goals("7-tight")),
        ("sagg-riac", PlanarArm(2, noise=0.0), reachable_goals("7-tight")),
    ],
)
def test_where_nothing_is_noisy_a_local_model_is_no_worse_than_the_nearest_outcome(
    name: str, world: Any, goals: list[Goal]
) -> None:
    learner = learned(name, world, 400)
    benchmark = Benchmark(goals, world)
    errors = {way: evaluate(learner, benchmark, by=way) for way in ("nearest", "local")}
    assert errors["local"]["total"] <= errors["nearest"]["total"]


def test_where_outcomes_change_smoothly_it_goes_between_what_was_tried() -> None:
    world, rng = PlanarArm(3, noise=0.0), np.random.default_rng(1)
    policies = [world.task.policy_space.sample(rng) for _ in range(60)]
    goals = [Goal("hand", world.execute(policy)["hand"]) for policy in policies]
    learner, benchmark = learned("random", world, 400), Benchmark(goals, world)
    nearest, local = (evaluate(learner, benchmark, by=way)["total"] for way in ("nearest", "local"))
    assert local < 0.5 * nearest


def test_it_does_not_go_where_the_kind_may_not_be_produced() -> None:
    """On a thin, bent layer of policies, steps by the map of those that produced would leave it."""
    task = Task(Box(np.zeros(4), np.ones(4)), {"place": Box([0, 0], [1, 1])})

    def layer(policy: Any) -> float:
        return float(0.5 + 0.4 * np.sin(4 * policy[0]))

    def outcome(policy: Any) -> dict[str, Any]:
        if abs(policy[2] - layer(policy)) > 1e-3:
            return {}
        return {"place": np.array([0.8 * policy[0] + 0.1 * policy[3], policy[1]])}

    rng, model = np.random.default_rng(0), NearestModel(Memory(task), LocalModel())
    for policy in rng.uniform(size=(300, 4)):
        onto = policy.copy()
        onto[2] = layer(policy)
        for tried in (policy, onto):
            model.update(Trial(tried, outcome(tried)))
    model.memory.declare_deterministic()
    goals = [Goal("place", np.array(point)) for point in rng.uniform(0.2, 0.7, (50, 2))]
    for policy in model.best_policies(goals, [None] * len(goals)):
        assert outcome(policy)


def repeated(policies: list[Any], noise: Callable[[Any], Any]) -> NearestModel:
    return remember(PLANE, lambda b: {"place": plane(b)["place"] + noise(b)}, policies)


def test_the_reliable_and_the_kernel_way_prefer_what_comes_again() -> None:
    rng = np.random.default_rng(0)
    steady, wild = np.array([0.2, 0.2]), np.array([0.8, 0.8])
    policies = [centre + 0.01 * rng.standard_normal(2) for centre in [steady, wild] * 20]

    def outcome(policy: Any) -> dict[str, Any]:
        # Both come out at the goal in the mean; where policies are large they scatter widely.
        scatter = 0.05 if policy[0] < 0.5 else 2.0
        return {"place": np.array([5.0, 5.0]) + scatter * rng.standard_normal(2)}

    model = remember(PLANE, outcome, policies)
    # The luckiest of all comes from where they scatter.
    model.update(Trial(wild, {"place": np.array([5.0, 5.0])}))
    goal = Goal("place", np.array([5.0, 5.0]))
    assert model.best_policy(goal, None)[0] > 0.5
    for way in ("reliable", "kernel"):
        answering = answering_of(way)
        chosen = NearestModel(model.memory, answering).best_policy(goal, None)
        assert chosen[0] < 0.5, way


@pytest.mark.parametrize("way", WAYS)
def test_an_answer_does_not_depend_on_what_was_asked_before(noisy: Any, way: str) -> None:
    task, memory = noisy.task, noisy.model.memory
    early, late = (NearestModel(Memory(task), answering_of(way)) for _ in range(2))
    goal = Goal("hand", np.array([0.3, 0.4]))
    for number in range(300):
        for model in (early, late):
            model.update(memory.trial(number))
        if number % 37 == 20:
            early.best_policy(goal, None)
    assert early.best_policy(goal, None).tobytes() == late.best_policy(goal, None).tobytes()
    assert early.solve(goal, None).expected.tobytes() == late.solve(goal, None).expected.tobytes()


@pytest.mark.parametrize("way", WAYS)
def test_answers_stay_within_the_policy_space(noisy: Any, way: str) -> None:
    goals = [[x, y] for x in (-0.5, 0.2, 1.0) for y in (-1.0, 0.0, 1.0)]
    for policy in noisy.by(way).best_policies("hand", goals):
        assert noisy.task.policy_space.contains(policy)


def test_a_local_model_makes_up_for_the_context() -> None:
    arm = PlanarArm(3, noise=0.03, vary_start=True)
    learner = learned("random-goal-babbling", arm, 800)
    goals = [Goal("hand", np.array(p)) for p in ([0.5, 0.3], [0.6, -0.4], [0.2, 0.6], [0.9, 0.1])]
    benchmark = Benchmark(goals * 5, arm.without_noise(), "metric")
    errors = {way: evaluate(learner, benchmark, by=way)["hand"] for way in ("nearest", "local")}
    assert errors["local"] < 0.7 * errors["nearest"]


@pytest.mark.parametrize("way", WAYS)
def test_labels_are_answered_with_what_produced_them(way: str) -> None:
    task = Task(Choices(["left", "right"]), {"word": Choices(["ba", "da"])})
    model = NearestModel(Memory(task), answering_of(way))
    for policy, word in [("left", "ba"), ("right", "da")] * 10:
        model.update(Trial(policy, {"word": word}))
    assert model.best_policy(Goal("word", "ba"), None) == "left"
    assert model.best_policy(Goal("word", "da"), None) == "right"


@pytest.mark.parametrize("way", WAYS)
def test_opaque_policies_are_answered_with_the_nearest_outcome(way: str) -> None:
    class Programs:
        """Policies that nothing compares."""

        dimension = None

        def check(self, value: Any, what: str = "value") -> Any:
            return value

        def contains(self, point: Any) -> bool:
            return True

    model = NearestModel(Memory(Task(Programs(), {"x": Box(0, 1)})), answering_of(way))  # type: ignore[arg-type]
    for number in range(40):
        model.update(Trial(f"program {number}", {"x": np.array([number / 40])}))
    assert model.best_policy(Goal("x", np.array([0.51])), None) == "program 20"


def test_a_repertoire_can_be_asked_in_other_ways_without_changing(noisy: Any) -> None:
    before = noisy.best_policy("hand", [0.4, 0.4])
    assert noisy.by(Reliable()).best_policy("hand", [0.4, 0.4]).shape == (7,)
    assert noisy.by("nearest").model.memory is noisy.model.memory
    assert noisy.best_policy("hand", [0.4, 0.4]).tobytes() == before.tobytes()


def test_a_way_that_is_not_known_is_refused(noisy: Any) -> None:
    with pytest.raises(UnknownNameError, match="Did you mean 'nearest'"):
        noisy.by("nearst")


def test_only_a_memory_can_be_asked_in_several_ways() -> None:
    class Oracle:
        """A model with a way of its own."""

    learner = algorithms.make("random", PLANE)
    learner.model = Oracle()  # type: ignore[assignment]
    with pytest.raises(SgimError, match="Oracle has one way of answering"):
        learner.by("nearest")


def test_random_goal_babbling_starts_from_the_nearest_outcome_however_it_answers() -> None:
    trials = []
    for answering in ("nearest", "local"):
        learner = algorithms.make(
            "random-goal-babbling", ARM.task, configuration=f"modern,answering={answering}", seed=3
        )
        Run(learner, ARM).go(120)
        trials.append(np.array(learner.model.memory.policies.points(np.arange(120))))  # type: ignore[attr-defined]
    np.testing.assert_array_equal(*trials)


def test_the_noise_of_an_arm_is_found(noisy: Any) -> None:
    found = LocalModel().smoothness(noisy.model.memory.kinds["hand"])
    assert found is not None
    assert found.noisy
    spans = ARM.goal_box.range
    np.testing.assert_allclose(np.sqrt(found.noise * found.variance) * spans, 0.02, rtol=0.35)


def test_few_trials_or_equal_ones_teach_nothing() -> None:
    few = remember(PLANE, plane, random_policies(PLANE, 10))
    same = remember(PLANE, plane, [np.array([0.5, 0.5])] * 30)
    for model in (few, same):
        assert LocalModel().smoothness(model.memory.kinds["place"]) is None
        local = NearestModel(model.memory, LocalModel())
        goal = Goal("place", np.array([4.0, 4.0]))
        assert (local.best_policy(goal, None) == model.best_policy(goal, None)).all()
