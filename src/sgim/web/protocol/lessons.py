"""What the server sends of itself, and of a lesson."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from sgim.web.protocol.values import GoalPoint


@dataclass(frozen=True)
class Welcome:
    """The answer to `Hello`.

    Attributes:
        version: Of the protocol.
        teaches: Whether the page can teach a run; else it only watches.
        teacher: The name by which the learner knows the person.
        scene: How the world looks, or None if it cannot be drawn.
        joints: What a person moves: name, least, greatest and first position.
        unit: Unit of the joints.
        shortest: Of a movement, in s.
        longest: Of a movement, in s.
    """

    version: int
    teaches: bool
    teacher: str
    scene: dict[str, Any] | None
    joints: list[Joint]
    unit: str
    shortest: float
    longest: float


@dataclass(frozen=True)
class Joint:
    """A joint that a person moves."""

    name: str
    low: float
    high: float
    home: float


@dataclass(frozen=True)
class Role:
    """Whether this page is in control, whose is if not, and how many pages there are."""

    mine: bool
    holder: str
    pages: int


@dataclass(frozen=True)
class Asked:
    """A request.

    Attributes:
        plan: The plan that holds it.
        teacher: Who is asked.
        who: Which learner asks.
        mode: The mode that it would learn in.
        goal: What it wants to see reached, or None if the teacher is to choose.
        shapes: The goal in the scene.
        error: What the goal is missed by now, as a share of its space.
        gain: What is expected of a movement after an answer.
        alone: What is expected of a movement by itself.
        replaces: What it would do instead.
        movements: How many movements it makes of an answer.
        waiting: How long it has waited, in s.
        left: How long it will wait yet, in s.
    """

    plan: int
    teacher: str
    who: str
    mode: str
    goal: GoalPoint | None
    shapes: list[dict[str, Any]]
    error: float | None
    gain: float | None
    alone: float | None
    replaces: str
    movements: int
    waiting: float
    left: float


@dataclass(frozen=True)
class Desk:
    """What is asked now, and what was arranged.

    Attributes:
        requests: What is asked, oldest first.
        status: ``now``, ``busy`` or ``away``.
        time_limit: Of a request, in s.
        per_hour: Requests an hour.
        left: How many are left in this hour.
        going: Whether the run goes on.
    """

    requests: list[Asked]
    status: str
    time_limit: float
    per_hour: int
    left: int
    going: bool


@dataclass(frozen=True)
class Pose:
    """Where the arm is, in answer to `Lead` or `Reset` (whose number is -1).

    Attributes:
        number: Of the message answered.
        joints: For each sample, the time in s, then the positions of the joints.
        points: Where the scene's points are now.
        held: Where the handle was last led to, which it may not have reached yet.
        stuck: Joints that are at a limit.
    """

    number: int
    joints: list[list[float]]
    points: list[list[float]]
    held: list[float]
    stuck: list[int]


@dataclass(frozen=True)
class Assessed:
    """What a take is worth.

    Attributes:
        take: The take.
        problem: Why it cannot be given to the learner, if so.
        outcome: What it reached: kind → point.
        reached: What the learner's nearest movement reaches.
        distance: From the goal to what the take reached, as a share of the goal's space.
        residual: The correspondence error: root mean square of the differences, in the unit of
            the joints.
        unit: That unit.
        duration: In s.
        shown: The person's movement, to be drawn.
        fitted: The learner's, to be drawn.
        curves: For each joint: its times, the person's positions, the learner's.
    """

    take: str
    problem: str
    outcome: dict[str, list[float]]
    reached: dict[str, list[float]]
    distance: float | None
    residual: float
    unit: str
    duration: float
    shown: dict[str, Any] | None
    fitted: dict[str, Any] | None
    curves: list[Curves]


@dataclass(frozen=True)
class Curves:
    """Positions of one joint over time: the person's, and the learner's (figure 3.2.2)."""

    joint: str
    times: list[float]
    shown: list[float]
    fitted: list[float]


@dataclass(frozen=True)
class Said:
    """What became of a letter.

    Attributes:
        id: Its name.
        state: ``sent``, when it is on the disk; ``taken``, when the run has taken it up;
            ``ended``, when the episode that came of it has ended; ``refused``.
        words: What else there is to say.
        before: Error at the goal before, in an answer that has ended.
        after: Error at the goal after.
    """

    id: str
    state: Literal["sent", "taken", "ended", "refused"]
    words: str = ""
    before: float | None = None
    after: float | None = None


@dataclass(frozen=True)
class Exported:
    """A file of demonstrations."""

    text: str


@dataclass(frozen=True)
class Imported:
    """Takes from a file: the name of each and its samples; they are assessed like others."""

    takes: list[ImportedTake]
    teacher: str


@dataclass(frozen=True)
class ImportedTake:
    """A take from a file."""

    take: str
    samples: list[list[float]]


@dataclass(frozen=True)
class Refused:
    """A message was not obeyed, and why."""

    words: str
