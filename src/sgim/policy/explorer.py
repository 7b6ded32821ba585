"""The lower level's interface: which policy to try next in an episode."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from sgim.records import Demonstration, Goal, Trial


class Episode:
    """What an explorer knows of an episode, and where it keeps its state.

    Attributes:
        id: Number of the episode.
        goal: The goal pursued; None for modes without one.
        context: The context of the next trial.
        demonstration: What the teacher showed, in modes that asked.
        rng: The episode's own stream of random numbers.
        before: Competence for the goal when it was taken up; None without a goal.
        best: The better of ``before`` and what the episode's own trials showed.
        gained: Competence gained in contexts before the present one, in which ``before`` and
            ``best`` are measured.
        movements: Trials executed in this episode.
        attempts: Plans resolved in whatever way.
        state: The explorer's own.
    """

    __slots__ = (
        "attempts",
        "before",
        "best",
        "context",
        "demonstration",
        "gained",
        "goal",
        "id",
        "movements",
        "rng",
        "state",
    )

    def __init__(self, id: int, goal: Goal | None, context: Any, rng: np.random.Generator) -> None:  # noqa: A002
        self.id = id
        self.goal = goal
        self.context = context
        self.rng = rng
        self.demonstration: Demonstration | None = None
        self.before: float | None = None
        self.best: float | None = None
        self.gained = 0.0
        self.movements = 0
        self.attempts = 0
        self.state: Any = None


class Explorer(Protocol):
    """Proposes policies for episodes and learns from what they produced.

    An explorer keeps what belongs to an episode in ``episode.state`` and draws random numbers
    from ``episode.rng`` only. It asks the model in `begin`, `moved` and `propose` only: when it
    hears of a trial, the model may know the trials behind it in the same batch already.

    One that has ``begin_all(episodes)`` prepares several at once by that.
    """

    def begin(self, episode: Episode) -> None:
        """Prepare an episode whose goal, context and demonstration are set."""
        ...

    def moved(self, episode: Episode) -> None:
        """Take note that ``episode.context`` has changed since the last trial."""
        ...

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """One policy for each episode, within the bounds of the policy space.

        What is proposed for an episode must not depend on which others are proposed for in the
        same call, to the last bit: a resume may group them otherwise.
        """
        ...

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Take note of a trial of this episode, and of the competence it alone shows."""
        ...

    def refuse(self, episode: Episode) -> None:
        """Take note that the policy proposed last must not be executed."""
        ...

    def finished(self, episode: Episode) -> bool:
        """Whether the episode has nothing left to gain, before its budget is used up."""
        ...


def begin_all(explorer: Explorer, episodes: Sequence[Episode]) -> None:
    """`Explorer.begin` for several episodes: by the explorer's ``begin_all`` if it has one."""
    together = getattr(explorer, "begin_all", None)
    if together is not None:
        together(episodes)
    else:
        for episode in episodes:
            explorer.begin(episode)


def well_reached(episode: Episode, tolerance: float, share: float) -> bool:
    """Whether an episode's goal is reached, and much nearer than it was before.

    Args:
        episode: With a goal.
        tolerance: Cost, in the unit box, within which its goal counts as reached.
        share: Its cost must be at most this share of what it was before.
    """
    assert episode.best is not None
    assert episode.before is not None
    return -episode.best <= min(tolerance, share * -episode.before)
