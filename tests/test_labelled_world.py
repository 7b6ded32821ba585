"""The core carries opaque outcomes, labels as goals, and choices as policies.

Five ways to look at three toys: the outcome of a look is a picture, which only the model
understands, and the goal is to know a toy by its views. The dog looks the same from anywhere;
the cubes never look the same twice.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from sgim.errors import SgimError, SpaceError
from sgim.events import Answered, Closed, Event, Opened, Planned, Suggested, Told
from sgim.learner import Learner
from sgim.outcome.progress import CompetenceChange
from sgim.outcome.table import InterestTable
from sgim.policy.simple import Mimicry, RandomPolicies
from sgim.records import Demonstration, Goal, Plan, Trial
from sgim.runs.codec import Codec
from sgim.spaces import Choices, Space
from sgim.strategy.modes import Mode
from sgim.strategy.strategy import JointChoice
from sgim.streams import Streams
from sgim.task import Task
from sgim.testing import check_interest_map, check_model, check_space

TOYS = Choices(["dog", "car", "cubes"])
LOOKS = Choices(["front", "back", "left", "right", "above"])
STREAMS = Streams(0)


class Pictures:
    """Pictures of 2 × 3 grey levels; no level of the learner looks into them."""

    dimension = None

    def check(self, value: Any, what: str = "value") -> Any:
        picture = np.array(value)
        if picture.shape != (2, 3) or picture.dtype != np.uint8:
            raise SpaceError(f"{what} is no picture of 2 × 3 grey levels: {value!r:.60}")
        return picture

    def contains(self, point: Any) -> bool:
        return True

    def sample(self, rng: np.random.Generator) -> Any:
        return rng.integers(256, size=(2, 3), dtype=np.uint8)

    def encode(self, point: Any) -> Any:
        raise TypeError("a picture cannot be encoded")

    def pack(self, point: Any) -> bytes:
        return bytes(point.tobytes())

    def unpack(self, data: bytes) -> Any:
        return np.frombuffer(data, dtype=np.uint8).reshape(2, 3)

    def describe(self) -> dict[str, Any]:
        return {"space": "pictures", "shape": [2, 3]}


TASK = Task(LOOKS, {"picture": Pictures()}, goal_spaces={"toy": TOYS})


def look(toy: str, way: str, rng: np.random.Generator) -> Mapping[str, Any]:
    """A picture: the toy, the side it is seen from, and how it lies."""
    sides, poses = {"dog": (1, 1), "car": (2, 1), "cubes": (5, 40)}[toy]
    side, pose = LOOKS.labels.index(way) % sides, int(rng.integers(poses))
    picture = np.array([[TOYS.labels.index(toy), side, pose], [0, 0, 0]], dtype=np.uint8)
    return {"picture": picture}


@dataclass
class Views:
    """Competence for a toy grows with the number of its different views, up to 60."""

    seen: dict[str, set[bytes]] = field(default_factory=lambda: {toy: set() for toy in TOYS.labels})

    def update(self, trial: Trial) -> None:
        picture = trial.outcome.get("picture")
        if picture is not None:
            self.seen[TOYS.labels[picture[0, 0] % 3]].add(picture.tobytes())

    def competence(self, goal: Goal, context: Any) -> float:
        return min(1.0, len(self.seen[goal.point]) / 60)

    def shown_by(self, trial: Trial, goal: Goal, context: Any) -> None:
        return None


def make_learner(seed: int = 0) -> Learner:
    alone = Mode("look around", RandomPolicies(LOOKS), 1)
    helped = Mode("ask", Mimicry(LOOKS, 0.0), 1, cost=1.5, teacher="caregiver")
    modes = {mode.name: mode.cost for mode in (alone, helped)}
    table = InterestTable("toy", TOYS, modes, CompetenceChange(window=8), uniform=0.2)
    return Learner(TASK, JointChoice([alone, helped], table, alone), Views(), seed=seed)


def caregiver(goal: Goal | None, rng: np.random.Generator) -> Demonstration | None:
    """Shows a toy from a side of her choice; sometimes she has no time."""
    if goal is None or rng.random() < 0.1:
        return None
    way = LOOKS.sample(rng)
    return Demonstration(look(goal.point, way, rng), way)


def live(learner: Learner, movements: int) -> list[Plan]:
    """Carry out the learner's plans; returns those that were told."""
    told = []
    while learner.movements < movements:
        plan = learner.ask()
        if plan.request is not None:
            rng = STREAMS("teacher", plan.request.index)
            plan = learner.answer(plan, caregiver(plan.request.goal, rng))
        assert plan.goal is not None
        learner.tell(plan, look(plan.goal.point, plan.policy, STREAMS("world", plan.id)))
        told.append(plan)
    return told


