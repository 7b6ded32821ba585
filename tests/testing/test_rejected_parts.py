"""The suites for the learner's own levels reject parts that break a promise, and say which."""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.helpers import PLANE

from sgim.memory import Memory
from sgim.outcome.interest import UniformGoals
from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.policy.simple import RandomPolicies
from sgim.records import Goal
from sgim.spaces import Box
from sgim.testing import check_explorer, check_interest_map, check_model

SPACES = {"place": Box(0, 1), "throw": Box([0, 0], [1, 1])}
MODES = ["alone", "mimic", "emulate"]
WIND = Box(0, 2)
CHANCE, COUNT = np.random.default_rng(0), itertools.count()


class Map(UniformGoals):
    """A map that learns a little: how many episodes each mode had."""

    def __init__(self) -> None:
        super().__init__(SPACES)
        self.counts = dict.fromkeys(MODES, 0)

    def update(self, report: Any) -> None:
        if report.mode in self.counts:
            self.counts[report.mode] += 1

    def choose(self, rng: Any, modes: Sequence[str], context: Any) -> tuple[Goal, str]:
        goal, mode = super().choose(rng, modes, context)
        return goal, min(modes, key=self.counts.__getitem__) if rng.random() < 0.5 else mode


def choosing(function: Callable[..., Any]) -> type[Map]:
    """A map whose choice is changed: a function of the map, the choice, and the arguments."""

    def choose(self: Map, rng: Any, modes: Any, context: Any) -> Any:
        return function(self, *Map.choose(self, rng, modes, context), rng, modes, context)

    return type("Broken", (Map,), {"choose": choose})


def updating(function: Callable[[Map, Any], Any]) -> type[Map]:
    return type("Broken", (Map,), {"update": function})


def learn_in_choose(self: Map, goal: Goal, mode: str, *_: Any) -> Any:
    self.counts[mode] += 1
    return goal, mode


def refuse_repetition(self: Map, report: Any) -> None:
    self.last = [*getattr(self, "last", []), report.chosen.point.tobytes()][-40:]
    if len(self.last) == 40 and len(set(self.last)) == 1:
        raise ValueError("nothing to split")


def by_object(self: Map, goal: Goal, mode: str, rng: Any, modes: Any, context: Any) -> Any:
    if not hasattr(self, "number"):
        self.number = next(COUNT)
    return Goal("place", np.array([0.1 * (self.number % 2)])), mode


def without(modes: list[str]) -> str:
    return modes.pop()


MAPS = {
    "unknown kind": (choosing(lambda s, g, m, *_: (Goal("spot", g.point), m)), "of the kinds"),
    "not a goal": (choosing(lambda s, g, m, *_: (g.point, m)), "gives a Goal"),
    "goal outside": (choosing(lambda s, g, m, *_: (Goal(g.kind, g.point + 1), m)), "within its"),
    "mode not offered": (choosing(lambda s, g, m, *_: (g, "mimic")), "teachers of others are away"),
    "takes from the list": (choosing(lambda s, g, m, r, o, c: (g, without(o))), "list as it is"),
    "chance of its own": (
        choosing(lambda s, g, m, *_: (Goal("place", CHANCE.random(1)), m)),
        "choosing changes nothing",
    ),
    "learns in choose": (choosing(learn_in_choose), "choosing changes nothing"),
    "depends on the object": (choosing(by_object), "two maps that got the same reports"),
    "fails on a subset": (
        choosing(lambda s, g, m, r, o, c: (g, m) if len(o) == 3 else 1 / 0),
        "also when only some modes",
    ),
    "fails on unknown modes": (updating(lambda s, r: s.counts[r.mode]), "KeyError"),
    "fails on goals outside": (
        updating(lambda s, r: 1 / SPACES[r.pursued.kind].contains(r.pursued.point)),
        "goals outside their space",
    ),
    "fails without progress": (
        updating(lambda s, r: 1 / (r.after - r.before)),
        "progress may be zero",
    ),
    "fails on repetition": (updating(refuse_repetition), "hundreds of goals may be the same"),
    "fails on contexts outside": (
        choosing(lambda s, g, m, r, o, c: (g, m) if WIND.contains(c) else 1 / 0),
        "ZeroDivisionError",
    ),
}


def test_the_map_to_be_broken_passes_as_it_is() -> None:
    check_interest_map(Map, SPACES, MODES, context_space=WIND)


