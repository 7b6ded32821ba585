"""Appends rows to a journal's file in groups, and loses none when the disk is full."""

from __future__ import annotations

import sqlite3
import time
from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from operator import itemgetter
from pathlib import Path
from typing import Any

from sgim.errors import JournalError
from sgim.runs.journal_errors import unwritten
from sgim.runs.journal_mode import finish
from sgim.runs.rows import ALSO, COLUMNS, Row
from sgim.runs.writer_lock import WriterLock

GROUP_ROWS = 4096
"""Rows that are gathered, unless the journal is durable, before they are committed together."""

GROUP_SECONDS = 1.0
"""Age in seconds of the oldest waiting row at which the next append commits."""


INSERTED = 64
"""Rows that one statement inserts, where there are so many of a shape: SQLite's fastest way."""


class _Shape:
    """Rows that have values in the same few columns, to be inserted by one statement.

    Binding the columns that are empty would cost more than all the rest of an insertion.

    Args:
        columns: The columns that may have values; all others of such a row are empty.
        filled: One of them. An event's row is of this shape if it has a value here
        empty: and none here: how events are encoded leaves no other case.
    """

    def __init__(self, columns: Sequence[str], filled: str, empty: str) -> None:
        self.pick = itemgetter(*(COLUMNS.index(name) for name in columns))
        self.filled, self.empty = COLUMNS.index(filled), COLUMNS.index(empty)
        self.width = 1 + len(columns)
        values = f"({', '.join('?' * self.width)})"
        self.one = f"INSERT INTO events(seq, {', '.join(columns)}) VALUES {values}"
        self.many = self.one + f", {values}" * (INSERTED - 1)

    def insert(self, db: sqlite3.Connection, values: list[Any]) -> None:
        """Insert rows whose values, each row's ``seq`` first, lie one behind the other."""
        width, most = self.width, INSERTED * self.width
        whole = len(values) // most * most
        for start in range(0, whole, most):
            db.execute(self.many, values[start : start + most])
        rest = range(whole, len(values), width)
        db.executemany(self.one, (values[start : start + width] for start in rest))


_ANY = _Shape(COLUMNS, "event", "event")
_SHAPES = {
    "planned": _Shape(("event", "episode", "plan", "policy"), "policy", "context"),
    "told": _Shape(("event", "plan", "kind", "point"), "point", "seconds"),
    "opened": _Shape(("event", "episode", "name", "kind", "point", "detail"), "point", "context"),
    "closed": _Shape(("event", "episode", "name", "kind", "point", "detail"), "point", "context"),
}


def _by_shape(rows: list[Row], after: int, done: int) -> dict[_Shape, list[Any]]:
    """Values to insert, each row's ``seq`` first, by the shape of their rows."""
    groups: defaultdict[_Shape, list[Any]] = defaultdict(list)
    for seq, row in enumerate(rows[done:] if done else rows, start=after + done + 1):
        shape = _SHAPES.get(row[0])
        if shape is None or row[shape.filled] is None or row[shape.empty] is not None:
            groups[_ANY] += (seq, *row)
        else:
            groups[shape] += (seq, *shape.pick(row))
    return groups


class _Waiting:
    """Rows not yet committed, and the ``seq`` of the row before them.

    A commit replaces the object rather than changing it, so that an interrupt at any moment
    leaves rows and number in agreement.
    """

    __slots__ = ("after", "beside", "rows", "since")

    def __init__(self, after: int) -> None:
        self.after = after
        self.rows: list[Row] = []
        self.beside: list[tuple[str, tuple[Any, ...]]] = []
        self.since = 0.0


class Writer:
    """The one writer of a journal's file.

    Args:
        db: A connection to it, which the writer closes.
        path: The file.
        lock: The lock on it, which the writer releases.
        durable: Whether each append waits until the disk has it.
    """

    def __init__(
        self, db: sqlite3.Connection, path: Path, lock: WriterLock, *, durable: bool
    ) -> None:
        self._db = db
        self._path = path
        self._lock = lock
        self._durable = durable
        self._waiting = _Waiting(_last(db))

    @property
    def waiting(self) -> int:
        """Number of events not yet committed."""
        return sum(row[0] != ALSO for row in self._waiting.rows)

    def append(self, rows: list[Row]) -> None:
        """Add the rows of one event; commit if it is time.

        Raises:
            JournalError: As `commit`; the rows are kept.
        """
        waiting, now = self._waiting, time.monotonic()
        if not waiting.rows:
            waiting.since = now
        waiting.rows += rows
        full = len(waiting.rows) >= GROUP_ROWS or now - waiting.since > GROUP_SECONDS
        if full or self._durable:
            self.commit()

    def beside(self, statement: str, values: tuple[Any, ...]) -> None:
        """Add a statement on another table to the next commit; repeated, it must do no harm."""
        self._waiting.beside.append((statement, values))

    def commit(self, *, synced: bool = False) -> None:
        """Write what is waiting, all or nothing.

        Args:
            synced: Whether to wait until the disk has it, also where appending does not.

        Raises:
            JournalError: If it cannot be written, or another program has written to the file.
                What was waiting stays, and the next commit tries again.
        """
        db, waiting = self._db, self._waiting
        if not waiting.rows and not waiting.beside:
            return
        if synced and not self._durable:
            db.execute("PRAGMA synchronous = FULL")
            try:
                self.commit()
            finally:
                db.execute("PRAGMA synchronous = NORMAL")
            return
        try:
            if db.in_transaction:  # of an attempt that could not even be rolled back
                db.execute("ROLLBACK")
            db.execute("BEGIN IMMEDIATE")
            done = self._already_written()
            for shape, values in _by_shape(waiting.rows, waiting.after, done).items():
                shape.insert(db, values)
            for statement, parameters in waiting.beside:
                db.execute(statement, parameters)
            db.execute("COMMIT")
        except BaseException as error:
            with suppress(sqlite3.Error):
                if db.in_transaction:
                    db.execute("ROLLBACK")
            if isinstance(error, sqlite3.Error):
                raise unwritten(self._path, error, self.waiting) from error
            raise
        self._waiting = _Waiting(waiting.after + len(waiting.rows))

    def _already_written(self) -> int:
        """How many waiting rows the file has: some, if a commit was interrupted when done."""
        after, rows = self._waiting.after, self._waiting.rows
        last = _last(self._db)
        if last == after:
            return 0
        if after < last <= after + len(rows):
            statement = f"SELECT {', '.join(COLUMNS)} FROM events WHERE seq = ?"
            if self._db.execute(statement, (last,)).fetchone() == rows[last - after - 1]:
                return last - after
        raise JournalError(
            f"journal {self._path} has {last} rows where this process left {after}: another "
            "program writes to it; stop one of the two"
        )

    def close(self) -> None:
        """Finish the file and let others write; what was not committed is lost."""
        try:
            finish(self._db, self._path)
        finally:
            self._lock.release()


def _last(db: sqlite3.Connection) -> int:
    return int(db.execute("SELECT coalesce(max(seq), 0) FROM events").fetchone()[0])
