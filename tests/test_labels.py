"""Learners of labels: whom they ask, what they choose, and that their runs resume exactly."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from sgim import algorithms, labels
from sgim.environments.objects.table import ACTIONS
from sgim.errors import SgimError, SpaceError, UnknownNameError
from sgim.learner import Learner
from sgim.recognition import FEATURES, Features
from sgim.records import Demonstration, Goal, Outcome
from sgim.runs import Journal, Run
from sgim.spaces import Box, Choices
from sgim.task import Task

TOYS = Choices(["cubes", "car", "dog"])
POLICIES = Choices([f"{action} {toy}" for action in ACTIONS for toy in TOYS.labels])
TASK = Task(POLICIES, {"view": FEATURES, "toy": TOYS}, goal_spaces={"toy": TOYS})
VIEWS = {"cubes": 30, "car": 3, "dog": 1}
"""From how many sides each toy looks different."""


class MadeUpTable:
    """Toys whose features are made up: each side of a toy has colours of its own."""

    task = TASK
    deterministic = False

    def execute(self, policy: str, context: None, rng: np.random.Generator | None) -> Outcome:
        assert rng is not None
        return seen(policy.partition(" ")[2], rng)


def seen(toy: str, rng: np.random.Generator) -> Outcome:
    side = rng.integers(VIEWS[toy])
    paints = np.random.default_rng([TOYS.labels.index(toy), side]).uniform(0, 400, (4, 3))
    colours = paints[rng.integers(4, size=12)] + rng.normal(0, 2, (12, 3))
    nothing = np.zeros((0, 2), np.float32)
    places = rng.uniform(0, 50, (12, 2)).astype(np.float32)
    view = Features(
        nothing,
        np.zeros((0, 128), np.uint8),
        places,
        colours.astype(np.float32),
        rng.integers(0, 255, (1, 16), dtype=np.uint8),
    )
    return {"view": view.arrays, "toy": toy}


class MadeUpCaregiver:
    """Shows what is asked for; now and then he may have no time."""

    def __init__(self, declines: float = 0.1) -> None:
        self.declines = declines

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
        assert goal is not None
        shown = Demonstration(seen(goal.point, rng), f"watch {goal.point}")
        return None if rng.random() < self.declines else shown


def made(name: str = "sgim-acts", seed: int = 0, configuration: str = "modern") -> Learner:
    return algorithms.make(name, TASK, "caregiver", configuration=configuration, seed=seed)


def lived(
    learner: Learner, movements: int, journal: Path | None = None, declines: float = 0.1
) -> list[tuple[str, str]]:
    """Toys and modes of the episodes of a run, in order."""
    caregiver = MadeUpCaregiver(declines)
    with Run(learner, MadeUpTable(), {"caregiver": caregiver}, journal=journal) as run:
        episodes: list[tuple[str, str]] = []
        note = learner.record

        def record(event: object) -> None:
            if type(event).__name__ == "Opened":
                episodes.append((event.goal.point, event.mode))  # type: ignore[attr-defined]
            if note is not None:
                note(event)  # type: ignore[arg-type]

        learner.record = record
        run.go(movements)
    return episodes


@pytest.mark.parametrize("name", ["random", "sgim-acts", "oracle"])
def test_every_toy_is_presented_once_first_by_whoever_learns(name: str) -> None:
    episodes = lived(made(name), 30)
    assert [toy for toy, _ in episodes[:3]] == list(TOYS.labels)
    assert {mode for _, mode in episodes[:3]} == {"ask caregiver"}
    assert {mode for _, mode in episodes[3:]} == {"push", "lift", "ask caregiver"}


def test_sgim_acts_tries_every_pair_once_and_then_stays_with_what_has_most_views() -> None:
    for seed in range(3):
        episodes = lived(made(seed=seed), 103, declines=0.0)[3:]
        assert len({*episodes[:9]}) == 9
        counted = Counter(toy for toy, _ in episodes[9:])
        assert counted["cubes"] > 1.5 * counted["dog"]


def test_random_and_oracle_choose_as_they_say() -> None:
    counted = Counter(lived(made("random"), 303)[3:])
    assert len(counted) == 9
    assert max(counted.values()) < 60
    toys = Counter(toy for toy, _ in lived(made("oracle"), 303)[3:])
    assert toys["cubes"] / 300 == pytest.approx(2 / 3, abs=0.09)


def test_what_a_caregiver_shows_is_learned_without_a_movement_of_ones_own() -> None:
    learner = made()
    plan = learner.ask()
    assert plan.request is not None
    assert plan.request.goal is not None
    assert plan.request.goal.point == "cubes"
    shown = seen("cubes", np.random.default_rng(0))
    plan = learner.answer(plan, Demonstration(shown, "watch cubes"))
    assert plan.policy == "watch cubes"
    assert plan.watched is not None
    report = learner.tell(plan, plan.watched)
    assert report.closed
    assert learner.competence("toy", "cubes") == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("name", ["random", "sgim-acts", "oracle"])
def test_a_learner_is_made_again_from_its_recipe(name: str) -> None:
    learner = made(name, 3, "modern,label_window=4")
    again = algorithms.from_recipe(TASK, learner.recipe or {})
    assert again.describe() == learner.describe()
    assert lived(again, 40) == lived(learner, 40)


def test_a_run_that_was_stopped_goes_on_as_if_it_had_not_been(tmp_path: Path) -> None:
    whole = lived(made(), 40, tmp_path / "whole.sgim")
    begun = lived(made(), 17, tmp_path / "parts.sgim")
    went_on = lived(made(), 40, tmp_path / "parts.sgim")
    assert begun + went_on == whole
    contents = []
    for name in ("whole", "parts"):
        with Journal.open(tmp_path / f"{name}.sgim", append=False) as journal:
            contents.append(journal.columns("told", "plan", "kind", "point", "detail"))
    assert contents[0] == contents[1]


def test_constants_can_be_set() -> None:
    episodes = lived(made(configuration="modern,label_uniform=0.0,label_pick=argmax"), 60)
    assert episodes != lived(made(), 60)
    with pytest.raises(UnknownNameError, match="Did you mean 'label_uniform'"):
        made(configuration="modern,label_uniforms=0.1")


def test_an_unknown_label_is_answered_with_the_nearest() -> None:
    with pytest.raises(SpaceError, match=r"unknown label 'cube'\. Did you mean 'cubes'"):
        made().competence("toy", "cube")
    with pytest.raises(UnknownNameError, match="unknown learner 'sagg-riac'"):
        made("sagg-riac")


def test_tasks_that_are_none_of_labels_and_views_are_refused() -> None:
    only_labels = Task(POLICIES, {"toy": TOYS})
    assert algorithms.make("random", only_labels).strategy.alone.name == "random"
    with pytest.raises(SgimError, match="views as outcomes; this one has goals toy and outcomes"):
        labels.sgim_acts(only_labels)
    vectors = Task(Box(0, 1), {"view": FEATURES, "toy": TOYS}, goal_spaces={"toy": TOYS})
    with pytest.raises(SgimError, match="policies of an action and a label, such as 'push car'"):
        algorithms.make("sgim-acts", vectors)


def test_without_a_caregiver_nothing_is_presented() -> None:
    learner = algorithms.make("sgim-acts", TASK)
    assert learner.teachers == ()
    assert {mode for _, mode in lived(learner, 20)} == {"push", "lift"}
