"""The SQLite file of a journal: making, opening, checking and finishing it."""

from __future__ import annotations

import os
import sqlite3
import uuid
from collections.abc import Mapping
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

from sgim.errors import JournalError
from sgim.runs.journal_errors import damaged, error_code, exists, explain
from sgim.runs.journal_mode import BESIDE, choose_mode, log_of
from sgim.runs.rows import SCHEMA, to_json

APPLICATION_ID = 0x5347494D
"""SQLite's mark of the program a file belongs to: ``SGIM`` in ASCII."""

SCHEMA_VERSION = 1
"""Version of the tables; a journal of an earlier one opens for ever."""


def connect(path: Path, options: str) -> sqlite3.Connection:
    """Connect to an existing file, with SQLite's URI options, transactions left to the caller."""
    return sqlite3.connect(
        f"{path.resolve().as_uri()}?{options}",
        uri=True,
        isolation_level=None,
        timeout=10.0,
        check_same_thread=False,
    )


def create_file(path: Path, header: Mapping[str, Any], *, durable: bool) -> sqlite3.Connection:
    """Make a new journal without events, ready for appending.

    It is made under another name, so that a process killed meanwhile leaves no half of a journal
    where one is looked for; the hidden file that may be left then, ``.….new``, is of no use.

    Raises:
        JournalError: If it exists already or cannot be made; nothing is left behind then.
    """
    new = path.with_name(f".{uuid.uuid4().hex}.new")
    try:
        _fill(new, header)
        _put(new, path)
    except FileExistsError:
        raise exists(path) from None
    except OSError as error:
        raise JournalError(
            f"journal {path} cannot be made ({error.strerror}); choose another path"
        ) from error
    except sqlite3.Error as error:
        raise explain(path, error) from error
    finally:
        for ending in ("", "-journal"):
            with suppress(OSError):
                new.with_name(new.name + ending).unlink(missing_ok=True)
    db = None
    try:
        db = connect(path, "mode=rw")
        choose_mode(db, path, durable=durable)
    except BaseException as error:
        if db is not None:
            db.close()
        path.unlink(missing_ok=True)
        if isinstance(error, sqlite3.Error):
            raise explain(path, error) from error
        raise
    return db


def _fill(new: Path, header: Mapping[str, Any]) -> None:
    """Make a file with a journal's tables and header, of a name that nobody else uses."""
    texts = [(key, to_json(value)) for key, value in header.items()]
    os.close(os.open(new, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    with closing(connect(new, "mode=rw")) as db:
        db.execute("BEGIN IMMEDIATE")
        for statement in SCHEMA:
            db.execute(statement)
        db.executemany("INSERT INTO header VALUES (?, ?)", texts)
        db.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        db.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
        db.execute("COMMIT")


def _put(new: Path, path: Path) -> None:
    """Give a finished file its name, at once, and no logs of a journal that was deleted.

    Raises:
        FileExistsError: If there is one of that name.
    """
    if os.path.lexists(path):
        raise FileExistsError
    for ending in BESIDE:
        path.with_name(path.name + ending).unlink(missing_ok=True)
    try:
        os.link(new, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        new.rename(path)


def open_file(path: Path, *, append: bool, durable: bool) -> sqlite3.Connection:
    """Open a journal and check that it is one, of a schema this version knows, and whole.

    Raises:
        JournalError: If it is missing, not a journal, of a newer schema, damaged, or cannot be
            opened as asked.
    """
    if os.path.isdir(path):
        raise JournalError(f"{path} is a directory, expected the file of a journal")
    if not os.path.exists(path):
        raise JournalError(f"there is no journal {path}; check the path, or start a new run there")
    db = None
    try:
        db = connect(path, "mode=rw") if append else _connect_reader(path)
        _check(db, path)
        if append:
            # Reading the whole file once is cheap (0.1 s for 500 000 rows) beside a resume,
            # which replays it; readers meet damage when they come to it.
            faults = [text for (text,) in db.execute("PRAGMA quick_check(1)")]
            if faults != ["ok"]:
                raise damaged(path, " ".join(faults[0].split()))
            choose_mode(db, path, durable=durable)
    except BaseException as error:
        if db is not None:
            db.close()
        if isinstance(error, sqlite3.Error):
            raise explain(path, error) from error
        raise
    return db


def _connect_reader(path: Path) -> sqlite3.Connection:
    db = None
    try:
        db = connect(path, "mode=ro")
        db.execute("SELECT count(*) FROM sqlite_schema").fetchone()
    except sqlite3.OperationalError as error:
        if db is not None:
            db.close()
        if error_code(error) not in (sqlite3.SQLITE_CANTOPEN, sqlite3.SQLITE_READONLY):
            raise
        if not os.access(path, os.R_OK):
            raise
        # SQLite wants files beside one that was not finished and may not make them here. It can
        # do without if all is in the main file.
        if log := log_of(path):
            raise JournalError(
                f"journal {path} was not closed, and {log} cannot be worked in without writing; "
                "where you can write, open it once with append=True (to copy it, copy both files)"
            ) from error
        db = connect(path, "immutable=1")
    return db


def _check(db: sqlite3.Connection, path: Path) -> None:
    ((application,),) = db.execute("PRAGMA application_id")
    ((version,),) = db.execute("PRAGMA user_version")
    if application != APPLICATION_ID:
        if not db.execute("SELECT count(*) FROM sqlite_schema").fetchone()[0]:
            raise JournalError(
                f"{path} is empty: not a journal, or one whose making was interrupted; delete it "
                "and start again"
            )
        raise JournalError(
            f"{path} is an SQLite file but not a journal of sgim (its application_id is "
            f"{application}, expected {APPLICATION_ID}); check the path"
        )
    if version > SCHEMA_VERSION:
        raise JournalError(
            f"journal {path} has schema {version}, and this version of sgim reads up to "
            f"{SCHEMA_VERSION}: a newer one wrote it; upgrade (pip install --upgrade sgim)"
        )
    _check_length(db, path)


def _check_length(db: sqlite3.Connection, path: Path) -> None:
    # SQLite takes what is missing of a last page for zeros, and would make events of them.
    db.execute("BEGIN")
    try:
        ((pages,),) = db.execute("PRAGMA page_count")
        ((bytes_,),) = db.execute("PRAGMA page_size")
        size = path.stat().st_size
        if size < pages * bytes_ and log_of(path) is None:
            raise damaged(path, f"{size} bytes of {pages * bytes_}")
    finally:
        db.execute("ROLLBACK")
