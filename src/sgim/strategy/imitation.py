"""Imitating one teacher now and then: at a fixed frequency, or by the ratio of progress.

Both alternate between two modes, imitation and autonomous exploration (chapters 3 and 4.2). What
is demonstrated is the teacher's choice: requests have no goal.
"""

from __future__ import annotations

from collections import deque
from dataclasses import replace

import numpy as np

from sgim.outcome.interest import EpisodeReport, InterestMap
from sgim.strategy.modes import Mode
from sgim.strategy.situation import Choice, Situation
from sgim.strategy.strategy import by_name


class TwoModes:
    """Base of strategies that explore alone, and imitate one teacher when they decide to.

    One interest map learns from both, as if all had been explored alone: a demonstrated outcome
    is a goal like any other (section 3.1.4.2, *Emulate a Goal*).

    Args:
        imitating: Asks the teacher for anything, and imitates that.
        alone: Autonomous exploration.
        interest: The map over the one mode ``alone``, which chooses its goals.
    """

    def __init__(self, imitating: Mode, alone: Mode, interest: InterestMap) -> None:
        self.modes = by_name([imitating, alone])
        self.imitating = imitating
        self.alone = alone
        self.interest = interest

    def explore(
        self, now: Situation, rng: np.random.Generator, budget: int | None = None
    ) -> Choice:
        """Explore alone, for an interesting goal."""
        goal, _ = self.interest.choose(rng, [self.alone.name], now.context)
        return Choice(self.alone, goal, budget)

    def update(self, report: EpisodeReport) -> None:
        """Let the interest map learn from the episode."""
        self.interest.update(replace(report, mode=self.alone.name))


class FixedFrequency(TwoModes):
    """A demonstration every so many movements: SGIM-D (thesis algorithm 3.1.1).

    Movements are counted from the end of one request to the next, those of the imitation
    included. Exploration is cut short where it would overrun the next request; imitation is not.
    The first episode asks. While the teacher declines, every new episode asks again.

    Args:
        imitating: Asks the teacher for anything, and imitates that.
        alone: Autonomous exploration.
        interest: The map over the one mode ``alone``, which chooses its goals.
        every: Movements from one demonstration to the next, M in the thesis. Those count that
            told something: where movements fail, demonstrations are farther apart.
    """

    def __init__(self, imitating: Mode, alone: Mode, interest: InterestMap, every: int) -> None:
        super().__init__(imitating, alone, interest)
        if every < 1:
            raise ValueError(f"a demonstration every {every} movements, expected ≥ 1")
        self.every = every
        self._since = every

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Ask if a demonstration is due, counting on what is under way; else explore alone."""
        since = self._since
        for episode in now.under_way:
            since = episode.budget + (0 if episode.mode is self.imitating else since)
        left = self.every - since
        if left > 0:
            return self.explore(now, rng, left if left < self.alone.budget else None)
        if self.imitating.teacher in now.absent:
            return self.explore(now, rng)
        return Choice(self.imitating, None)

    def update(self, report: EpisodeReport) -> None:
        """Count movements, and let the interest map learn."""
        imitated = report.demonstration is not None and report.mode == self.imitating.name
        self._since = report.movements + (0 if imitated else self._since)
        super().update(report)


class ProgressRatio(TwoModes):
    """Imitates as often as that has lately brought progress: SGIM-IM (algorithm 4.2.2).

    Progress is competence gained per movement, since an imitation and an exploration differ in
    length. The probability of asking is s / (s + a), where a is the mean progress of the last
    episodes alone, and s that of the last imitations, divided by their cost; a mean below 0
    counts as 0.

    Args:
        imitating: Asks the teacher for anything, and imitates that.
        alone: Autonomous exploration.
        interest: The map over the one mode ``alone``, which chooses its goals.
        cost: What progress by imitation is divided by.
        window: How many of the last episodes of each mode count, ns in the thesis.
        initiation: Episodes of each mode until which both are chosen alike, nbMin.
        least: Least probability of either mode; that of asking when neither brings progress.
    """

    def __init__(
        self,
        imitating: Mode,
        alone: Mode,
        interest: InterestMap,
        *,
        cost: float = 100.0,
        window: int = 20,
        initiation: int = 10,
        least: float = 0.1,
    ) -> None:
        super().__init__(imitating, alone, interest)
        self.cost = cost
        self.initiation = initiation
        self.least = least
        self._progress = {name: deque[float](maxlen=window) for name in self.modes}
        self._episodes = dict.fromkeys(self.modes, 0)

    def probability(self) -> float:
        """Of asking for a demonstration now."""
        if min(self._episodes.values()) < max(self.initiation, 1):
            return 0.5
        imitating, alone = (
            max(0.0, sum(recent) / len(recent))
            for recent in (self._progress[m.name] for m in (self.imitating, self.alone))
        )
        imitating /= self.cost
        if imitating == 0.0:
            return self.least
        return min(1.0 - self.least, max(self.least, imitating / (imitating + alone)))

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Ask with the present probability, else explore alone."""
        if rng.random() < self.probability() and self.imitating.teacher not in now.absent:
            return Choice(self.imitating, None)
        return self.explore(now, rng)

    def update(self, report: EpisodeReport) -> None:
        """Note the progress of the episode's mode, and let the interest map learn."""
        progress = (report.after - report.before) / report.movements
        self._progress[report.mode].append(progress)
        self._episodes[report.mode] += 1
        super().update(report)
