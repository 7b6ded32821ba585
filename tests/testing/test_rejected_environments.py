"""The suites for worlds, teachers and spaces reject parts that break a promise, and say which."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.helpers import PLANE, plane

from sgim.environments import Environment
from sgim.records import Demonstration, Goal
from sgim.spaces import Box
from sgim.task import Task
from sgim.testing import check_environment, check_space, check_teacher

WINDY = Task(PLANE.policy_space, PLANE.outcome_spaces, context_space=Box(0, 2, names=["wind"]))


class World(Environment):
    """A world that keeps its promises: the plane, with wind, noise, or both."""

    task = WINDY
    deterministic = True

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        return {"place": plane(policy)["place"] + context}


class Noisy(World):
    deterministic = False

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        return {"place": plane(policy)["place"] + rng.standard_normal(2)}


def broken(base: type[World] = World, **changes: Any) -> World:
    return type("Broken", (base,), changes)()


def executing(function: Callable[[Any, Any, Any], Any], base: type[World] = World) -> World:
    return broken(
        base, execute=lambda self, policy, context=None, rng=None: function(policy, context, rng)
    )


def batch(function: Callable[[list[Any]], Any]) -> World:
    def execute_batch(self: World, policies: Any, contexts: Any = None, rngs: Any = None) -> Any:
        return function([self.execute(p, c) for p, c in zip(policies, contexts, strict=True)])

    return broken(execute_batch=execute_batch)


def spoil(policy: np.ndarray) -> dict[str, np.ndarray]:
    outcome = plane(policy)
    policy *= 0.5
    return outcome


def spoil_context(policy: np.ndarray, context: np.ndarray) -> dict[str, np.ndarray]:
    context += 1e-9
    return plane(policy)


COUNT, CHANCE, BUFFER = itertools.count(), np.random.default_rng(0), np.zeros(2)


def into_buffer(policy: np.ndarray) -> dict[str, np.ndarray]:
    BUFFER[:] = plane(policy)["place"]
    return {"place": BUFFER}


ENVIRONMENTS = {
    "no task": (broken(task=None), "has a task"),
    "says nothing of noise": (broken(deterministic=None), "says whether it is deterministic"),
    "raises": (executing(lambda p, c, r: 1 / 0), "carries out a policy .* ZeroDivisionError"),
    "no mapping": (executing(lambda p, c, r: plane(p)["place"]), "expected a mapping"),
    "unknown kind": (executing(lambda p, c, r: {"plaice": [1, 2]}), "Did you mean 'place'"),
    "wrong shape": (executing(lambda p, c, r: {"place": [1, 2, 3]}), r"has shape \(3,\)"),
    "not finite": (executing(lambda p, c, r: {"place": [1, np.nan]}), "must be finite"),
    "hidden noise": (executing(lambda p, c, r: {"place": CHANCE.random(2)}), "Set deterministic ="),
    "hidden state": (executing(lambda p, c, r: {"place": [next(COUNT), 0]}), "remove state"),
    "needs a generator": (executing(lambda p, c, r: {"place": r.random(2)}), "accept rng=None"),
    "uses its generator": (
        executing(lambda p, c, r: plane(p) if r is None else {"place": r.random(2)}),
        "in a deterministic world",
    ),
    "noise of its own": (
        executing(lambda p, c, r: {"place": CHANCE.random(2)}, Noisy),
        "the same generator gives the same outcome",
    ),
    "changes its policy": (executing(lambda p, c, r: spoil(p)), "leaves the policy"),
    "changes its context": (executing(lambda p, c, r: spoil_context(p, c)), "leaves the policy"),
    "reuses its outcome": (executing(lambda p, c, r: into_buffer(p)), "stays as it was"),
    "batch rounds otherwise": (
        batch(lambda outcomes: [{"place": o["place"] * (1 + 2e-16)} for o in outcomes]),
        "executed in a batch",
    ),
    "batch in another order": (batch(lambda outcomes: outcomes[::-1]), "executed in a batch"),
    "batch too short": (batch(lambda outcomes: outcomes[1:]), "19 came"),
    "strange context": (
        broken(sample_context=lambda self, rng: np.array([2.1])),
        "lie within the task's context space",
    ),
    "malformed context": (broken(sample_context=lambda self, rng: [1, 2]), "sampled context"),
    "context of no space": (
        broken(task=PLANE, sample_context=lambda self, rng: np.array([1.0])),
        "no context space",
    ),
}


@pytest.mark.parametrize("world", [World(), Noisy()])
def test_the_worlds_to_be_broken_pass_as_they_are(world: World) -> None:
    check_environment(world)


@pytest.mark.parametrize(("world", "message"), ENVIRONMENTS.values(), ids=ENVIRONMENTS.keys())
def test_a_world_that_breaks_a_promise_is_rejected(world: World, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        check_environment(world)


class Teaching:
    """A teacher made of a function of the goal and the generator."""

    def __init__(self, function: Callable[[Any, np.random.Generator], Any]) -> None:
        self.function = function

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Any:
        return self.function(goal, rng)


def shown(policy: Any, **outcome: Any) -> Demonstration:
    return Demonstration(outcome or plane(policy), policy)


def spoil_goal(goal: Goal | None) -> Demonstration:
    if goal is not None:
        goal.point[0] += 1
    return shown(np.zeros(2))


def refill(value: float) -> Demonstration:
    BUFFER[:] = value
    return Demonstration({"place": BUFFER}, np.zeros(2))


TEACHERS = {
    "not a demonstration": (lambda g, r: plane(r.random(2)), "answered with a dict"),
    "no outcome": (lambda g, r: Demonstration({}, r.random(2)), "without an outcome"),
    "malformed policy": (lambda g, r: shown(r.random(3), place=[1, 2]), r"shape \(3,\)"),
    "unknown kind": (lambda g, r: shown(r.random(2), spot=[1, 2]), "outcome kind 'spot'"),
    "not finite": (lambda g, r: shown(r.random(2), place=[1, np.inf]), "must be finite"),
    "chance of its own": (lambda g, r: shown(CHANCE.random(2)), "get the same answer"),
    "state": (lambda g, r: None if next(COUNT) % 3 else shown(r.random(2)), "keep no state"),
    "changes the goal": (lambda g, r: spoil_goal(g), "leaves the goal"),
    "needs a goal": (lambda g, r: shown(r.random(2), place=g.point), "A goal of None"),
    "reuses its outcome": (lambda g, r: refill(r.random()), "stays as it was"),
}


def test_a_teacher_who_keeps_the_promises_passes() -> None:
    check_teacher(Teaching(lambda goal, rng: shown(rng.random(2))), PLANE)


@pytest.mark.parametrize(("function", "message"), TEACHERS.values(), ids=TEACHERS.keys())
def test_a_teacher_who_breaks_a_promise_is_rejected(function: Any, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        check_teacher(Teaching(function), PLANE)


SPACES = {
    "loses bits": ({"pack": lambda s, p: p.astype("f4").tobytes()}, "pack and unpack|exactly"),
    "samples outside": ({"sample": lambda s, rng: np.full(2, 1.5)}, "denies it"),
    "chance of its own": ({"sample": lambda s, rng: CHANCE.random(2)}, "same generator"),
    "check refuses": ({"check": lambda s, v, what="": 1 / 0}, "check accepts a sampled point"),
    "encodes otherwise": ({"encode": lambda s, p: p[:1]}, r"finite vector of shape \(2,\)"),
    "encodes unscaled": ({"encode": lambda s, p: 3 + p}, "encoded in the unit box"),
    "description": ({"describe": lambda s: {"low": s.low}}, "what JSON can hold"),
    "changing description": ({"describe": lambda s: {"n": next(COUNT)}}, "the same description"),
}


@pytest.mark.parametrize(("changes", "message"), SPACES.values(), ids=SPACES.keys())
def test_a_space_that_breaks_a_promise_is_rejected(changes: Any, message: str) -> None:
    space = type("Broken", (Box,), changes)(0, 1, names=["a", "b"])
    with pytest.raises(AssertionError, match=message):
        check_space(space)


def test_an_opaque_space_passes_without_encoding() -> None:
    changes = {"dimension": None, "encode": lambda space, point: 1 / 0}
    check_space(type("Opaque", (Box,), changes)(0, 1, names=["a", "b"]))
