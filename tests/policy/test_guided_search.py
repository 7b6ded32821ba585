"""Search guided by a map of the whole while trials are few."""

import itertools
import math
import random
import shutil
import sqlite3
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.helpers import episode_for, random_policies, remember

from sgim import algorithms
from sgim.configurations import configuration_of
from sgim.environments import PlanarArm
from sgim.errors import SettingError
from sgim.learner import Learner
from sgim.memory import Memory
from sgim.policy import GuidedSearch, LocalSearch, NearestModel, guided_trials
from sgim.policy.guided_search import MOST_TRIALS, OPERATIONS_PER_SECOND
from sgim.records import Goal, Trial
from sgim.runs import Run
from sgim.spaces import Box, Choices
from sgim.task import Task

ARM = PlanarArm(7)
QUIET = PlanarArm(7, noise=0)
THINKING = "modern,seconds_per_trial=1"


def knowing(world: PlanarArm, count: int, seed: int = 0) -> NearestModel:
    rng = np.random.default_rng(seed)
    policies = random_policies(world.task, count, seed)
    return remember(world.task, lambda policy: world.execute(policy, None, rng), policies)


def goals(count: int) -> list[Goal]:
    policies = np.array(random_policies(ARM.task, count, 9))
    return [Goal("hand", hand) for hand in ARM.hands(policies)]


def proposed(search: Any, some: list[Goal]) -> np.ndarray:
    episodes = [episode_for(search.model, goal, seed=i) for i, goal in enumerate(some)]
    for episode in episodes:
        search.begin(episode)
    return np.array(search.propose(episodes))


def misses(policies: np.ndarray, some: list[Goal]) -> np.ndarray:
    gaps: np.ndarray = np.linalg.norm(ARM.hands(policies) - [goal.point for goal in some], axis=1)
    return gaps


def test_with_few_noisy_trials_a_map_comes_nearer_than_the_local_search() -> None:
    model, some = knowing(ARM, 100), goals(60)
    straight = {"variation": (1e-6, 1e-5), "least_global": 0.0}
    local = LocalSearch(model, **straight)  # type: ignore[arg-type]
    guided = GuidedSearch(local, above_noise=0.0, **straight)  # type: ignore[arg-type]
    gaps = [np.median(misses(proposed(search, some), some)) for search in (guided, local)]
    assert gaps[0] < 0.6 * gaps[1]


def test_variations_are_no_smaller_than_noise() -> None:
    model = knowing(ARM, 120)
    some = goals(1) * 200
    effects = []
    for least in (0.0, 4.0):
        search = GuidedSearch(
            LocalSearch(model),
            variation=(1e-6, 1e-5),
            above_noise=least,
            variations=1,
            least_global=0.0,
        )
        hands = ARM.hands(proposed(search, some))
        effects.append(float(np.sqrt(hands.var(axis=0).sum())))
    assert effects[0] < 0.1 * ARM.noise
    assert effects[1] > 2 * ARM.noise


def test_variations_are_no_longer_than_the_map_says_something_of() -> None:
    """What is lacking may be out of reach; but a quarter of the box's side is never too far."""
    model, far = knowing(ARM, 120), [Goal("hand", np.array([9.0, 9.0]))] * 200
    spread = []
    for most in (0.0, 0.15, 0.6, math.inf):
        search = GuidedSearch(
            LocalSearch(model), most_of_length=most, variations=1, least_global=0.0, above_noise=0.0
        )
        spread.append(ARM.task.policy_space.encode(proposed(search, far)).std(axis=0).mean())
    assert 0.1 < math.sqrt(7) * spread[0] < 0.25  # some of it is cut off by the box
    assert spread[0] <= spread[1] < spread[2] < spread[3]


def test_of_several_variations_the_least_certain_is_tried() -> None:
    model, some = knowing(ARM, 120), goals(60)
    uncertain = []
    for count in (1, 12):
        search = GuidedSearch(LocalSearch(model), variations=count, least_global=0.0)
        policies = proposed(search, some)
        (known,) = search._maps.values()
        uncertain.append(known.expected(ARM.task.policy_space.encode(policies))[1].mean())
    assert uncertain[1] > 1.2 * uncertain[0]


def test_once_trials_are_many_it_is_the_local_search() -> None:
    model, some = knowing(ARM, 80), goals(10)
    local = LocalSearch(model)
    expected = proposed(local, some)
    assert (proposed(GuidedSearch(local, 80), some) == expected).all()
    assert (proposed(GuidedSearch(local, 81), some) != expected).any()


def test_before_a_map_can_be_learned_it_is_the_local_search() -> None:
    model, some = knowing(ARM, 15), goals(10)
    local = LocalSearch(model)
    assert (proposed(GuidedSearch(local), some) == proposed(local, some)).all()


