"""One writer a journal: a lock that vanishes with the process that holds it."""

from __future__ import annotations

import os
import platform
import weakref
from contextlib import suppress
from pathlib import Path

from sgim.errors import JournalError

try:
    import fcntl
except ImportError:  # Windows: the journal still notices a second writer when it commits
    fcntl = None  # type: ignore[assignment]


class WriterLock:
    """Holds ``PATH.lock`` until it is released or forgotten, or the process ends in whatever way.

    What counts is the lock on that file, not that it exists: one that a killed process left
    behind holds nobody up. Where the system or the file system has no such locks, nothing is held.

    Args:
        path: The journal to lock, resolved.

    Raises:
        JournalError: If a live process holds it, or the file cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self._path = Path(f"{path}.lock")
        self._file: int | None = None
        if fcntl is None:
            return
        while self._file is None:
            try:
                file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
            except OSError as error:
                raise JournalError(
                    f"journal {path} cannot be written to: {self._path.name} cannot be made beside "
                    f"it ({error.strerror}); copy the journal to a directory you can write to, "
                    "or open it with append=False"
                ) from error
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                holder = os.pread(file, 200, 0).decode(errors="replace") or "another process"
                os.close(file)
                raise JournalError(
                    f"journal {path} is being written by {holder}; wait for it to end or stop it, "
                    "or open the journal with append=False to read along"
                ) from None
            except OSError:
                os.close(file)
                return
            if self._is_current(file):
                self._file = file
            else:  # its holder removed it between our opening and locking it
                os.close(file)
        with suppress(OSError):  # a full disk cannot take the note, but the lock holds
            os.ftruncate(self._file, 0)
            os.pwrite(self._file, f"process {os.getpid()} on {platform.node()}".encode(), 0)
        _held.add(self)

    def _is_current(self, file: int) -> bool:
        try:
            return os.path.samestat(os.stat(self._path), os.fstat(file))
        except FileNotFoundError:
            return False

    def release(self) -> None:
        """Let others write, and remove the file."""
        if self._file is not None:
            with suppress(OSError):  # left behind, it does no harm
                self._path.unlink()
            self._forget()

    def __del__(self) -> None:
        self.release()

    def _forget(self) -> None:
        if self._file is not None:
            os.close(self._file)
            self._file = None


_held: weakref.WeakSet[WriterLock] = weakref.WeakSet()


def _forget_all() -> None:
    for lock in _held:
        lock._forget()


if fcntl is not None:
    # A forked worker shares the lock; it must not keep it when it outlives the writer.
    os.register_at_fork(after_in_child=_forget_all)
