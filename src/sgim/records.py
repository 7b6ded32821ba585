"""The words of the domain: immutable records that the parts pass to each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Any

import numpy as np

from sgim.errors import SpaceError
from sgim.frozen import frozen
from sgim.spaces import FloatArray

Outcome = Mapping[str, Any]
"""What a trial produced: kind → point; a kind is absent when it was not produced."""


@frozen
class Goal:
    """Something to aim at.

    Attributes:
        kind: The kind of goal, a key of `Task.goal_spaces`.
        point: A point of that kind's goal space: a vector, a label, …
    """

    kind: str
    point: Any


@frozen
class Request:
    """A question to a teacher: show me how to reach this goal.

    Attributes:
        teacher: Name of the teacher asked.
        goal: The goal the learner has chosen.
        index: Number of the request, counted from 0 over all teachers.
    """

    teacher: str
    goal: Goal | None
    index: int


@frozen
class Plan:
    """What the learner wants done next: try a policy, or ask a teacher. Exactly one is set.

    Attributes:
        id: Number of the plan, unique within a run, in order of decision.
        episode: Number of the episode it belongs to.
        mode: Name of the sampling mode of that episode.
        goal: The goal that the episode pursues; None for modes without one.
        policy: The policy to try, a point of the task's policy space, or None.
        request: The request to put to a teacher, or None.
        context: The context it was made for, or None.
        watched: What the policy produced for a teacher, where the learner only watches: to be
            told as it is, without a movement. None for policies to try.
    """

    id: int
    episode: int
    mode: str
    goal: Goal | None
    policy: Any
    request: Request | None
    context: Any
    owner: object = field(default=None, repr=False)
    watched: Outcome | None = None


@frozen
class Trial:
    """One movement and what it produced.

    Attributes:
        policy: The policy tried.
        outcome: What it produced.
        context: The context it was tried in, or None.
    """

    policy: Any
    outcome: Outcome
    context: Any = None


@frozen
class Report:
    """What the learner says of a trial it was told.

    Attributes:
        cost: Distance in the scaled goal space, in [0, 1], from what the trial produced to the
            goal its episode pursues; None when the episode has no goal or the model cannot tell.
        competence: Competence for that goal so far, the better of before and of the episode's
            own trials; None as above.
        closed: Whether the trial ended its episode.
        progress: Gain of competence over the episode, if it ended and had a goal; else None.
    """

    cost: float | None
    competence: float | None
    closed: bool
    progress: float | None


@frozen
class Solution:
    """An answer for a goal.

    Attributes:
        policy: The policy to execute.
        expected: The outcome of the goal's kind it should produce.
        cost: Distance in the scaled goal space from ``expected`` to the goal, in [0, 1].
        spread: Standard deviation of what the policy may produce, one number per coordinate, in
            the outcome's units; how it is estimated is said where it is computed.
        reachable: Whether the goal seems to be within reach.
        radius: How near to the goal, in the scaled goal space, counts as reached; None if that
            was not asked.
        probability: Of coming within ``radius`` of the goal; None if the model cannot tell.
    """

    policy: Any
    expected: Any
    cost: float
    spread: FloatArray
    reachable: bool
    radius: float | None = None
    probability: float | None = None


class Trajectory:
    """A recorded movement: positions of named joints over time.

    Args:
        times: Seconds, strictly increasing, shape ``(n,)`` with n ≥ 2.
        positions: Joint positions, shape ``(n, joints)``.
        joints: Names of the joints.
        unit: Unit of the positions.

    Raises:
        SpaceError: If shapes disagree, times do not increase, or a number is not finite.
    """

    __slots__ = ("joints", "positions", "times", "unit")

    def __init__(
        self, times: Any, positions: Any, joints: tuple[str, ...] | list[str], unit: str = "rad"
    ) -> None:
        self.times: FloatArray = np.array(times, dtype=np.float64)
        self.positions: FloatArray = np.array(positions, dtype=np.float64)
        self.joints = tuple(joints)
        self.unit = unit
        if self.times.ndim != 1 or len(self.times) < 2:
            raise SpaceError(f"trajectory times have shape {self.times.shape}, expected (n ≥ 2,)")
        expected = (len(self.times), len(self.joints))
        if self.positions.shape != expected:
            raise SpaceError(
                f"trajectory positions have shape {self.positions.shape}, expected {expected}: "
                f"(times, joints {', '.join(self.joints)})"
            )
        if not (np.isfinite(self.times).all() and np.isfinite(self.positions).all()):
            raise SpaceError("trajectory has a number that is not finite")
        later = self.times[1:] > self.times[:-1]
        if not later.all():
            i = int(np.argmin(later))
            raise SpaceError(
                f"trajectory times must increase, but times[{i + 1}] = {self.times[i + 1]:g} "
                f"comes after times[{i}] = {self.times[i]:g}"
            )


@frozen
class Demonstration:
    """A movement a teacher showed, and what it produced.

    Attributes:
        outcome: What the movement produced for the teacher, as the learner sees it.
        policy: The movement as a policy of the learner, when teacher and learner share the
            encoding; else None.
        trajectory: The movement as recorded, to be mapped by the task's primitive; or None.
        teacher: The teacher's name; the run fills it in.
        context: The context it was shown in, or None.
    """

    outcome: Outcome
    policy: Any = None
    trajectory: Trajectory | None = None
    teacher: str = ""
    context: Any = None
