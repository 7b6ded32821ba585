"""The messages between page and server: JSON objects over one websocket, one class a message.

The field ``what`` of each object names its class, in lower case. ``web/src/protocol.ts`` is made
from this file (``python -m sgim.web.typescript``), and a test keeps the two the same. Whatever the
page sends is checked against these types and limits before anything looks at it; a number that
is not finite, a field that is unknown or missing, or a list that is too long is refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

VERSION = 1
"""Of this protocol; a page of another version asks to be loaded again."""

LARGEST_MESSAGE = 1 << 20
"""Bytes of the largest message that the server reads."""


@dataclass(frozen=True)
class Most:
    """A limit: the longest text or list, or the largest magnitude of a number."""

    value: float


Name = Annotated[str, Most(60)]
Words = Annotated[str, Most(300)]
Key = Annotated[str, Most(40)]
Number = Annotated[float, Most(1e6)]
Point = Annotated[list[Number], Most(64)]
Samples = Annotated[list[Point], Most(6000)]


# What the page sends.


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
class GoalPoint:
    """A goal."""

    kind: Name
    point: Point


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


# What the server sends.


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
        stuck: Joints that are at a limit.
    """

    number: int
    joints: list[list[float]]
    points: list[list[float]]
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


FromServer = (
    Welcome
    | Role
    | RunFacts
    | Outcomes
    | Desk
    | Pose
    | Assessed
    | Said
    | Recalled
    | Exported
    | Imported
    | Refused
)
"""Everything that the server may send."""
