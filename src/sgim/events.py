"""Everything that can happen to a learner, as immutable events.

A learner's state is a fold over these; the journal stores them in order. `Opened`, `Planned` and
`Closed` are what the learner decided or concluded; the others are what it was told.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from sgim.frozen import frozen
from sgim.records import Demonstration, Goal, Outcome, Plan, Trial

Cause = Literal["strategy", "suggestion", "demonstration"]
Ending = Literal["failed", "refused", "expired", "lost"]


@frozen
class Opened:
    """An episode was opened: what to aim at and how to learn it have been decided.

    Attributes:
        episode: Number of the episode.
        mode: Name of its sampling mode.
        goal: The goal chosen, or None for a mode without one.
        context: The context it was chosen in, or None.
        cause: Who chose: the strategy, a person's suggestion, or an unasked demonstration.
        budget: Most movements in it, if fewer than its mode usually has.
    """

    episode: int
    mode: str
    goal: Goal | None
    context: Any
    cause: Cause
    budget: int | None = None


@frozen
class Planned:
    """A plan was made (a policy to try, or a request)."""

    plan: Plan


@frozen
class Answered:
    """A request was answered; a demonstration of None is a refusal.

    Attributes:
        plan: Id of the plan that held the request.
        demonstration: What was shown, already mapped to a policy, or None.
        seconds: The teacher's time it took, if known.
    """

    plan: int
    demonstration: Demonstration | None
    seconds: float | None = None


@frozen
class Told:
    """A plan was executed.

    Attributes:
        plan: Id of the plan.
        outcome: What it produced; empty when nothing.
        seconds: The robot's time it took, if known.
    """

    plan: int
    outcome: Outcome
    seconds: float | None = None


@frozen
class Ended:
    """A plan ended without an outcome.

    Attributes:
        plan: Id of the plan.
        how: ``failed`` (the world broke: teaches nothing), ``refused`` (a safety check said no:
            counts against the plan), ``expired`` (nobody did it in time) or ``lost`` (started,
            and never heard of again).
        reason: Why, in words.
        seconds: The robot's time it took, if known.
    """

    plan: int
    how: Ending
    reason: str
    seconds: float | None = None


@frozen
class Observed:
    """A trial from elsewhere was added to the memory."""

    trial: Trial


@frozen
class Demonstrated:
    """A teacher showed something unasked."""

    demonstration: Demonstration


@frozen
class Suggested:
    """A person suggested a goal."""

    goal: Goal


@frozen
class Available:
    """A teacher came or went."""

    teacher: str
    yes: bool


@frozen
class Closed:
    """An episode ended. It follows from the events before it, and is kept for readers.

    Attributes:
        episode: Number of the episode.
        mode: Mode it is credited to: its own, or autonomous exploration if its request was not
            answered.
        pursued: The goal pursued (the demonstrated outcome, in emulation), or None.
        before: Competence for that goal when it was taken up; None without a goal.
        after: Competence at the end.
        movements: Trials executed in the episode.
    """

    episode: int
    mode: str
    pursued: Goal | None
    before: float | None
    after: float | None
    movements: int


@frozen
class Evaluated:
    """The repertoire was measured against a benchmark, outside of learning.

    Attributes:
        movements: Trials executed so far.
        errors: Goal kind → mean error over the benchmark, and ``total``, the mean of the kinds.
    """

    movements: int
    errors: Mapping[str, float]


@frozen
class Session:
    """A process began to write: when, with which versions, and why.

    Attributes:
        facts: Name → value, JSON-compatible: time, versions of sgim, Python, NumPy, SciPy,
            processor, whether recorded decisions were adopted.
    """

    facts: Mapping[str, Any]


Event = (
    Opened
    | Planned
    | Answered
    | Told
    | Ended
    | Observed
    | Demonstrated
    | Suggested
    | Available
    | Closed
    | Evaluated
    | Session
)
