"""What learners do with the demonstrations of one teacher: SGIM-D, SGIM-IM, and the controls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import AirHockey, ThrowingArm
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.errors import SgimError, TeacherError
from sgim.events import Closed, Event, Opened
from sgim.learner import Learner
from sgim.records import Demonstration
from sgim.runs import Run

TABLE = AirHockey()
IMITATING = ["observation", "imitation", "sgim-d", "sgim-im"]


def run(name: str, movements: int, **options: Any) -> tuple[Learner, list[Event]]:
    """A run on the hockey table, and what happened."""
    learner = algorithms.make(name, TABLE.task, "expert", **options)
    events: list[Event] = []
    learner.record = events.append
    Run(learner, TABLE, hockey_teachers()).go(movements)
    return learner, events


def shares(events: list[Event]) -> dict[str, int]:
    counts: dict[str, int] = {}
    for event in events:
        if isinstance(event, Closed):
            counts[event.mode] = counts.get(event.mode, 0) + event.movements
    return counts


@pytest.mark.parametrize("configuration", ["modern", "thesis"])
@pytest.mark.parametrize("every", [10, 45])
def test_sgim_d_imitates_every_m_movements(configuration: str, every: int) -> None:
    spec = f"{configuration},demonstration_every={every},mimicry_movements=4"
    _, events = run("sgim-d", 900, configuration=spec)
    made, asked = 0, []
    for event in events:
        if isinstance(event, Opened) and event.mode == "imitate expert":
            asked.append(made)
        elif isinstance(event, Closed):
            made += event.movements
    assert asked == list(range(0, made, every))[: len(asked)]
    assert len(asked) >= 900 // every


@pytest.mark.parametrize("name", IMITATING)
def test_the_teacher_chooses_what_to_show_and_that_is_pursued(name: str) -> None:
    learner = algorithms.make(name, TABLE.task, "expert")
    shown = hockey_teachers()["expert"].demonstrate(None, np.random.default_rng(0))
    while (plan := learner.ask()).request is None:
        learner.tell(plan, {})
    assert plan.request.goal is None
    following = learner.answer(plan, shown)
    assert following.goal is not None
    assert following.goal.point == shown.outcome["hit"]
    assert (following.policy == shown.policy).all()
    closed: list[Event] = []
    learner.record = closed.append
    learner.tell(following, shown.outcome)
    (end,) = (e for e in closed if isinstance(e, Closed)) if name != "imitation" else ([None],)
    if isinstance(end, Closed):
        assert (end.before, end.after) == (-1.0, -0.0)


def test_imitation_repeats_what_was_shown_until_the_next_demonstration() -> None:
    learner, events = run("imitation", 90, configuration="modern,demonstration_every=30")
    assert shares(events) == {"imitate expert": 90}
    assert learner.ledger.next_request == 3
    _, events = run("imitation", 90, configuration="modern,demonstration_every=9")
    assert sum(isinstance(e, Opened) for e in events) == 10


class Untouchable(AirHockey):
    """A table on which nobody may play."""

    def execute(self, policy: Any, context: Any, rng: Any) -> Any:
        raise AssertionError("an observer makes no movement")

    execute_batch = None  # type: ignore[assignment]


@pytest.mark.parametrize("batch", [1, 8])
def test_observation_remembers_what_was_shown_without_a_movement(batch: int) -> None:
    table, teachers = Untouchable(), hockey_teachers()
    learner = algorithms.make("observation", table.task, "expert")
    Run(learner, table, teachers, batch=batch).go(40)
    assert learner.movements == 40
    assert learner.ledger.next_request == 40
    for plan in (learner.ask() for _ in range(3)):
        assert plan.request is not None
        rng = np.random.default_rng(plan.id)
        shown = teachers["expert"].demonstrate(None, rng)
        following = learner.answer(plan, shown)
        assert following.watched is not None
        assert following.watched["hit"] == shown.outcome["hit"]
        learner.tell(following, following.watched)
        known = learner.best_policy("hit", shown.outcome["hit"])
        assert (known == shown.policy).all()


@pytest.mark.parametrize("name", IMITATING)
@pytest.mark.parametrize("answered", [None, "beyond"])
def test_without_a_goal_from_the_teacher_the_learner_pursues_its_own(
    name: str, answered: str | None
) -> None:
    learner = algorithms.make(name, TABLE.task, "expert")
    events: list[Event] = []
    learner.record = events.append
    while (plan := learner.ask()).request is None:
        learner.tell(plan, {})
    beyond = Demonstration({"hit": [1.5]}, TABLE.task.policy_space.sample(np.random.default_rng(0)))
    following = learner.answer(plan, beyond if answered else None)
    assert following.goal is not None
    assert TABLE.task.goal_spaces["hit"].contains(following.goal.point)
    assert (following.mode == "autonomous") == (answered is None)
    while learner.ledger.running:
        learner.tell(following, {})
        following = learner.ask()
        if following.episode != plan.episode:
            break
    ends = [e for e in events if isinstance(e, Closed) and e.episode == plan.episode]
    assert ends[0].pursued is not None


@pytest.mark.parametrize("name", IMITATING)
def test_what_cannot_be_repeated_is_refused(name: str) -> None:
    learner = algorithms.make(name, TABLE.task, "expert")
    while (plan := learner.ask()).request is None:
        learner.tell(plan, {})
    with pytest.raises(TeacherError, match="needs a demonstration with a policy"):
        learner.answer(plan, Demonstration({"hit": [0.5]}))
    assert learner.pending == [plan]


@pytest.mark.parametrize("name", IMITATING)
def test_they_have_one_teacher(name: str) -> None:
    with pytest.raises(SgimError, match=f"{name} has exactly one teacher, but 2 are given"):
        algorithms.make(name, ThrowingArm().task, ["T1", "T2"])


@pytest.mark.parametrize("name", ["sgim-d", "imitation", "observation"])
def test_a_batch_asks_as_often_as_single_movements(name: str) -> None:
    asked = []
    for batch in (1, 16):
        learner = algorithms.make(
            name, TABLE.task, "expert", configuration="thesis,demonstration_every=40"
        )
        Run(learner, TABLE, hockey_teachers(), batch=batch).go(800)
        asked.append(learner.ledger.next_request)
    assert asked[1] == pytest.approx(asked[0], abs=16)
