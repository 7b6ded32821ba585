"""What becomes of the runs of a sweep, noted in a folder that all who make runs can reach."""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

Status = Literal["finished", "known", "interrupted", "failed"]

_BEGUN, _ENDED = ".begun", ".ended"


@dataclass(frozen=True)
class Ending:
    """How an attempt at a run ended.

    Attributes:
        status: ``finished``; ``known`` if it was finished before; ``interrupted``; ``failed``.
        attempt: Which attempt it was, from 1.
        error: The traceback of what failed; empty otherwise.
    """

    status: Status
    attempt: int
    error: str = ""


class Notes:
    """Notes of one sweep: attempts begun, and how they ended; one file each, whole or absent.

    A worker that dies leaves an attempt begun and not ended, so that whoever reads along knows
    which runs died with it.

    Args:
        folder: Where; made when something is noted.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def attempts(self, name: str) -> int:
        """How often a run was begun."""
        try:
            return int((self.folder / f"{name}{_BEGUN}").read_text())
        except FileNotFoundError:
            return 0

    def begin(self, name: str) -> int:
        """Note an attempt; which one it is, from 1."""
        attempt = self.attempts(name) + 1
        self._write(f"{name}{_BEGUN}", str(attempt))
        return attempt

    def end(self, name: str, ending: Ending) -> None:
        """Note how an attempt ended."""
        self._write(f"{name}{_ENDED}", json.dumps(asdict(ending)))

    def forget(self, names: Iterable[str]) -> None:
        """Forget how the last attempts ended, before the next ones."""
        for name in names:
            (self.folder / f"{name}{_ENDED}").unlink(missing_ok=True)

    def ended(self) -> list[str]:
        """Names of the runs whose last attempt has ended."""
        if not self.folder.is_dir():
            return []
        return [n.removesuffix(_ENDED) for n in os.listdir(self.folder) if n.endswith(_ENDED)]

    def ending(self, name: str) -> Ending | None:
        """How the last attempt ended; None if it has not."""
        try:
            return Ending(**json.loads((self.folder / f"{name}{_ENDED}").read_text()))
        except FileNotFoundError:
            return None

    def _write(self, name: str, text: str) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        part = self.folder / f"{uuid.uuid4().hex}.part"
        part.write_text(text)
        os.replace(part, self.folder / name)