def test_the_parts_of_this_world_keep_their_promises() -> None:
    check_space(TASK.outcome_spaces["picture"])
    check_model(Views, TASK)
    modes = {"look around": 1.0, "ask": 1.5}
    check_interest_map(
        lambda: InterestTable("toy", TOYS, modes, CompetenceChange()), {"toy": TOYS}, list(modes)
    )


@pytest.mark.parametrize("seed", range(5))
def test_most_time_goes_to_the_toy_that_still_has_something_to_learn(seed: int) -> None:
    plans = live(make_learner(seed), 200)
    counted = Counter(plan.goal.point for plan in plans if plan.goal is not None)
    assert sum(counted.values()) == 200
    assert counted["cubes"] > 1.3 * max(counted["dog"], counted["car"])
    assert min(counted.values()) > 10


def test_plans_are_looks_and_both_modes_are_used() -> None:
    plans = live(make_learner(), 200)
    assert {plan.policy for plan in plans} == set(LOOKS.labels)
    assert {plan.mode for plan in plans} == {"look around", "ask"}


def test_competence_is_asked_by_label() -> None:
    learner = make_learner()
    assert learner.competence("toy", "cubes") == 0.0
    live(learner, 200)
    assert learner.competence("toy", "dog") == pytest.approx(1 / 60)
    assert learner.competence("toy", "car") == pytest.approx(2 / 60)
    assert learner.competence("toy", "cubes") > 0.5
    with pytest.raises(SpaceError, match=r"unknown label 'cube'\. Did you mean 'cubes'"):
        learner.competence("toy", "cube")


def test_progress_is_measured_by_the_model_as_trials_show_none_themselves() -> None:
    learner, told = make_learner(), []
    learner.suggest("toy", "dog")
    learner.suggest("toy", "dog")
    for _ in range(2):
        plan = learner.ask()
        if plan.request is not None:
            plan = learner.answer(plan, None)
        told.append(learner.tell(plan, look("dog", plan.policy, STREAMS("world"))))
    assert [report.progress for report in told] == pytest.approx([1 / 60, 0.0])
    assert [report.cost for report in told] == [None, None]
    assert all(report.closed for report in told)


def test_a_model_without_policies_says_so() -> None:
    with pytest.raises(SgimError, match="Views does not answer with policies"):
        make_learner().best_policy("toy", "dog")


def test_a_malformed_picture_is_refused_and_its_plan_is_still_out() -> None:
    learner = make_learner()
    plan = learner.ask()
    if plan.request is not None:
        plan = learner.answer(plan, None)
    with pytest.raises(SpaceError, match="outcome 'picture' is no picture"):
        learner.tell(plan, {"picture": [[1, 2], [3, 4]]})
    assert learner.pending == [plan]
    learner.tell(plan, {})
    assert learner.pending == []


def test_every_event_comes_back_from_its_rows() -> None:
    learner, recorded = make_learner(), list[Event]()
    learner.record = recorded.append
    learner.suggest("toy", "car")
    live(learner, 60)
    assert {type(event) for event in recorded} == {
        Opened, Planned, Answered, Told, Closed, Suggested
    }  # fmt: skip
    codec = Codec(TASK)
    rows = [row for event in recorded for row in codec.encode(event)]
    decoded = [event for _, event in codec.decode((i, *row) for i, row in enumerate(rows))]
    assert len(decoded) == len(recorded)
    for event, again in zip(recorded, decoded, strict=True):
        if isinstance(event, Planned):
            plan = event.plan
            request = plan.request and (plan.request.teacher, plan.request.index)
            assert (again.id, again.episode, again.policy) == (plan.id, plan.episode, plan.policy)
            assert (again.teacher, again.request) == (request or (None, None))
        else:
            assert type(again) is type(event)
            assert codec.encode(again) == codec.encode(event)


def test_a_learner_that_is_told_the_same_again_decides_the_same_again() -> None:
    first, again = (live(make_learner(3), 100) for _ in range(2))
    assert [(p.id, p.mode, p.policy) for p in first] == [(p.id, p.mode, p.policy) for p in again]
    other = live(make_learner(4), 100)
    assert [p.policy for p in first] != [p.policy for p in other]


def test_pictures_satisfy_the_protocol_of_spaces() -> None:
    assert isinstance(Pictures(), Space)
