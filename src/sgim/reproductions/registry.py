"""The chapters that can be made again."""

from __future__ import annotations

from sgim.errors import unknown
from sgim.reproductions import fishing, hockey, objects, throwing, vocal
from sgim.reproductions.declaration import Reproduction

REPRODUCTIONS = {
    one.name: one
    for one in (
        objects.REPRODUCTION,
        fishing.REPRODUCTION,
        throwing.REPRODUCTION,
        hockey.REPRODUCTION,
        vocal.REPRODUCTION,
    )
}


def reproduction(name: str) -> Reproduction:
    """The chapter of this name.

    Raises:
        UnknownNameError: If there is none; the message has those that there are.
    """
    if name not in REPRODUCTIONS:
        raise unknown("chapter to reproduce", name, REPRODUCTIONS)
    return REPRODUCTIONS[name]
