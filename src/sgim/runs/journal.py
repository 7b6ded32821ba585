"""The journal of a run: its events in order, in one SQLite file, which is also its checkpoint."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from sgim.errors import JournalError, unknown
from sgim.events import Event
from sgim.runs.codec import Codec
from sgim.runs.journal_errors import exists, explain
from sgim.runs.journal_file import SCHEMA_VERSION, create_file, open_file
from sgim.runs.journal_reading import read_columns, read_header, read_rows, recorded_task
from sgim.runs.rows import ALSO, COLUMNS, RecordedEvent, to_json
from sgim.runs.writer import Writer
from sgim.runs.writer_lock import WriterLock
from sgim.task import Task


class Journal:
    """The events of one run, append only. Made by `create` or `open`; closed by ``with``.

    One process writes and any number read along. An object is for one thread at a time.

    Attributes:
        path: The file.
        header: What was given to `create`, with ``schema`` and ``task`` added.
        task: The task whose spaces pack the points.
    """

    def __init__(
        self,
        path: Path,
        db: sqlite3.Connection,
        header: Mapping[str, Any],
        task: Task,
        lock: WriterLock | None,
        durable: bool,
    ) -> None:
        self.path = path
        self.header = header
        self.task = task
        self._db: sqlite3.Connection | None = db
        self._codec = Codec(task)
        self._writer = None if lock is None else Writer(db, path, lock, durable=durable)

    @classmethod
    def create(
        cls, path: str | Path, header: Mapping[str, Any], task: Task, *, durable: bool = False
    ) -> Self:
        """Make a new journal, and its parent directories, open for appending.

        Args:
            path: The file to make.
            header: What describes the run (experiment, learner, seed, …), JSON-compatible.
                ``schema`` and ``task`` are added to it.
            task: The task of the run.
            durable: Whether each append waits until the disk has the event, for worlds where a
                trial is dear. Otherwise events are committed in groups: a kill loses those
                since the last commit, about a second; a power failure, a little more.

        Raises:
            JournalError: If the file exists or cannot be made, or the header is not JSON.
        """
        path = Path(path)
        if os.path.lexists(path):
            raise exists(path)
        header = {**header, "schema": SCHEMA_VERSION, "task": task.describe()}
        try:
            header = json.loads(to_json(header))
        except (TypeError, ValueError) as error:
            raise JournalError(f"a header must be JSON-compatible: {error}") from error
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise JournalError(
                f"{path.parent} cannot be made ({error.strerror}); choose another path"
            ) from error
        lock = WriterLock(path.resolve())
        try:
            if os.path.lexists(path):  # made by whoever held the lock until now
                raise exists(path)
            db = create_file(path, header, durable=durable)
        except BaseException:
            lock.release()
            raise
        return cls(path, db, header, task, lock, durable)

    @classmethod
    def open(
        cls, path: str | Path, task: Task | None = None, *, append: bool, durable: bool = False
    ) -> Self:
        """Open a journal that exists.

        Args:
            path: Its file.
            task: The task of the run; None to make it from the header, which is possible for
                spaces that are part of the library.
            append: Whether to go on with it. If not, it opens also where nobody may write, and
                while another process writes.
            durable: As in `create`.

        Raises:
            JournalError: If there is none, it is not a journal, of another task, of a newer
                schema, damaged, being written by another process, or may not be written.
        """
        path = Path(path)
        lock = WriterLock(path.resolve()) if append and os.path.isfile(path) else None
        db = None
        try:
            db = open_file(path, append=append, durable=durable)
            header = read_header(db, path)
            return cls(path, db, header, recorded_task(header, path, task), lock, durable)
        except BaseException:
            if db is not None:
                db.close()
            if lock is not None:
                lock.release()
            raise

    def append(self, event: Event) -> None:
        """Record an event.

        Raises:
            JournalError: If the event does not fit the task (it is not recorded then), or if
                writing failed (it is kept, as `commit` says).
        """
        writer = self._writer
        if writer is None or self._db is None:
            writer = self._writable()
        writer.append(self._codec.encode(event))

    def commit(self, *, synced: bool = False) -> None:
        """Write what is waiting, all or nothing.

        Args:
            synced: Whether to wait until the disk has it, also if the journal is not durable.

        Raises:
            JournalError: If it cannot be written (the disk is full or broken). The events stay in
                memory, in order, and the next commit or append tries again.
        """
        self._writable().commit(synced=synced)

    def beside(self, statement: str, *values: Any) -> None:
        """Execute a statement on a table beside the events, together with the next commit.

        After a failed commit it is executed again, so it must be one that may be repeated.
        """
        self._writable().beside(statement, values)

    def query(self, statement: str, *values: Any) -> list[tuple[Any, ...]]:
        """What a statement on a table beside the events gives."""
        try:
            return self._connection().execute(statement, values).fetchall()
        except sqlite3.Error as error:
            raise explain(self.path, error) from error

    def events(self, after: int = 0, only: Iterable[str] | None = None) -> Iterator[RecordedEvent]:
        """The events in order, as appended, but a `RecordedPlan` for each `Planned`.

        What this journal has not committed yet is committed first.

        Args:
            after: Begin behind this row, 0 for all; `entries` gives the numbers of rows.
            only: Names of the events wanted (``"closed"``, ``"evaluated"``, …); None for all.

        Raises:
            JournalError: If the file is damaged, or a row cannot be read.
            UnknownNameError: If ``only`` has a name that no event has.
        """
        return (event for _, event in self.entries(after, only))

    def entries(
        self, after: int = 0, only: Iterable[str] | None = None
    ) -> Iterator[tuple[int, RecordedEvent]]:
        """As `events`, each with the number of its last row, from which to read on later."""
        names = None if only is None else {*only}
        db = self._reading(names or ())
        wanted = None if names is None else sorted({*names, ALSO})
        return self._codec.decode(read_rows(db, self.path, after, wanted))

    def columns(self, event: str, *columns: str) -> list[tuple[Any, ...]]:
        """Some columns of the rows of one sort of event, in order: to count without decoding.

        Args:
            event: Name of the event (``"told"``, …).
            columns: Which columns (`sgim.runs.rows.COLUMNS`, or ``"seq"``), as they are stored.

        Raises:
            JournalError: If the file is damaged.
            UnknownNameError: If there is no such event or column.
        """
        known = ("seq", *COLUMNS)
        for column in columns:
            if column not in known:
                raise unknown("column of a journal", column, known)
        return read_columns(self._reading([event]), self.path, event, columns)

    def _reading(self, names: Iterable[str]) -> sqlite3.Connection:
        """The connection, for reading events of these names, all of them committed."""
        for name in names:
            if name not in self._codec.names:
                raise unknown("event", name, self._codec.names)
        db = self._connection()
        if self._writer is not None:
            self._writer.commit()
        return db

    def __len__(self) -> int:
        """Number of events, those waiting to be committed included; counts them all."""
        db = self._connection()
        try:
            statement = "SELECT count(*) FROM events WHERE event != ?"
            ((written,),) = db.execute(statement, (ALSO,))
        except sqlite3.Error as error:
            raise explain(self.path, error) from error
        return int(written) + (0 if self._writer is None else self._writer.waiting)

    def __bool__(self) -> bool:
        """True, also without events, so that `if journal` asks whether there is a journal."""
        return True

    def close(self) -> None:
        """Commit, and leave one file that opens where nobody may write. Closing again is nothing.

        Raises:
            JournalError: If something could not be written; the journal stays open then.
        """
        if self._db is None:
            return
        if self._writer is not None:
            self._writer.commit()
        db, self._db = self._db, None
        if self._writer is not None:
            self._writer.close()
        db.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _connection(self) -> sqlite3.Connection:
        if self._db is None:
            raise JournalError(f"journal {self.path} is closed; open it again with Journal.open")
        return self._db

    def _writable(self) -> Writer:
        self._connection()
        if self._writer is None:
            raise JournalError(
                f"journal {self.path} was opened for reading; open it with append=True to write"
            )
        return self._writer
