"""How a journal's file is committed: with a write-ahead log where the file system can share one."""

from __future__ import annotations

import os
import sqlite3
import warnings
from contextlib import suppress
from pathlib import Path

NETWORK_FILE_SYSTEMS = frozenset(
    {
        *("9p", "afs", "beegfs", "ceph", "cifs", "fuse.glusterfs", "fuse.sshfs", "glusterfs"),
        *("gpfs", "lustre", "nfs", "nfs4", "smb3", "smbfs"),
    }
)
"""Types of file system on which processes of two machines cannot share a write-ahead log."""

MOUNTS = Path("/proc/self/mounts")
"""Where Linux lists what is mounted."""


LOGS = ("-wal", "-journal")
"""How the names of files end in which SQLite keeps what is not in the main one."""

BESIDE = (*LOGS, "-shm")
"""How the names of all files end that SQLite puts beside the main one."""


def choose_mode(db: sqlite3.Connection, path: Path, *, durable: bool) -> None:
    """Choose SQLite's journal mode and how long a commit waits for the disk.

    Args:
        db: The connection that will append.
        path: The file.
        durable: Whether a commit waits until the disk has it.

    Raises:
        sqlite3.OperationalError: If the file cannot be written to.
    """
    db.execute("BEGIN IMMEDIATE")  # refused by what may not be written to
    db.execute("ROLLBACK")
    network = network_file_system(path)
    wanted = "DELETE" if network else "WAL"
    ((mode,),) = db.execute(f"PRAGMA journal_mode = {wanted}")
    if mode != "wal":
        warnings.warn(
            f"journal {path} is on a file system that cannot share a write-ahead log"
            f"{f' ({network})' if network else ''}: it is written in mode {mode.upper()}, "
            "slower, and whoever reads along may hold it up; prefer a local disk",
            stacklevel=4,
        )
    db.execute(f"PRAGMA synchronous = {'FULL' if durable else 'NORMAL'}")


def network_file_system(path: Path, mounts: Path = MOUNTS) -> str | None:
    """The type of the network file system that holds ``path``, or None; known on Linux only."""
    try:
        lines = mounts.read_text(errors="surrogateescape").splitlines()
    except OSError:
        return None
    resolved = path.resolve()
    found, kind = Path(), ""
    for line in lines:
        _, point, type_, *_ = line.split(" ")
        place = Path(point.replace("\\040", " "))
        # Among mounts on the same place, the last one hides the others.
        if resolved.is_relative_to(place) and len(place.parts) >= len(found.parts):
            found, kind = place, type_
    return kind if kind in NETWORK_FILE_SYSTEMS else None


def log_of(path: Path) -> str | None:
    """Name of the file beside a journal in which some of it still is, or what undoes some."""
    for ending in LOGS:
        with suppress(FileNotFoundError):
            if os.stat(f"{path.resolve()}{ending}").st_size > 0:
                return f"{path.resolve().name}{ending}"
    return None


def finish(db: sqlite3.Connection, path: Path) -> None:
    """Move everything into the main file and close, so that it opens where nobody may write."""
    try:
        db.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()
        db.execute("PRAGMA busy_timeout = 0")
        db.execute("PRAGMA journal_mode = DELETE")
    except sqlite3.OperationalError:
        pass  # a reader is still connected, or the disk is full: all is committed all the same
    db.close()
    if log := log_of(path):
        warnings.warn(
            f"the last events of journal {path} are in {log}: keep both files together "
            "until the journal is opened and closed again",
            stacklevel=3,
        )
