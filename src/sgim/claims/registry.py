"""The chapters whose claims are declared."""

from __future__ import annotations

from sgim.claims.claim import Chapter
from sgim.claims.fishing import FISHING
from sgim.claims.hockey import HOCKEY
from sgim.claims.objects import OBJECTS
from sgim.claims.throwing import THROWING
from sgim.claims.vocal import VOCAL
from sgim.errors import unknown

CHAPTERS = {chapter.name: chapter for chapter in (OBJECTS, THROWING, HOCKEY, FISHING, VOCAL)}


def chapter(name: str) -> Chapter:
    """The chapter of this name.

    Raises:
        UnknownNameError: If there is none; the message has the nearest name.
    """
    if name not in CHAPTERS:
        raise unknown("chapter of claims", name, CHAPTERS)
    return CHAPTERS[name]