@pytest.mark.parametrize(("make", "message"), MAPS.values(), ids=MAPS.keys())
def test_an_interest_map_that_breaks_a_promise_is_rejected(make: Any, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        check_interest_map(make, SPACES, MODES, context_space=WIND)


def model(**changes: Any) -> Callable[[], NearestModel]:
    return lambda: type("Broken", (NearestModel,), changes)(Memory(PLANE))


def solving(**changes: Any) -> Callable[[], NearestModel]:
    def solve(self: NearestModel, goal: Goal, context: Any, radius: float | None = None) -> Any:
        return replace(NearestModel.solve(self, goal, context, radius), **changes)

    return model(solve=solve)


def batch_of(function: Callable[[list[Any]], Any]) -> Callable[[], NearestModel]:
    return model(best_policies=lambda s, g, c: function(NearestModel.best_policies(s, g, c)))


def answering(function: Callable[[Any], Any]) -> Callable[[], NearestModel]:
    return model(best_policy=lambda s, g, c: function(NearestModel.best_policy(s, g, c)))


def forget(self: NearestModel, goal: Goal, context: Any) -> Any:
    NearestModel.best_policy(self, goal, context)
    return self.memory.policies[0]


MODELS = {
    "unknown competence": (model(competence=lambda s, g, c: np.nan), "a finite number"),
    "competence by chance": (model(competence=lambda s, g, c: CHANCE.random()), "if asked twice"),
    "fails on nothing": (model(update=lambda s, t: t.outcome["place"]), "produced nothing"),
    "shows infinity": (model(shown_by=lambda s, t, g, c: -np.inf), "finite number, or None"),
    "answers too early": (model(best_policy=lambda s, g, c: np.zeros(2)), "NoAnswerError"),
    "another error": (model(best_policy=lambda s, g, c: s.memory.policies[0]), "NoAnswerError"),
    "batch invents": (batch_of(lambda b: [np.zeros(2) for _ in b]), "None where nothing"),
    "batch rounds": (
        batch_of(lambda b: [p if p is None else p * (1 - 1e-16) for p in b]),
        "what best_policy gives",
    ),
    "batch too short": (batch_of(lambda b: b[:1]), "one policy a goal"),
    "out of bounds": (answering(lambda b: b + 1), "within the policy space"),
    "by chance": (answering(lambda b: CHANCE.random(2)), "the same policy"),
    "not the nearest": (model(best_policy=forget), "best_policy gives|reproduces it"),
    "solves otherwise": (solving(policy=np.zeros(2)), "the policy that best_policy gives"),
    "another expected": (solving(expected=np.array([3.0, 3.0])), "the scaled distance"),
    "malformed expected": (solving(expected="near"), "solve answers"),
    "cost above one": (solving(cost=1.5), r"lies in \[0, 1\]"),
    "negative spread": (solving(spread=np.array([0.1, -0.1])), "none negative"),
    "one spread for two": (solving(spread=np.array([0.1])), "the spread is 2"),
}


def test_a_model_that_only_knows_competence_passes() -> None:
    class Counting:
        def __init__(self) -> None:
            self.count = 0

        def update(self, trial: Any) -> None:
            self.count += 1

        def competence(self, goal: Goal, context: Any) -> float:
            return float(self.count)

        def shown_by(self, trial: Any, goal: Goal, context: Any) -> None:
            return None

    check_model(Counting, PLANE)


@pytest.mark.parametrize(("make", "message"), MODELS.values(), ids=MODELS.keys())
def test_a_model_that_breaks_a_promise_is_rejected(make: Any, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        check_model(make, PLANE)


def explorer(**changes: Any) -> Callable[[Any], RandomPolicies]:
    return lambda _: type("Broken", (RandomPolicies,), changes)(PLANE.policy_space)


def proposing(function: Callable[[list[Episode], list[Any]], Any]) -> Callable[[Any], Any]:
    return explorer(propose=lambda s, e: function(e, RandomPolicies.propose(s, e)))


def counting_when_told(model: NearestModel) -> RandomPolicies:
    """One that looks at the model when it hears of a trial."""

    class Looking(RandomPolicies):
        def learn(self, episode: Episode, trial: Any, competence: float | None) -> None:
            episode.state = len(model.memory)

        def propose(self, episodes: Any) -> list[Any]:
            known = [1 + (episode.state or 0) for episode in episodes]
            policies = super().propose(episodes)
            return [policy / n for policy, n in zip(policies, known, strict=True)]

    return Looking(PLANE.policy_space)


EXPLORERS = {
    "out of bounds": (proposing(lambda e, b: [p + 1 for p in b]), "within the bounds"),
    "chance of its own": (proposing(lambda e, b: [CHANCE.random(2) for _ in b]), "episode.rng"),
    "too few": (proposing(lambda e, b: b[:1]), "one policy for each"),
    "depends on company": (proposing(lambda e, b: [p / len(b) for p in b]), "on the others"),
    "depends on rounding of company": (
        proposing(lambda e, b: [p * (1 - len(b) * 1e-16) for p in b]),
        "to the last bit, on the others",
    ),
    "keeps state of its own": (
        explorer(
            begin=lambda s, e: setattr(s, "rng", e.rng),
            propose=lambda s, e: [s.rng.random(2) for _ in e],
        ),
        "on the others",
    ),
    "asks the model when told": (counting_when_told, "already knows the other trials"),
    "fails to begin": (explorer(begin=lambda s, e: 1 / 0), "begin prepares"),
    "fails when refused": (explorer(refuse=lambda s, e: 1 / 0), "must not be executed"),
    "fails on nothing produced": (
        explorer(learn=lambda s, e, t, c: t.outcome["place"]),
        "one that produced nothing",
    ),
    "fails to end": (explorer(finished=lambda s, e: 1 / 0), "nothing left to gain"),
    "fails when nothing is known": (
        explorer(begin=lambda s, e: 1 / (1 + e.before)),
        "nothing is known yet",
    ),
}


@pytest.mark.parametrize(("make", "message"), EXPLORERS.values(), ids=EXPLORERS.keys())
def test_an_explorer_that_breaks_a_promise_is_rejected(make: Any, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        check_explorer(make, PLANE)
