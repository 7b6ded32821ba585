"""The rows of a journal's table of events, and the records that come back from them.

One event is one row; an outcome of several kinds takes further rows, named ``also``, directly
behind it. Points are packed by their own space, so that they come back bit for bit; what has no
column of its own is JSON, or a word, in ``detail``.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from sgim.errors import unknown
from sgim.events import (
    Answered,
    Available,
    Closed,
    Demonstrated,
    Ended,
    Evaluated,
    Observed,
    Opened,
    Session,
    Suggested,
    Told,
)
from sgim.frozen import frozen
from sgim.spaces import Space

COLUMNS = (
    "event",
    "episode",
    "plan",
    "name",
    "kind",
    "point",
    "policy",
    "context",
    "seconds",
    "detail",
)
"""The columns of a row; in the table, ``seq`` comes before them."""

SCHEMA = (
    """CREATE TABLE header(
  key TEXT PRIMARY KEY,
  value TEXT                   -- JSON
)""",
    """CREATE TABLE events(
  seq INTEGER PRIMARY KEY,     -- 1, 2, 3, … without gaps
  event TEXT NOT NULL,         -- what happened; 'also': one more kind of the outcome above it
  episode INTEGER,
  plan INTEGER,
  name TEXT,                   -- the mode, the teacher, or how a plan ended
  kind TEXT,                   -- the kind of the point; NULL: no goal, or nothing produced
  point BLOB,                  -- goal or outcome; a box packs little-endian float64
  policy BLOB,
  context BLOB,
  seconds REAL,                -- the robot's or the teacher's time
  detail TEXT                  -- cause, request number, reason, yes or no; else JSON
)""",
)
"""The statements that make the tables; SQLite keeps their comments for whoever looks inside."""

Row = tuple[
    str,
    int | None,
    int | None,
    str | None,
    str | None,
    bytes | None,
    bytes | None,
    bytes | None,
    float | None,
    str | None,
]
"""The values of one row, in the order of `COLUMNS`."""

ALSO = "also"
"""The name of a row that adds a kind to the outcome of the event before it."""

DECLINED = "declined"
"""The detail of an answer without a demonstration."""


@frozen
class RecordedPlan:
    """A plan as it was recorded: what does not follow from its episode.

    Exactly one of ``policy`` and ``teacher`` is set.

    Attributes:
        id: Number of the plan.
        episode: Number of the episode it belongs to.
        policy: The policy to try, or None for a request.
        teacher: Name of the teacher asked, or None for a policy.
        request: Number of the request (`Request.index`), or None for a policy.
        context: The context it was made for, or None.
    """

    id: int
    episode: int
    policy: Any
    teacher: str | None
    request: int | None
    context: Any


RecordedEvent = (
    Opened
    | RecordedPlan
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
"""What comes back from a journal: events as appended, but a `RecordedPlan` for a `Planned`."""


class Kinds(dict[str, Callable[[Any], Any]]):
    """Kind → a method of that kind's space; an unknown kind raises `UnknownNameError`.

    Args:
        what: What the kinds are of, for the error.
        spaces: Kind → space.
        method: Name of the method, ``"pack"`` or ``"unpack"``.
    """

    def __init__(self, what: str, spaces: Mapping[str, Space], method: str) -> None:
        super().__init__((kind, getattr(space, method)) for kind, space in spaces.items())
        self._what = what

    def __missing__(self, kind: str) -> Callable[[Any], Any]:
        raise unknown(self._what, kind, self)


def no_context(_: Any) -> Any:
    """Stand in for the packing of contexts in a task that has none."""
    raise ValueError("it has a context, but the task has no context space")


def _scalar(value: object) -> object:
    if isinstance(value, np.generic):  # measures often are NumPy scalars
        return value.item()
    raise TypeError(f"{value!r:.60} is a {type(value).__name__}, which JSON cannot hold")


_encode = json.JSONEncoder(default=_scalar).encode


def to_json(value: object) -> str:
    """Write JSON; the floats in it come back exactly."""
    return _encode(value)
