"""A task with every sort of space, one event of every type, and equality to the last bit."""

import dataclasses
import struct
from collections.abc import Mapping

import numpy as np
import pytest

from sgim import events as e
from sgim.records import Demonstration, Goal, Plan, Request, Trajectory, Trial
from sgim.runs.rows import RecordedPlan
from sgim.spaces import Box, Choices
from sgim.task import Task


def _same(one, other) -> bool:
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return (
            one.dtype == other.dtype
            and one.shape == other.shape
            and one.tobytes() == other.tobytes()
        )
    if isinstance(one, float):
        return struct.pack("d", one) == struct.pack("d", other)
    if isinstance(one, Mapping):
        return list(one) == list(other) and all(_same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, Trajectory) or dataclasses.is_dataclass(one):
        names = type(one).__slots__
        return all(_same(getattr(one, name), getattr(other, name)) for name in names)
    return one == other


@pytest.fixture(scope="session")
def same():
    """Whether a decoded event is the one encoded, bit for bit; a plan as its `RecordedPlan`."""

    def compare(event, decoded) -> bool:
        if isinstance(event, e.Planned):
            plan = event.plan
            teacher = index = None
            if plan.request is not None:
                teacher, index = plan.request.teacher, plan.request.index
            event = RecordedPlan(plan.id, plan.episode, plan.policy, teacher, index, plan.context)
        return _same(event, decoded)

    return compare


@pytest.fixture(scope="session")
def task() -> Task:
    return Task(
        Box(-1, 1, names=["a", "b", "c"]),
        {"throw": Box([0, 0], [1, 1], unit="m"), "word": Choices(["ba", "da", "ä"])},
        goal_spaces={"throw": Box([0, 0], [1, 1], unit="m"), "sort": Choices(["near", "far"])},
        context_space=Box(0, 5, names=["wind"]),
    )


@pytest.fixture(scope="session")
def every_event() -> list[e.Event]:
    policy = np.array([0.1, -0.0, 1e-310])
    context = np.array([2.5])
    goal = Goal("throw", np.array([0.3, 0.7]))
    both = {"throw": np.array([1e308, -5e-324]), "word": "ä"}
    shown = Trajectory([0.0, 0.1], [[0.1, 1 / 3], [-0.0, 2.0]], ["hip", "knee"], "deg")
    asked = Request("expert", goal, 4)
    return [
        e.Session({"sgim": "0.1", "adopted": False, "time": 1.5, "cores": [1, None]}),
        e.Opened(0, "autonomous", goal, context, "strategy"),
        e.Opened(1, "random", None, None, "suggestion"),
        e.Opened(2, "mimic", Goal("sort", "far"), None, "demonstration"),
        e.Planned(Plan(0, 0, "autonomous", goal, policy, None, context)),
        e.Planned(Plan(1, 2, "mimic", goal, None, asked, None)),
        e.Told(0, both, 31.25),
        e.Told(0, {"word": "ba"}),
        e.Told(0, {}, 0.0),
        e.Answered(1, None, 2.0),
        e.Answered(1, Demonstration(both, policy, shown, "expert", context), 12.5),
        e.Answered(1, Demonstration({"word": "da"})),
        e.Ended(3, "refused", "joint 'elbow' > 2 rad\n"),
        e.Observed(Trial(policy, both, context)),
        e.Observed(Trial(policy, {})),
        e.Demonstrated(Demonstration({"throw": policy[:2].copy()}, policy, None, "", None)),
        e.Suggested(goal),
        e.Available("expert", True),
        e.Available("expert", False),
        e.Closed(0, "autonomous", goal, -0.1, -0.0, 20),
        e.Closed(1, "random", None, None, None, 1),
        e.Evaluated(1000, {"throw": 0.1, "total": 1 / 3}),
    ]
