"""What a learner promises to whoever drives it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import ThrowingArm
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import (
    PlanError,
    SgimError,
    SpaceError,
    TeacherError,
    UnknownNameError,
)
from sgim.events import Closed, Event, Opened, Planned, Told
from sgim.learner import Learner
from sgim.policy import NoAnswerError
from sgim.records import Demonstration, Plan, Trial

WORLD = ThrowingArm()
NAMES = ["T1", "T2", "T3"]
SHOWN = Demonstration({"throw": [5.0, 2.0]}, np.full(14, 0.5))


def make(name: str = "sagg-riac", **options: Any) -> Learner:
    teachers = NAMES if name == "sgim-acts" else ["T1"]
    return algorithms.make(name, WORLD.task, teachers, **options)


def move(learner: Learner, plan: Plan | None = None) -> None:
    """One movement, with the real world and the real teachers."""
    plan = learner.ask() if plan is None else plan
    if plan.request is not None:
        teacher = throwing_teachers()[plan.request.teacher]
        rng = np.random.default_rng(plan.request.index)
        plan = learner.answer(plan, teacher.demonstrate(plan.request.goal, rng))
    learner.tell(plan, WORLD.execute(plan.policy, None, None))


def asked(learner: Learner) -> Plan:
    """A plan that holds a request."""
    while (plan := learner.ask()).request is None:
        move(learner, plan)
    return plan


@pytest.mark.parametrize("configuration", ["modern", "thesis"])
def test_the_plans_of_a_batch_are_those_of_as_many_asks(configuration: str) -> None:
    one, other = (make(configuration=configuration, seed=4) for _ in range(2))
    for _ in range(12):
        singles = [one.ask() for _ in range(7)]
        batch = other.ask_batch(7)
        for a, b in zip(singles, batch, strict=True):
            assert (a.id, a.episode, a.mode) == (b.id, b.episode, b.mode)
            assert (a.policy == b.policy).all()
            one.tell(a, WORLD.execute(a.policy, None, None))
            other.tell(b, WORLD.execute(b.policy, None, None))


def test_answers_may_come_in_any_order() -> None:
    learner = make("sgim-acts", seed=1)
    rng = np.random.default_rng(0)
    for _ in range(30):
        learner.ask_batch(int(rng.integers(1, 9)))
        for i in rng.permutation(len(learner.pending)):
            move(learner, sorted(learner.pending, key=lambda p: p.id)[i % len(learner.pending)])
    assert len(learner.model.memory) == learner.movements  # type: ignore[attr-defined]


def test_open_episodes_come_before_new_ones_and_the_oldest_first() -> None:
    learner = make(seed=2)
    plans = learner.ask_batch(6)
    episodes = [p.episode for p in plans]
    for plan in reversed(plans):
        learner.fail(plan, "the power went")
    assert [p.episode for p in learner.ask_batch(6)] == episodes


def test_progress_of_an_episode_counts_its_own_trials_only() -> None:
    learner = make(seed=3)
    closed: list[Closed] = []
    learner.record = lambda e: closed.append(e) if isinstance(e, Closed) else None
    first, second = learner.ask_batch(2)
    assert first.goal is not None
    learner.tell(second, {first.goal.kind: first.goal.point})  # hits the other episode's goal
    while not any(c.episode == first.episode for c in closed):
        plan = next(p for p in [*learner.pending, learner.ask()] if p.episode == first.episode)
        learner.tell(plan, {})
    (ended,) = [c for c in closed if c.episode == first.episode]
    assert (ended.before, ended.after) == (-1.0, -1.0)


@pytest.mark.parametrize(
    ("outcome", "message"),
    [
        ({"throw": [1.0, np.nan]}, "outcome 'throw' has nan at 'height'"),
        ({"throw": [1.0, np.inf]}, "outcome 'throw' has inf at 'height'"),
        ({"throw": [1.0, 2.0, 3.0]}, r"shape \(3,\), expected \(2,\): \(distance m, height m\)"),
        ({"thro": [1.0, 2.0]}, "unknown outcome kind 'thro'. Did you mean 'throw'"),
        ([1.0, 2.0], "outcome is a list, expected a mapping"),
        ({"place": "far"}, "outcome 'place' is str 'far'"),
    ],
)
def test_a_malformed_outcome_is_refused_and_its_plan_stays_out(outcome: Any, message: str) -> None:
    learner = make()
    plan = learner.ask()
    with pytest.raises(SgimError, match=message):
        learner.tell(plan, outcome)
    assert learner.pending == [plan]
    assert learner.movements == 0
    learner.tell(plan, {"throw": [1.0, 2.0]})
    assert learner.movements == 1


def test_a_plan_is_told_once() -> None:
    learner = make()
    plan = learner.ask()
    learner.tell(plan, {})
    with pytest.raises(PlanError, match="plan 0 was already told"):
        learner.tell(plan, {})


@pytest.mark.parametrize(
    ("end", "said"),
    [
        ("expire", "has expired"),
        ("fail", "has failed"),
        ("refuse", "was refused"),
        ("lose", "was given up as lost"),
    ],
)
def test_a_plan_that_ended_cannot_be_told(end: str, said: str) -> None:
    learner = make()
    plan = learner.ask()
    getattr(learner, end)(plan, "because")
    with pytest.raises(PlanError, match=f"plan 0 {said}"):
        learner.tell(plan, {})
    assert learner.movements == (end == "fail")
    move(learner)


def test_a_plan_of_another_learner_is_refused() -> None:
    one, other = make(), make()
    plan = one.ask()
    other.ask()
    with pytest.raises(PlanError, match="plan 0 is of another learner"):
        other.tell(plan, {})
    with pytest.raises(PlanError, match="expected a Plan that this learner gave, got int"):
        other.tell(0, {})  # type: ignore[arg-type]


def test_a_request_is_answered_and_a_policy_is_told() -> None:
    learner = make("mimicry")
    plan = learner.ask()
    with pytest.raises(PlanError, match=r"request to 'T1': use answer\(plan"):
        learner.tell(plan, {})
    following = learner.answer(plan, SHOWN)
    with pytest.raises(PlanError, match="holds a policy, not a request"):
        learner.answer(following, SHOWN)
    with pytest.raises(PlanError, match="was already answered"):
        learner.answer(plan, SHOWN)


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (Demonstration({"thro": [1.0, 2.0]}, np.zeros(14)), "Did you mean 'throw'"),
        (Demonstration({"throw": [1.0]}, np.zeros(14)), r"shape \(1,\)"),
        (Demonstration({}, np.zeros(14)), "without an outcome"),
        (Demonstration({"throw": [1.0, 2.0]}, np.zeros(13)), "demonstrated policy has shape"),
        (Demonstration({"throw": [1.0, 2.0]}, np.full(14, np.nan)), "demonstrated policy has nan"),
        (Demonstration({"throw": [1.0, 2.0]}), "needs a demonstration with a policy"),
        ("like this", "answered with a str, expected a Demonstration"),
    ],
)
def test_an_unusable_demonstration_is_refused_and_the_request_stays_out(
    answer: Any, message: str
) -> None:
    learner = make("mimicry")
    plan = learner.ask()
    with pytest.raises(TeacherError, match=message):
        learner.answer(plan, answer)
    assert learner.pending == [plan]
    assert learner.answer(plan, SHOWN).policy is not None


def test_a_demonstrated_policy_beyond_the_bounds_is_clipped_to_them() -> None:
    learner = make("mimicry")
    plan = learner.answer(learner.ask(), Demonstration({"throw": [5.0, 2.0]}, np.full(14, 99.0)))
    assert (plan.policy == WORLD.task.policy_space.high).all()  # type: ignore[attr-defined]


@pytest.mark.parametrize("how", ["declined", "expired", "failed"])
def test_an_unanswered_request_leaves_the_learner_to_explore_alone(how: str) -> None:
    learner = make("sgim-acts", seed=5)
    request = asked(learner)
    if how == "declined":
        plan = learner.answer(request, None)
    else:
        (learner.expire if how == "expired" else learner.fail)(request, "nobody there")
        plan = learner.ask()
    assert plan.episode == request.episode
    assert (plan.mode, plan.request) == ("autonomous", None)
    assert plan.goal is request.goal


def test_a_teacher_who_is_away_is_not_asked() -> None:
    learner = make("sgim-acts", seed=6)
    for name in NAMES:
        learner.set_available(name, False)
    for _ in range(60):
        plan = learner.ask()
        assert plan.request is None
        move(learner, plan)
    learner.set_available("T2", True)
    assert asked(learner).request.teacher == "T2"  # type: ignore[union-attr]
    with pytest.raises(UnknownNameError, match="Did you mean 'T1'"):
        learner.set_available("T11", True)


def test_a_suggested_goal_is_taken_up_next() -> None:
    learner = make(seed=7)
    learner.suggest("throw", [3.0, 2.0])
    plan = learner.ask()
    assert plan.goal is not None
    assert (plan.goal.kind, plan.goal.point.tolist()) == ("throw", [3.0, 2.0])
    with pytest.raises(SpaceError, match="goal 'throw' has shape"):
        learner.suggest("throw", [3.0])


def test_an_unasked_demonstration_is_taken_up_next() -> None:
    learner = make("sgim-acts", seed=8)
    learner.demonstrate(Demonstration(SHOWN.outcome, SHOWN.policy, teacher="T2"))
    plan = learner.ask()
    assert plan.mode == "mimic T2"
    assert (plan.policy == SHOWN.policy).all()  # the first repetition is exact
    learner.demonstrate(Demonstration(SHOWN.outcome, teacher="a stranger"))
    plan = learner.ask_batch(2)[0]
    assert (plan.mode, plan.goal.kind) == ("autonomous", "throw")  # type: ignore[union-attr]


def test_what_others_tried_is_observed_without_a_movement() -> None:
    learner = make()
    with pytest.raises(NoAnswerError, match="no trial has produced"):
        learner.best_policy("throw", [5.0, 2.0])
    learner.observe(Trial(np.full(14, 0.5), {"throw": [5.0, 2.0]}))
    assert (learner.best_policy("throw", [5.1, 2.0]) == 0.5).all()
    assert learner.competence("throw", [5.0, 2.0]) == 0.0
    assert learner.movements == 0
    with pytest.raises(SpaceError, match="outside the bounds"):
        learner.observe(Trial(np.full(14, 9.0), {}))


def test_every_event_is_recorded_in_the_order_of_deciding_and_being_told() -> None:
    learner = make("sgim-acts", seed=9)
    events: list[Event] = []
    learner.record = events.append
    for _ in range(50):
        move(learner)
    planned = [e.plan.id for e in events if isinstance(e, Planned)]
    assert planned == list(range(len(planned)))
    out: set[int] = set()
    opened: set[int] = set()
    for event in events:
        match event:
            case Opened():
                opened.add(event.episode)
            case Planned():
                assert event.plan.episode in opened
                out.add(event.plan.id)
            case Told():
                assert event.plan in out


def test_the_same_seed_makes_the_same_learner_and_another_seed_another() -> None:
    def policies(seed: int) -> list[list[float]]:
        learner = make("sgim-acts", seed=seed)
        found = []
        for _ in range(40):
            plan = learner.ask()
            found.append([] if plan.policy is None else plan.policy.tolist())
            move(learner, plan)
        return found

    assert policies(1) == policies(1)
    assert policies(1) != policies(2)
