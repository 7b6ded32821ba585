"""The errors of a journal's file: what was found, and what to do."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from sgim.errors import JournalError, UnwrittenError


def exists(path: Path) -> JournalError:
    """The error for a journal that is to be made and is already there."""
    return JournalError(
        f"{path} exists already, and a journal is never overwritten; go on with it "
        f"(`sgim resume {path}`), or choose another path"
    )


def damaged(path: Path, fault: str) -> JournalError:
    """The error for a journal that SQLite can no longer read as a whole."""
    return JournalError(
        f"journal {path} is damaged or cut short ({fault}); take a copy of it from elsewhere, or "
        "salvage what is left with the command .recover of the sqlite3 shell"
    )


def unwritten(path: Path, error: sqlite3.Error, events: int) -> UnwrittenError:
    """The error for a commit that failed with ``events`` events waiting."""
    return UnwrittenError(
        f"journal {path}: {error}. {events} {'event is' if events == 1 else 'events are'} not yet "
        f"written and kept in memory: {_advice(error)}, then call commit() again; the next append "
        "tries again too"
    )


def explain(path: Path, error: sqlite3.Error) -> JournalError:
    """The error for whatever else SQLite refuses to do with a journal."""
    code = error_code(error)
    if code == sqlite3.SQLITE_NOTADB:
        return JournalError(f"{path} is not a journal: it is no SQLite file; check the path")
    if code == sqlite3.SQLITE_CORRUPT:
        return damaged(path, str(error))
    return JournalError(f"journal {path}: {error}; {_advice(error)}")


def error_code(error: sqlite3.Error) -> int | None:
    """SQLite's primary result code, such as ``sqlite3.SQLITE_FULL``."""
    code: int | None = getattr(error, "sqlite_errorcode", None)
    return None if code is None else code & 0xFF  # the higher bits tell variants apart


def _advice(error: sqlite3.Error) -> str:
    match error_code(error):
        case sqlite3.SQLITE_FULL:
            return "make space on the disk"
        case sqlite3.SQLITE_READONLY | sqlite3.SQLITE_PERM:
            return "make it and its directory writable, or copy it to where you can write"
        case sqlite3.SQLITE_CANTOPEN:
            return "check the permissions of the file and its directory"
        case sqlite3.SQLITE_BUSY | sqlite3.SQLITE_LOCKED:
            return "close the other program that holds it"
    return "check the disk it is on"
