"""What the server sends of runs, to be watched."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sgim.web.protocol.values import GoalPoint


@dataclass(frozen=True)
class Kind:
    """A kind of outcome: names and units of its coordinates, and its bounds."""

    kind: str
    names: list[str]
    units: list[str]
    low: list[float]
    high: list[float]


@dataclass(frozen=True)
class ModeFacts:
    """What one mode came to.

    Attributes:
        name: The mode.
        episodes: How many were ended in it.
        movements: How many were made in it.
        progress: Gain of competence in all.
        lately: Gain of competence a movement, over the latest episodes.
    """

    name: str
    episodes: int
    movements: int
    progress: float
    lately: float


@dataclass(frozen=True)
class RunFacts:
    """How a run stands.

    Attributes:
        run: Its number on this page.
        title: What it is.
        experiment: Its experiment, if it is of one.
        movements: Made so far.
        target: Movements it was last asked for.
        finished: Whether it has reached them.
        unit: Unit of errors.
        kinds: Its kinds of outcome.
        evaluations: Movements, then the error of each kind.
        errors: Names of the errors, ``total`` among them.
        modes: What each mode came to.
        strip: Windows of time: movements at the end of each, then episodes begun in each mode.
        goals: The latest goals: kind, the first two coordinates, the number of the mode.
        shown: Demonstrations: kind, the first two coordinates, the movement they came at.
        regions: Of the interest map: kind, two corners, interest.
        requests: How many were ``asked``, ``answered``, ``declined``, ``expired``, ``unasked``.
        seconds: The persons' time so far, in s.
        problem: Why it cannot be read now, if so.
    """

    run: int
    title: str
    experiment: str
    movements: int
    target: int
    finished: bool
    unit: str
    kinds: list[Kind]
    evaluations: list[list[float]]
    errors: list[str]
    modes: list[ModeFacts]
    strip: list[list[float]]
    goals: list[GoalMark]
    shown: list[GoalMark]
    regions: list[Region]
    requests: dict[str, int]
    seconds: float
    problem: str


@dataclass(frozen=True)
class GoalMark:
    """A goal or demonstration on an outcome map; ``number`` is its mode, or its movement."""

    kind: str
    point: list[float]
    number: int


@dataclass(frozen=True)
class Region:
    """A region of the interest map, by two corners in the goal's units."""

    kind: str
    low: list[float]
    high: list[float]
    interest: float


@dataclass(frozen=True)
class Outcomes:
    """Outcomes of a run, a sample of them.

    Attributes:
        run: Its number on this page.
        kind: Their kind.
        afresh: Whether they replace what was sent before.
        points: Each the movement, then the first two coordinates.
    """

    run: int
    kind: str
    afresh: bool
    points: list[list[float]]


@dataclass(frozen=True)
class Recalled:
    """The best movement for a goal.

    Attributes:
        run: The run's number.
        goal: The goal.
        problem: Why there is none, if so.
        expected: What it should produce.
        error: By how much that misses the goal, as a share of its space.
        movement: To be drawn.
        shapes: The goal in the scene.
    """

    run: int
    goal: GoalPoint
    problem: str
    expected: list[float]
    error: float | None
    movement: dict[str, Any] | None
    shapes: list[dict[str, Any]]
