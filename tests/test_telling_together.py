"""Telling a learner of a whole batch is telling it of each plan in turn."""

from __future__ import annotations

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import ThrowingArm
from sgim.environments.arm import PlanarArm
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import PlanError, SpaceError
from sgim.events import Event
from sgim.learner import Learner
from sgim.records import Plan
from sgim.runs.codec import Codec

WORLD = ThrowingArm()


def recorded(learner: Learner) -> list[Event]:
    events: list[Event] = []
    learner.record = events.append
    return events


def to_carry_out(learner: Learner, n: int) -> list[Plan]:
    """A batch of plans that hold policies, the requests answered by the real teachers."""
    learner.ask_batch(n)
    for plan in learner.pending:
        if plan.request is not None:
            teacher = throwing_teachers()[plan.request.teacher]
            rng = np.random.default_rng(plan.request.index)
            learner.answer(plan, teacher.demonstrate(plan.request.goal, rng))
    return learner.pending


def test_requests_answered_at_once_are_each_answered_in_turn() -> None:
    one, other = (
        algorithms.make("sgim-acts", WORLD.task, ["T1", "T2", "T3"], seed=5) for _ in range(2)
    )
    events = recorded(one), recorded(other)
    answered = 0
    for _ in range(8):
        batches = one.ask_batch(20), other.ask_batch(20)
        requests, same = ([p for p in batch if p.request is not None] for batch in batches)
        shown = [
            None
            if plan.request is None or plan.request.index % 4 == 0
            else throwing_teachers()[plan.request.teacher].demonstrate(
                plan.request.goal, np.random.default_rng(plan.request.index)
            )
            for plan in requests
        ]
        following = other.answer_batch(same, shown)
        for plan, demonstration, expected in zip(requests, shown, following, strict=True):
            assert one.answer(plan, demonstration).id == expected.id
        answered += len(requests)
        for learner in (one, other):
            plans = learner.pending
            learner.tell_batch(plans, WORLD.execute_batch([plan.policy for plan in plans]))
    assert answered > 20
    codec = Codec(WORLD.task)
    rows = [[row for event in some for row in codec.encode(event)] for some in events]
    assert rows[0] == rows[1]


@pytest.mark.parametrize("configuration", ["modern", "thesis"])
@pytest.mark.parametrize("name", ["sgim-acts", "random-goal-babbling", "random", "round-robin"])
def test_a_batch_told_at_once_is_each_plan_told_in_turn(name: str, configuration: str) -> None:
    teachers = ["T1", "T2", "T3"] if name in ("sgim-acts", "round-robin") else []
    one, other = (
        algorithms.make(name, WORLD.task, teachers, configuration=configuration, seed=5)
        for _ in range(2)
    )
    events = recorded(one), recorded(other)
    for size in (3, 20, 1, 40, 40):
        plans, same = to_carry_out(one, size), to_carry_out(other, size)
        outcomes = WORLD.execute_batch([plan.policy for plan in plans])
        outcomes[0] = {}
        reports = other.tell_batch(same, outcomes)
        for plan, outcome, report in zip(plans, outcomes, reports, strict=True):
            expected = one.tell(plan, outcome)
            assert (report.cost, report.competence) == (expected.cost, expected.competence)
            assert (report.closed, report.progress) == (expected.closed, expected.progress)
    codec = Codec(WORLD.task)
    rows = [[row for event in some for row in codec.encode(event)] for some in events]
    assert rows[0] == rows[1]


def test_contexts_and_several_kinds_are_told_at_once_alike() -> None:
    arm = PlanarArm(3, vary_start=True)
    one, other = (algorithms.make("sagg-riac", arm.task, seed=2) for _ in range(2))
    events = recorded(one), recorded(other)
    rng = np.random.default_rng(0)
    for _ in range(6):
        contexts = [arm.sample_context(rng) for _ in range(9)]
        plans, same = one.ask_batch(9, contexts), other.ask_batch(9, contexts)
        outcomes = arm.execute_batch(
            [plan.policy for plan in plans],
            [plan.context for plan in plans],
            [np.random.default_rng(plan.id) for plan in plans],
        )
        other.tell_batch(same, outcomes)
        for plan, outcome in zip(plans, outcomes, strict=True):
            one.tell(plan, outcome)
    codec = Codec(arm.task)
    rows = [[row for event in some for row in codec.encode(event)] for some in events]
    assert rows[0] == rows[1]


def test_a_malformed_outcome_in_a_batch_is_refused_and_all_its_plans_stay_out() -> None:
    learner = algorithms.make("sagg-riac", WORLD.task, seed=1)
    plans = learner.ask_batch(3)
    with pytest.raises(SpaceError, match="outcome 'throw' has nan"):
        learner.tell_batch(plans, [{"throw": [1, 2]}, {"throw": [np.nan, 0]}, {}])
    assert learner.pending == plans
    assert learner.movements == 0


def test_a_batch_that_is_not_one_outcome_for_each_plan_is_refused() -> None:
    learner = algorithms.make("sagg-riac", WORLD.task, seed=1)
    plans = learner.ask_batch(2)
    with pytest.raises(ValueError, match="2 plans came with 1 answers or outcomes"):
        learner.tell_batch(plans, [{}])
    with pytest.raises(PlanError, match="a plan comes twice"):
        learner.tell_batch([plans[0], plans[0]], [{}, {}])
    learner.tell_batch(plans, [{}, {}], seconds=[1.0, 2.0])
    with pytest.raises(PlanError, match="was already told"):
        learner.tell_batch(plans, [{}, {}])
