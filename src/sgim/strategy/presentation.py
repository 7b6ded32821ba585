"""A teacher who first presents everything there is to learn, once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sgim.outcome.interest import EpisodeReport
from sgim.records import Goal
from sgim.strategy.modes import Mode
from sgim.strategy.situation import Choice, Situation
from sgim.strategy.strategy import Strategy


class Presentation:
    """The first episodes ask a teacher for one goal after the other; then a strategy chooses.

    While the teacher is absent, the strategy chooses. What the presentation comes to is not
    reported to it.

    Args:
        goals: What is presented.
        by: The mode that asks the teacher.
        then: The strategy that follows; ``by`` is one of its modes.
    """

    def __init__(self, goals: Sequence[Goal], by: Mode, then: Strategy) -> None:
        self.goals = list(goals)
        self.by = by
        self.then = then
        self.modes = then.modes
        self.alone = then.alone

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Ask for the next goal that is presented, or let the strategy choose."""
        if now.episode < len(self.goals) and self.by.teacher not in now.absent:
            return Choice(self.by, self.goals[now.episode])
        return self.then.choose(now, rng)

    def update(self, report: EpisodeReport) -> None:
        """Pass reports to the strategy once everything has been presented."""
        if report.episode >= len(self.goals):
            self.then.update(report)
