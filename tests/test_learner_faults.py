"""A learner whose parts, journal or drivers misbehave stays usable and loses nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.errors import PlanError, SpaceError, UnwrittenError
from sgim.events import Closed, Event, Planned
from sgim.learner import Learner
from sgim.memory import Memory
from sgim.outcome import UniformGoals
from sgim.policy import NearestModel, RandomPolicies
from sgim.records import Demonstration, Trial
from sgim.spaces import Box
from sgim.strategy import JointChoice, Mode
from sgim.task import Task
from tests.test_learner import SHOWN, WORLD, asked, make, move


class Breaking(RandomPolicies):
    """An explorer that raises when told to."""

    breaks = ""

    def begin(self, episode: Any) -> None:
        if self.breaks == "begin":
            raise OSError("broken")

    def propose(self, episodes: Any) -> list[Any]:
        if self.breaks == "propose":
            raise OSError("broken")
        if self.breaks == "nan":
            return [np.full(14, np.nan) for _ in episodes]
        return super().propose(episodes)

    def learn(self, episode: Any, trial: Any, competence: Any) -> None:
        if self.breaks == "learn":
            raise OSError("broken")


def breaking(budget: int = 3) -> tuple[Learner, Breaking]:
    explorer = Breaking(WORLD.task.policy_space)
    mode = Mode("autonomous", explorer, budget)
    model = NearestModel(Memory(WORLD.task))
    strategy = JointChoice([mode], UniformGoals(WORLD.task.goal_spaces), mode)
    return Learner(WORLD.task, strategy, model), explorer


@pytest.mark.parametrize("breaks", ["begin", "propose", "nan"])
@pytest.mark.parametrize("batch", [2, 5])
def test_what_an_explorer_breaks_in_deciding_is_as_if_not_decided(breaks: str, batch: int) -> None:
    learner, explorer = breaking()
    events: list[Event] = []
    learner.record = events.append
    move(learner)
    learner.suggest("throw", [3.0, 2.0])
    before = len(events)
    explorer.breaks = breaks
    for _ in range(2):
        with pytest.raises((OSError, SpaceError)):
            learner.ask_batch(batch)
        with pytest.raises((OSError, SpaceError)):
            learner.ask() if breaks != "begin" else learner.ask_batch(batch)
    assert len(events) == before
    assert learner.pending == []
    explorer.breaks = ""
    plans = learner.ask_batch(3)
    assert [p.episode for p in plans] == [0, 1, 2]
    assert plans[1].goal.point.tolist() == [3.0, 2.0]  # type: ignore[union-attr]


def test_an_explorer_that_breaks_in_learning_loses_no_episode() -> None:
    learner, explorer = breaking()
    plan = learner.ask()
    explorer.breaks = "learn"
    with pytest.raises(OSError, match="broken"):
        learner.tell(plan, {})
    assert learner.movements == 1
    assert learner.ask().episode == plan.episode


def test_an_event_that_the_journal_could_not_write_yet_has_happened_all_the_same() -> None:
    learner = make("sgim-acts", seed=3)
    events: list[Event] = []
    full = False

    def record(event: Event) -> None:
        events.append(event)  # the journal keeps what it could not write
        if full:
            raise UnwrittenError("the disk is full")

    learner.record = record
    plan = asked(learner)
    full = True
    with pytest.raises(UnwrittenError):
        learner.answer(plan, SHOWN)
    (following,) = learner.pending
    with pytest.raises(UnwrittenError):
        learner.tell(following, {})
    with pytest.raises(UnwrittenError):
        learner.suggest("throw", [1.0, 1.0])
    with pytest.raises(UnwrittenError):
        learner.ask()
    full = False
    assert len(learner.pending) == 1
    with pytest.raises(PlanError, match="was already told"):
        learner.tell(following, {})
    planned = [e.plan.id for e in events if isinstance(e, Planned)]
    assert planned == list(range(len(planned)))


def test_a_policy_given_out_cannot_be_changed() -> None:
    plan = make().ask()
    with pytest.raises(ValueError, match="read-only"):
        plan.policy *= 2


def test_what_lies_outside_the_box_is_no_goal() -> None:
    learner = make("emulation")
    plan = learner.ask()
    following = learner.answer(plan, Demonstration({"throw": [50.0, 2.0]}))
    assert following.goal is plan.goal
    with pytest.raises(SpaceError, match="outside the bounds"):
        learner.suggest("throw", [50.0, 2.0])


def test_progress_is_not_the_luck_of_the_context() -> None:
    task = Task(Box(0, 1), {"p": Box(0, 1)}, context_space=Box(0, 1))
    learner = algorithms.sagg_riac(task)
    closed: list[Closed] = []
    learner.record = lambda e: closed.append(e) if isinstance(e, Closed) else None
    learner.observe(Trial(0.5, {"p": 0.5}, 0.0))  # in context 0 the goal is known
    learner.suggest("p", 0.5)
    learner.tell(learner.ask(1.0), {})  # in context 1 it is not, and nothing is reached
    while not closed:
        learner.tell(learner.ask(0.0), {"p": 0.5})
    assert closed[0].before == closed[0].after