def test_where_noise_hides_the_map_it_is_the_local_search() -> None:
    task = Task(Box(0, 1, names=["a", "b"]), {"x": Box(0, 1)})
    rng = np.random.default_rng(0)
    model = remember(task, lambda _: {"x": rng.random(1)}, random_policies(task, 60))
    some = [Goal("x", np.array([x])) for x in (0.1, 0.5, 0.9)]
    local = LocalSearch(model)
    assert (proposed(GuidedSearch(local), some) == proposed(local, some)).all()


@pytest.mark.parametrize("far", [1e8, 1e80, 1e149])
def test_outcomes_beyond_all_bounds_leave_policies_within_theirs(far: float) -> None:
    model = knowing(ARM, 40)
    for policy in random_policies(ARM.task, 3, 7):
        model.update(Trial(policy, {"hand": np.array([far, -far])}))
    search = GuidedSearch(LocalSearch(model), least_global=0.0)
    for policy in proposed(search, goals(20)):
        assert np.isfinite(policy).all()
        assert ARM.task.policy_space.contains(policy)


def test_policies_that_never_differ_or_outcomes_that_never_do_are_no_trouble() -> None:
    for policies, world in (
        ([np.zeros(7)] * 40, QUIET.execute),
        (random_policies(ARM.task, 40), lambda _: {"hand": np.array([0.5, 0.5])}),
    ):
        search = GuidedSearch(LocalSearch(remember(ARM.task, world, policies)))
        assert np.isfinite(proposed(search, goals(20))).all()


def test_a_map_makes_up_for_the_present_context() -> None:
    task = Task(Box(0, 1), {"x": Box(0, 2)}, context_space=Box(0, 1))
    model = NearestModel(Memory(task))
    rng = np.random.default_rng(0)
    for policy, wind in rng.random((60, 2)):
        noise = 0.01 * rng.standard_normal()
        trial = Trial(np.array([policy]), {"x": [policy + wind + noise]}, np.array([wind]))
        model.update(trial)
    search = GuidedSearch(LocalSearch(model), variation=(1e-6, 1e-5), above_noise=0.0)
    for wind in (0.1, 0.5, 0.8):
        episodes = [
            episode_for(model, Goal("x", np.array([0.9])), np.array([wind]), seed)
            for seed in range(9)
        ]
        for episode in episodes:
            search.begin(episode)
        landed = np.array(search.propose(episodes))[:, 0] + wind
        assert abs(np.median(landed) - 0.9) < 0.02


def test_kinds_of_outcome_without_a_map_leave_it_to_the_local_search() -> None:
    task = Task(Box(0, 1, names=["a", "b"]), {"x": Box(0, 1), "seen": Choices(["yes", "no"])})

    def world(policy: np.ndarray) -> dict[str, Any]:
        return {"x": policy[:1], "seen": "yes" if policy[0] > 0.5 else "no"}

    task_of_numbers = Task(task.policy_space, {"x": Box(0, 1)})
    learner = algorithms.make("sagg-riac", task_of_numbers, configuration=THINKING, seed=1)
    assert isinstance(learner.strategy.modes["autonomous"].explorer, GuidedSearch)
    model = remember(task, world, random_policies(task, 60))
    search = GuidedSearch(LocalSearch(model))
    assert np.isfinite(proposed(search, [Goal("x", np.array([0.3]))])).all()
    assert model.smoothness(model.memory.kinds["seen"]) is None


def test_seconds_are_turned_into_trials_by_operations_and_not_by_a_clock() -> None:
    assert [guided_trials(s) for s in (0.0, 0.1, 0.3)] == [0, 0, 0]
    assert guided_trials(1) == 704
    assert guided_trials(1e6) == MOST_TRIALS
    for seconds in (0.5, 1.0, 5.0, 30.0):
        n = guided_trials(seconds)
        operations = [2 * count**3 + 3e8 for count in (n, n + 1)]
        assert operations[0] <= seconds * OPERATIONS_PER_SECOND < operations[1]


