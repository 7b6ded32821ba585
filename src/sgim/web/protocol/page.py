"""What the page sends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from sgim.web.protocol.values import GoalPoint, Key, Most, Name, Number, Point, Samples, Words


@dataclass(frozen=True)
class Hello:
    """The first message: which page this is, and the person's name.

    Attributes:
        version: Of the protocol.
        page: The page's own name, by which it is known when it connects again.
        name: The person's name.
    """

    version: int
    page: Key
    name: Name


@dataclass(frozen=True)
class Control:
    """Take control, or leave it."""

    take: bool


@dataclass(frozen=True)
class Reset:
    """Begin anew with the joints at these positions, or at home."""

    joints: Point | None


@dataclass(frozen=True)
class Lead:
    """Lead the arm; answered by a `Pose` of the same number.

    Attributes:
        number: Counted by the page.
        by: Whether samples are places of the handle, or positions of the joints.
        samples: Each the time in s, then the coordinates.
    """

    number: int
    by: Literal["tip", "joints"]
    samples: Annotated[list[Point], Most(300)]


@dataclass(frozen=True)
class Assess:
    """Ask what a take is worth; answered by `Assessed`.

    Attributes:
        take: The page's name for it.
        samples: Each the time in s, then the positions of the joints.
        raw: Each as it was drawn: the time in s, then the coordinates.
        speed: How many times as fast it is to be played.
        goal: What was asked for.
    """

    take: Key
    samples: Samples
    raw: Samples
    speed: Number
    goal: GoalPoint | None


@dataclass(frozen=True)
class Accept:
    """Give an assessed take to the learner: as the answer to a plan's request, or unasked.

    Attributes:
        id: The letter's name; sent again, it is the same letter.
        take: The take.
        plan: The plan that holds the request, or None.
        seconds: The person's time that it took.
    """

    id: Key
    take: Key
    plan: int | None
    seconds: Number


@dataclass(frozen=True)
class Decline:
    """Decline a request."""

    id: Key
    plan: int
    reason: Words


@dataclass(frozen=True)
class Skip:
    """Leave a request to expire at once."""

    id: Key
    plan: int


@dataclass(frozen=True)
class Extend:
    """Ask for more time for a request."""

    id: Key
    plan: int


@dataclass(frozen=True)
class Suggest:
    """Suggest a goal."""

    id: Key
    kind: Name
    point: Point


@dataclass(frozen=True)
class Arrange:
    """Say when to be asked.

    Attributes:
        id: The letter's name.
        status: ``now``, ``busy`` (nothing new), or ``away`` (requests expire at once).
        time_limit: Of a request, in s.
        per_hour: Requests an hour.
    """

    id: Key
    status: Literal["now", "busy", "away"]
    time_limit: Number
    per_hour: int


@dataclass(frozen=True)
class Recall:
    """Ask for the best movement that a run has learned for a goal; answered by `Recalled`."""

    run: int
    kind: Name
    point: Point


@dataclass(frozen=True)
class Export:
    """Ask for assessed takes as a file of demonstrations; answered by `Exported`."""

    takes: Annotated[list[Key], Most(200)]


@dataclass(frozen=True)
class Import:
    """Give a file of demonstrations; answered by `Imported`."""

    text: Annotated[str, Most(900_000)]


FromPage = (
    Hello
    | Control
    | Reset
    | Lead
    | Assess
    | Accept
    | Decline
    | Skip
    | Extend
    | Suggest
    | Arrange
    | Recall
    | Export
    | Import
)
"""Everything that the page may send."""
