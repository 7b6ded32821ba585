"""What a strategy decides from, and what it decides."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple, Protocol

from sgim.frozen import frozen
from sgim.records import Goal
from sgim.strategy.modes import Mode


class UnderWay(Protocol):
    """An open episode."""

    @property
    def mode(self) -> Mode:
        """Its sampling mode."""
        ...

    @property
    def budget(self) -> int:
        """Most movements in it."""
        ...


@frozen
class Situation:
    """What is known when an episode is opened, beside what episodes have reported.

    Attributes:
        episode: Number of the episode.
        absent: Teachers that cannot be asked now.
        context: The present context, or None.
        under_way: The episodes that are open, oldest first: those of the same batch.
    """

    episode: int
    absent: Collection[str] = ()
    context: Any = None
    under_way: Collection[UnderWay] = ()


class Choice(NamedTuple):
    """How an episode learns.

    Attributes:
        mode: Its sampling mode.
        goal: What it aims at; None for modes without a goal, and where the teacher is to show
            what he thinks fit.
        budget: Most movements in it, if fewer than the mode usually has.
    """

    mode: Mode
    goal: Goal | None
    budget: int | None = None
