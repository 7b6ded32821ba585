"""How much news a teacher's next demonstration can still be expected to bring."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from sgim.records import Demonstration
from sgim.spaces import Space


class News:
    """The chance that the next demonstration is one that a mode has not taken in before.

    A demonstration already mimicked, or emulated, has nothing new to tell that mode, and a
    teacher who only repeats himself is not worth asking. The chance is estimated as Good (1953)
    estimates the mass of unseen species: the share of the demonstrations given that were seen
    exactly once, with one imagined new one so that who was never asked counts as all new.

    Args:
        outcome_spaces: Kind → space, by which demonstrations are told apart.
    """

    def __init__(self, outcome_spaces: Mapping[str, Space]) -> None:
        self.spaces = outcome_spaces
        self._seen: dict[str, Counter[tuple[Any, ...]]] = {}
        self._given: Counter[str] = Counter()
        self._once: Counter[str] = Counter()  # of those given, how many were seen just once

    def take_in(self, mode: str, demonstration: Demonstration) -> None:
        """Note that a demonstration was taken in by a mode, which asks always the same teacher."""
        identity = tuple(
            (kind, self.spaces[kind].pack(point)) for kind, point in demonstration.outcome.items()
        )
        seen = self._seen.setdefault(mode, Counter())
        seen[identity] += 1
        self._given[mode] += 1
        self._once[mode] += {1: 1, 2: -1}.get(seen[identity], 0)

    def expected(self, mode: str) -> float:
        """The chance that a mode's next demonstration is new to it, in (0, 1]."""
        return (self._once[mode] + 1) / (self._given[mode] + 1)
