import numpy as np
import pytest

from sgim.environments import Environment, draw_context, execute_all
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task


class Shift:
    """A user's world with nothing but what it must have."""

    deterministic = False

    def __init__(self, contexts: bool = True) -> None:
        context_space = Box(0, 1) if contexts else None
        self.task = Task(Box(-1, 1), {"place": Box(-3, 3)}, context_space=context_space)

    def execute(
        self, policy: FloatArray, context: FloatArray | None, rng: np.random.Generator | None
    ) -> Outcome:
        shift = 0.0 if context is None else context
        return {"place": policy + shift + (0.0 if rng is None else rng.random())}


class Derived(Shift, Environment):
    pass


class Batching(Shift):
    def execute_batch(self, policies, contexts=None, rngs=None):  # type: ignore[no-untyped-def]
        return [{"place": np.array([7.0])} for _ in policies]


@pytest.mark.parametrize("world", [Shift(), Derived()])
def test_a_world_with_execute_alone_is_executed_trial_by_trial(world: Shift) -> None:
    policies, contexts = np.array([[0.0], [0.5]]), np.array([[1.0], [0.25]])
    rngs = [np.random.default_rng(i) for i in range(2)]
    outcomes = execute_all(world, policies, contexts, rngs)
    for i in range(2):
        expected = world.execute(policies[i], contexts[i], np.random.default_rng(i))
        assert outcomes[i]["place"] == expected["place"]


def test_contexts_and_generators_may_be_left_out() -> None:
    outcomes = execute_all(Shift(contexts=False), [np.array([0.5])])
    assert outcomes[0]["place"] == [0.5]


def test_too_few_contexts_are_an_error() -> None:
    with pytest.raises(ValueError, match="zip"):
        execute_all(Shift(), [np.zeros(1), np.zeros(1)], [np.zeros(1)])


def test_a_worlds_own_batch_is_used() -> None:
    assert execute_all(Batching(), [np.zeros(1)])[0]["place"] == [7.0]


@pytest.mark.parametrize("world", [Shift(), Derived()])
def test_contexts_are_drawn_from_the_context_space(world: Shift) -> None:
    drawn = draw_context(world, np.random.default_rng(3))
    assert world.task.context_space is not None
    assert drawn == world.task.context_space.sample(np.random.default_rng(3))


@pytest.mark.parametrize("world", [Shift(contexts=False), Derived(contexts=False)])
def test_a_world_without_contexts_draws_none(world: Shift) -> None:
    assert draw_context(world, np.random.default_rng(0)) is None
