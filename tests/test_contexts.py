"""Learning where something varies from trial to trial without the learner's doing."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import PlanarArm
from sgim.errors import SpaceError
from sgim.events import Opened
from sgim.learner import Learner
from sgim.outcome.region_tree import Region, RegionTree
from sgim.policy.model import NearestModel
from sgim.strategy.situation import Situation
from sgim.strategy.strategy import JointChoice
from sgim.streams import Streams

ARM = PlanarArm(2, noise=0, vary_start=True, limit=2.0, low=(-1, -1))
STREAMS = Streams(0)
GOALS = 60
EARLY, LATE = 40, 400


def base(number: int) -> np.ndarray:
    context: np.ndarray = ARM.sample_context(STREAMS("context", number))
    return context


def live(learner: Learner, movements: int) -> None:
    while learner.movements < movements:
        plan = learner.ask(context=base(learner.movements))
        learner.tell(plan, ARM.execute(plan.policy, plan.context))


def error(answer: Callable[[np.ndarray, np.ndarray], Any]) -> float:
    """Mean distance in m of the hand from goals that can be reached, each in its own context."""
    errors = []
    for number in range(GOALS):
        rng = STREAMS("benchmark", number)
        context = ARM.sample_context(rng)
        goal = ARM.execute(ARM.task.policy_space.sample(rng), context)["hand"]
        hand = ARM.execute(answer(goal, context), context)["hand"]
        errors.append(np.linalg.norm(hand - goal))
    return float(np.mean(errors))


def knowing(learner: Learner) -> float:
    return error(lambda goal, context: learner.best_policy("hand", goal, context))


def regardless(learner: Learner) -> float:
    """The error of the same memory, asked for the nearest outcome in whatever context."""
    assert isinstance(learner.model, NearestModel)
    memory = learner.model.memory
    outcomes = memory.kinds["hand"].keys.rows[:, :2]

    def answer(goal: np.ndarray, context: np.ndarray) -> Any:
        nearest = np.argmin(((outcomes - ARM.goal_box.encode(goal)) ** 2).sum(axis=1))
        return memory.policies[int(memory.kinds["hand"].trials.rows[nearest])]

    return error(answer)


def tree_of(learner: Learner) -> RegionTree:
    assert isinstance(learner.strategy, JointChoice)
    assert isinstance(learner.strategy.interest, RegionTree)
    return learner.strategy.interest


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("configuration", ["thesis", "modern"])
def test_what_was_learned_is_used_with_regard_to_the_context(configuration: str, seed: int) -> None:
    learner = algorithms.make("sagg-riac", ARM.task, configuration=configuration, seed=seed)
    live(learner, EARLY)
    early = knowing(learner)
    live(learner, LATE)
    assert knowing(learner) < 0.7 * early
    assert knowing(learner) < 0.75 * regardless(learner)


def test_a_context_must_be_given_and_fit_its_space() -> None:
    learner = algorithms.make("sagg-riac", ARM.task, seed=0)
    with pytest.raises(SpaceError, match=r"this task has contexts: pass context=…"):
        learner.ask()
    with pytest.raises(
        SpaceError, match=r"context has shape \(2,\), expected \(1,\): \(base rad\)"
    ):
        learner.ask(context=[0.1, 0.2])
    with pytest.raises(ValueError, match="came with 1 contexts"):
        learner.ask_batch(2, [[0.1]])
    plan = learner.ask(context=[0.1])
    assert plan.context.tolist() == [0.1]
    learner.tell(plan, ARM.execute(plan.policy, plan.context))
    with pytest.raises(SpaceError, match="this task has contexts"):
        learner.best_policy("hand", [0.1, 0.1])
    assert learner.best_policy("hand", [0.1, 0.1], context=[0.3]).shape == (2,)


def test_a_task_without_contexts_refuses_one() -> None:
    learner = algorithms.make("sagg-riac", PlanarArm(2).task, seed=0)
    with pytest.raises(SpaceError, match=r"no context space, but context \[0.1\] came"):
        learner.ask(context=[0.1])


def test_every_plan_has_the_context_it_was_asked_in_also_within_an_episode() -> None:
    learner = algorithms.make("sagg-riac", ARM.task, seed=0)
    episodes = set()
    for number in range(60):
        plan = learner.ask(context=base(number))
        assert plan.context.tolist() == base(number).tolist()
        episodes.add(plan.episode)
        learner.tell(plan, ARM.execute(plan.policy, plan.context))
    assert len(episodes) < 60
    assert isinstance(learner.model, NearestModel)
    remembered = [learner.model.memory.trial(number).context for number in range(60)]
    assert [c.tolist() for c in remembered] == [base(number).tolist() for number in range(60)]


def test_regions_divide_contexts_as_well_as_goals() -> None:
    learner = algorithms.make("sagg-riac", ARM.task, configuration="thesis", seed=0)
    live(learner, 1500)
    tree = tree_of(learner)
    assert {r.axis for r in _inner(tree)} >= {2}
    assert all(len(r.low) == 3 for r in tree.leaves)


def _inner(tree: RegionTree) -> list[Region]:
    found, waiting = [], list(tree.roots.values())
    while waiting:
        region = waiting.pop()
        if region.children is not None:
            found.append(region)
            waiting += region.children
    return found


def test_goals_are_chosen_from_interesting_regions_that_contain_the_present_context() -> None:
    learner, opened = (
        algorithms.make("sagg-riac", ARM.task, configuration="thesis", seed=0),
        list[Opened](),
    )
    learner.record = lambda event: opened.append(event) if isinstance(event, Opened) else None
    live(learner, 1500)
    assert all(event.context is not None for event in opened)
    assert ARM.task.context_space is not None
    tree = tree_of(learner)
    tree.probabilities = (0.0, 0.5, 0.5)
    fewer = 0
    for number in range(300):
        context = base(number)
        place = ARM.task.context_space.encode(context)[0]
        now = Situation(0, (), context)
        goal = learner.strategy.choose(now, STREAMS("choice", number)).goal
        assert goal is not None
        around = [r for r in tree.leaves if r.low[2] <= place <= r.high[2]]
        interests = tree.interests()[[r.leaf for r in around], 0]
        interesting = [r for r, i in zip(around, interests, strict=True) if i > interests.min()]
        point = ARM.goal_box.encode(goal.point)
        assert any(_holds(region, point) for region in interesting or around)
        fewer += len(around) < len(tree.leaves)
    assert fewer > 100


def _holds(region: Region, point: np.ndarray) -> bool:
    low, high = region.low[:2] - 1e-9, region.high[:2] + 1e-9
    return bool((low <= point).all() and (point <= high).all())
