"""What is read from a journal's file: its header, its task, its rows."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Collection, Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

from sgim.errors import JournalError, SgimError
from sgim.runs.decoders import Stored
from sgim.runs.journal_errors import explain
from sgim.runs.journal_file import open_file
from sgim.runs.rows import COLUMNS, to_json
from sgim.task import Task, task_from_description

PAGE = 8192
"""Rows read at once, so that no read lasts long enough to hold up the writer."""


def read_header(db: sqlite3.Connection, path: Path) -> dict[str, Any]:
    """The header of a journal.

    Raises:
        JournalError: If it cannot be read.
    """
    try:
        return {key: json.loads(text) for key, text in db.execute("SELECT key, value FROM header")}
    except sqlite3.Error as error:
        raise explain(path, error) from error
    except (TypeError, ValueError) as error:
        raise JournalError(
            f"the header of journal {path} is not JSON ({error}): it was changed by hand; "
            "take a copy of the journal from elsewhere"
        ) from error


def header_of(path: str | Path) -> dict[str, Any]:
    """The header of a journal that is not open, for which its task need not be known.

    Raises:
        JournalError: If it is not a journal, or cannot be read.
    """
    path = Path(path)
    with closing(open_file(path, append=False, durable=False)) as db:
        return read_header(db, path)


def recorded_task(header: Mapping[str, Any], path: Path, task: Task | None) -> Task:
    """The task of a journal: the one given, if it is the same, or one made from the header.

    Raises:
        JournalError: If the given one differs, or none is given and it cannot be made.
    """
    recorded = header.get("task")
    if task is None:
        try:
            return task_from_description(recorded or {})
        except (AttributeError, KeyError, TypeError, SgimError) as error:
            raise JournalError(
                f"the task of journal {path} cannot be made from the journal alone ({error}); "
                "pass it: Journal.open(path, task, …)"
            ) from error
    given = json.loads(to_json(task.describe()))
    if difference := first_difference(recorded, given):
        raise JournalError(
            f"journal {path} is of another task: {difference}; pass the task it was recorded "
            "with, or start a new journal"
        )
    return task


def first_difference(recorded: Any, given: Any, where: str = "") -> str | None:
    """Where two JSON values first differ, in words; None if they are equal."""
    if isinstance(recorded, dict) and isinstance(given, dict):
        for key in [*recorded, *(key for key in given if key not in recorded)]:
            place = f"{where}.{key}" if where else key
            if key not in given:
                return f"{place} is recorded, but not here"
            if key not in recorded:
                return f"{place} is here, but not recorded"
            if difference := first_difference(recorded[key], given[key], place):
                return difference
        return None
    if isinstance(recorded, list) and isinstance(given, list) and len(recorded) == len(given):
        for index, (one, other) in enumerate(zip(recorded, given, strict=True)):
            if difference := first_difference(one, other, f"{where}[{index}]"):
                return difference
        return None
    if recorded == given:
        return None
    return f"{where or 'it'} is {recorded!r:.100} as recorded and {given!r:.100} here"


def read_rows(
    db: sqlite3.Connection, path: Path, after: int, names: Collection[str] | None
) -> Iterator[Stored]:
    """Rows ``(seq, *columns)`` in order, page by page.

    Args:
        db: A connection to the journal.
        path: Its file.
        after: The ``seq`` to begin behind.
        names: The names of the rows wanted; None for all.

    Raises:
        JournalError: If the file is damaged, or rows are missing.
    """
    chosen = "" if names is None else f" AND event IN ({', '.join('?' * len(names))})"
    statement = (
        f"SELECT seq, {', '.join(COLUMNS)} FROM events "
        f"WHERE seq > ?{chosen} ORDER BY seq LIMIT {PAGE}"
    )
    while True:
        try:
            rows = db.execute(statement, (after, *(names or ()))).fetchall()
        except sqlite3.Error as error:
            raise explain(path, error) from error
        if not rows:
            return
        last = rows[-1][0]
        if names is None and last - after != len(rows):
            raise JournalError(
                f"journal {path} lacks {last - after - len(rows)} rows between {after + 1} and "
                f"{last}: they were deleted; take a copy of the journal from elsewhere"
            )
        yield from rows
        after = last


def read_columns(
    db: sqlite3.Connection, path: Path, event: str, columns: Collection[str]
) -> list[tuple[Any, ...]]:
    """These columns of all rows of one name, in order; the columns must be ones of the table.

    Raises:
        JournalError: If the file is damaged.
    """
    statement = f"SELECT {', '.join(columns)} FROM events WHERE event = ? ORDER BY seq"
    try:
        return db.execute(statement, (event,)).fetchall()
    except sqlite3.Error as error:
        raise explain(path, error) from error
