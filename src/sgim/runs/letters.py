"""Letters between a run and the persons who teach it, in tables beside the journal's events.

A page writes letters and nothing else; the run writes the other tables. Both may be killed at any
moment: a letter is on the disk when the page says that it was sent, and the run notes that it has
taken a letter up in the same transaction as what came of it. So each is taken up once.
"""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from sgim.errors import JournalError
from sgim.frozen import frozen
from sgim.records import Demonstration, Trajectory
from sgim.runs.journal_errors import explain
from sgim.runs.journal_file import connect
from sgim.runs.rows import to_json

SCHEMA = (
    """CREATE TABLE IF NOT EXISTS letters(
  number INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,     -- who sends it again sends the same
  what TEXT NOT NULL,          -- answer, decline, skip, demonstrate, suggest, available, extend
  teacher TEXT NOT NULL,       -- whom the learner knows
  plan INTEGER,                -- the plan that holds the request
  name TEXT NOT NULL,          -- the person's name
  time REAL NOT NULL,          -- seconds since 1970
  detail TEXT NOT NULL,        -- JSON
  raw TEXT                     -- JSON: samples as they were drawn
)""",
    """CREATE TABLE IF NOT EXISTS taken(
  letter INTEGER PRIMARY KEY,
  said TEXT NOT NULL           -- what came of it, empty if all is well
)""",
    """CREATE TABLE IF NOT EXISTS requests(
  plan INTEGER PRIMARY KEY,
  teacher TEXT NOT NULL,
  asked REAL NOT NULL,         -- seconds since 1970
  until REAL NOT NULL,
  detail TEXT NOT NULL         -- JSON: goal and reasons
)""",
    """CREATE TABLE IF NOT EXISTS persons(
  teacher TEXT PRIMARY KEY,
  detail TEXT NOT NULL         -- JSON: status, time limit, budget
)""",
)
"""The statements that make the tables."""

_COLUMNS = "number, id, what, teacher, plan, name, time, detail"


@frozen
class Letter:
    """What a person did.

    Attributes:
        number: 1, 2, 3, … in the order they came.
        id: The page's own name for it, by which a repetition is known.
        what: ``answer``, ``decline``, ``skip``, ``demonstrate``, ``suggest``, ``available`` or
            ``extend``.
        teacher: The teacher whom the learner knows.
        plan: The plan that holds the request it is about, or None.
        name: The person's own name.
        time: When, in seconds since 1970.
        detail: The rest, as JSON has it.
    """

    number: int
    id: str
    what: str
    teacher: str
    plan: int | None
    name: str
    time: float
    detail: Mapping[str, Any]


def letter_of(row: tuple[Any, ...]) -> Letter:
    """A letter from its row, whose columns are those that `select_letters` names."""
    number, name, what, teacher, plan, person, moment, detail = row
    return Letter(number, name, what, teacher, plan, person, moment, json.loads(detail))


def select_letters(where: str) -> str:
    """A statement that reads letters in order."""
    return f"SELECT {_COLUMNS} FROM letters WHERE {where} ORDER BY number"


def demonstration_detail(shown: Demonstration) -> dict[str, Any]:
    """A demonstration as a letter's detail; points must be numbers or labels."""
    recorded = shown.trajectory
    return {
        "outcome": {kind: plain(point) for kind, point in shown.outcome.items()},
        "policy": None if shown.policy is None else plain(shown.policy),
        "trajectory": None
        if recorded is None
        else {
            "times": recorded.times.tolist(),
            "positions": recorded.positions.tolist(),
            "joints": list(recorded.joints),
            "unit": recorded.unit,
        },
    }


def demonstration_of(letter: Letter) -> Demonstration:
    """The demonstration that a letter's detail holds.

    Raises:
        SpaceError: If its trajectory is malformed.
    """
    detail = letter.detail
    recorded = detail.get("trajectory")
    return Demonstration(
        detail["outcome"],
        detail.get("policy"),
        None if recorded is None else Trajectory(**recorded),
        letter.teacher,
    )


class LetterBox:
    """The page's side: sends letters, and sees what is asked and what came of each letter.

    Args:
        path: The journal of a run with remote teachers; the run may be going on.

    Raises:
        JournalError: If the file cannot be written, or its run has no remote teacher.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if not self.path.exists():
            raise JournalError(f"there is no journal {path}; check the path")
        with self._connection() as db:
            db.execute("PRAGMA synchronous = FULL")
            if not has_letters(db):
                raise JournalError(
                    f"the run of {path} asks nobody through a page; begin one with sgim teach"
                )

    @contextmanager
    def _connection(self) -> Iterator[sqlite3.Connection]:
        # A connection for each use: one left open would keep the run from finishing its file.
        try:
            with closing(connect(self.path, "mode=rw")) as db:
                yield db
        except sqlite3.Error as error:
            raise explain(self.path, error) from error

    def send(
        self,
        what: str,
        teacher: str,
        *,
        id: str,  # noqa: A002 - it is the letter's
        name: str,
        plan: int | None = None,
        detail: Mapping[str, Any] | None = None,
        raw: Any = None,
    ) -> int:
        """Write a letter; it is on the disk when this returns. The same id again does nothing.

        Returns:
            The letter's number.
        """
        values = (
            *(id, what, teacher, plan, name, time.time(), to_json(detail or {})),
            None if raw is None else to_json(raw),
        )
        with self._connection() as db:
            db.execute("PRAGMA synchronous = FULL")
            db.execute(
                "INSERT OR IGNORE INTO letters(id, what, teacher, plan, name, time, detail, raw) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                values,
            )
            ((number,),) = db.execute("SELECT number FROM letters WHERE id = ?", (id,))
        return int(number)

    def has(self, id: str) -> bool:  # noqa: A002 - it is the letter's
        """Whether a letter of this id was sent."""
        with self._connection() as db:
            return bool(db.execute("SELECT 1 FROM letters WHERE id = ?", (id,)).fetchall())

    def said(self, ids: list[str]) -> dict[str, str]:
        """What came of those of these letters that were taken up."""
        marks = ", ".join("?" * len(ids))
        with self._connection() as db:
            return dict(
                db.execute(
                    "SELECT id, said FROM letters JOIN taken ON letter = number "
                    f"WHERE id IN ({marks})",
                    ids,
                )
            )

    def requests(self) -> list[dict[str, Any]]:
        """What is asked now, oldest first: plan, teacher, asked, until, and the reasons.

        One that a letter not yet taken up answers is left out.
        """
        with self._connection() as db:
            rows = db.execute(
                "SELECT plan, teacher, asked, until, detail FROM requests WHERE until > 0 AND "
                "plan NOT IN (SELECT plan FROM letters WHERE plan IS NOT NULL AND "
                "what IN ('answer', 'decline', 'skip')) ORDER BY plan"
            ).fetchall()
        names = ("plan", "teacher", "asked", "until")
        return [dict(zip(names, row[:4], strict=True)) | json.loads(row[4]) for row in rows]

    def persons(self) -> dict[str, dict[str, Any]]:
        """Teacher → status, time limit, budget, and how many requests are left this hour."""
        with self._connection() as db:
            return {t: json.loads(d) for t, d in db.execute("SELECT teacher, detail FROM persons")}


def has_letters(db: sqlite3.Connection) -> bool:
    """Whether a journal's file has the tables of this module."""
    found = db.execute("SELECT count(*) FROM sqlite_schema WHERE name = 'letters'").fetchone()
    return bool(found[0])


def plain(point: Any) -> Any:
    """A point as JSON has it."""
    return point.tolist() if hasattr(point, "tolist") else point