def guided_at(run: Run, movements: int, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Go on; how many trials were remembered whenever a map decided what to try."""
    asked: list[int] = []
    varied = GuidedSearch._varied

    def counted(self: GuidedSearch, *others: Any) -> Any:
        asked.append(len(self.model.memory))
        return varied(self, *others)

    monkeypatch.setattr(GuidedSearch, "_varied", counted)
    run.go(movements)
    return asked


@pytest.mark.parametrize("seconds", [0.4, 1.0])
def test_no_map_is_asked_once_the_budget_is_used_up(
    seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    most = guided_trials(seconds)
    configuration = f"modern,seconds_per_trial={seconds}"
    learner = algorithms.make("sagg-riac", QUIET.task, configuration=configuration, seed=1)
    asked = guided_at(Run(learner, QUIET), most + 60, monkeypatch)
    assert most - 5 < asked[-1] < most  # the last of all may be a random policy
    assert len(asked) > 0.7 * most
    assert not learner.strategy.modes["autonomous"].explorer._maps  # type: ignore[attr-defined]


@pytest.mark.parametrize("seconds", [-1.0, math.inf, math.nan])
def test_a_budget_is_a_number_of_seconds(seconds: float) -> None:
    with pytest.raises(SettingError, match=r"expected seconds, or 0 for little"):
        configuration_of({**configuration_of("modern").describe(), "seconds_per_trial": seconds})


def test_with_no_seconds_stated_only_the_first_trials_of_a_noisy_world_are_guided(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked = guided_at(Run(algorithms.make("sagg-riac", ARM.task, seed=1), ARM), 300, monkeypatch)
    assert len(asked) > 150
    assert asked[-1] == 255


def test_with_no_seconds_stated_nothing_is_guided_in_a_deterministic_world(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    learner = algorithms.make("sagg-riac", QUIET.task, seed=1)
    assert guided_at(Run(learner, QUIET), 100, monkeypatch) == []


def test_without_seconds_and_first_trials_the_local_search_decides_alone() -> None:
    learner = algorithms.make("sagg-riac", ARM.task, configuration="modern,guided_if_noisy=0")
    assert isinstance(learner.strategy.modes["autonomous"].explorer, LocalSearch)
    described = configuration_of("modern").describe()
    del described["seconds_per_trial"], described["guided_if_noisy"]  # as journals of before are
    assert configuration_of(described) == configuration_of(described | {"guided_if_noisy": 0})
    with pytest.raises(SettingError, match="guided_if_noisy is -1, expected 0 or more"):
        configuration_of("modern,guided_if_noisy=-1")


def test_where_outcomes_jump_the_local_search_decides() -> None:
    task = Task(Box(-1, 1, names=list("abcdef")), {"x": Box(-1, 1, names=["a", "b", "c"])})
    rng = np.random.default_rng(0)

    def world(policy: np.ndarray) -> dict[str, Any]:
        steep = np.tanh(policy[:3] * [2, 0.2, 20] + 0.3 * np.sin(3 * policy[3:]))
        return {"x": steep + 0.01 * rng.standard_normal(3)}

    model = remember(task, world, random_policies(task, 80))
    smoothness = model.smoothness(model.memory.kinds["x"])
    assert smoothness is not None
    assert not smoothness.drowned
    assert not smoothness.guides
    some = [Goal("x", point) for point in rng.uniform(-0.5, 0.5, (10, 3))]
    local = LocalSearch(model)
    assert (proposed(GuidedSearch(local), some) == proposed(local, some)).all()


def rows(path: Path) -> list[tuple[object, ...]]:
    """All events but those that only say which process wrote."""
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT * FROM events WHERE event != 'session' ORDER BY seq").fetchall()
    return [row[1:] for row in found]


@pytest.mark.parametrize("batch", [1, 7, 40])
@pytest.mark.parametrize("world", [ARM, PlanarArm(3, vary_start=True)], ids=["plain", "contexts"])
def test_a_guided_run_cut_off_anywhere_ends_as_one_that_never_was(
    tmp_path: Path, batch: int, world: PlanarArm
) -> None:
    """Cut while a map grows, where it is made anew, inside of batches, and once it is given up."""

    def go(path: Path) -> None:
        configuration = "modern,seconds_per_trial=0.304"  # 125 trials
        learner = algorithms.make("sagg-riac", world.task, configuration=configuration, seed=3)
        with Run(learner, world, journal=path, batch=batch) as run:
            run.go(160)

    whole, part = tmp_path / "whole.sgim", tmp_path / "part.sgim"
    go(whole)
    expected = rows(whole)
    with sqlite3.connect(whole) as db:
        written = db.execute("SELECT seq, event FROM events ORDER BY seq").fetchall()
    ends = [one[0] for one, after in itertools.pairwise(written) if after[1] != "also"]
    for place in random.Random(batch).sample(ends, 12):
        shutil.copy(whole, part)
        with sqlite3.connect(part) as db:
            db.execute("DELETE FROM events WHERE seq > ?", (place,))
        db.close()
        go(part)
        assert rows(part) == expected, f"cut after event {place}"
        part.unlink()


def tried(learner: Learner, together: bool) -> list[Any]:
    policies = []
    rng = np.random.default_rng(0)
    for _ in range(20):
        plans = learner.ask_batch(6) if together else [learner.ask() for _ in range(6)]
        policies += [plan.policy for plan in plans]
        outcomes = [ARM.execute(plan.policy, None, rng) for plan in plans]
        if together:
            learner.tell_batch(plans, outcomes)
        else:
            for plan, outcome in zip(plans, outcomes, strict=True):
                learner.tell(plan, outcome)
    return policies


def test_batches_are_decided_as_one_by_one() -> None:
    made = [
        algorithms.make("sagg-riac", ARM.task, configuration=THINKING, seed=2) for _ in range(2)
    ]
    together, alone = (
        tried(learner, how) for learner, how in zip(made, (True, False), strict=True)
    )
    assert (np.array(together) == np.array(alone)).all()
