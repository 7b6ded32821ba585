"""The middle level's interface: where in the goal space there is something to learn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from sgim.frozen import frozen
from sgim.records import Demonstration, Goal
from sgim.spaces import Choices


@frozen
class EpisodeReport:
    """What an episode came to.

    Attributes:
        episode: Number of the episode.
        mode: Name of the sampling mode it is credited to.
        chosen: The goal chosen at its start.
        pursued: The goal pursued; differs from the one chosen in emulation.
        context: The context in which the goal was chosen, or None.
        before: Competence for the goal pursued when it was taken up.
        after: The better of ``before`` and what the episode's own trials showed; parallel
            episodes thus do not credit each other.
        movements: Trials executed in the episode, at least 1.
        demonstration: What the teacher showed, in episodes that asked.
    """

    episode: int
    mode: str
    chosen: Goal
    pursued: Goal
    context: Any
    before: float
    after: float
    movements: int
    demonstration: Demonstration | None = None


class InterestMap(Protocol):
    """Learns from episodes which goals, and which modes for them, bring progress."""

    def update(self, report: EpisodeReport) -> None:
        """Take an episode's report into account."""
        ...

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Choose a goal for the present context, and one of ``modes`` to learn it by."""
        ...


def choose_goals(
    interest: InterestMap,
    rngs: Sequence[np.random.Generator],
    modes: Sequence[str],
    contexts: Sequence[Any],
) -> list[tuple[Goal, str]]:
    """`InterestMap.choose` for several episodes: by the map's ``choose_all`` if it has one."""
    together = getattr(interest, "choose_all", None)
    if together is None:
        pairs = zip(rngs, contexts, strict=True)
        return [interest.choose(rng, modes, context) for rng, context in pairs]
    chosen: list[tuple[Goal, str]] = together(rngs, modes, contexts)
    return chosen


class UniformGoals:
    """Every kind, goal and mode alike: no interest at all.

    Args:
        spaces: Kind → goal space.
    """

    def __init__(self, spaces: dict[str, Any]) -> None:
        self.spaces = spaces

    def update(self, report: EpisodeReport) -> None:
        """Nothing is learned."""

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Draw a kind, a goal of it, and a mode."""
        kinds = list(self.spaces)
        kind = kinds[int(rng.integers(len(kinds)))] if len(kinds) > 1 else kinds[0]
        mode = modes[int(rng.integers(len(modes)))] if len(modes) > 1 else modes[0]
        return Goal(kind, self.spaces[kind].sample(rng)), mode


class Favourite:
    """The first of the labels in half of the episodes, else any; every mode alike.

    Args:
        kind: The goal kind.
        labels: Its space.
    """

    def __init__(self, kind: str, labels: Choices) -> None:
        self.kind = kind
        self.labels = labels

    def update(self, report: EpisodeReport) -> None:
        """Nothing is learned."""

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Draw a label and a mode."""
        label = self.labels.labels[0] if rng.random() < 0.5 else self.labels.sample(rng)
        return Goal(self.kind, label), modes[int(rng.integers(len(modes)))]
