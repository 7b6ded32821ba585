"""Fixed schedules of modes: beginning at rest, and the controls that choosing must beat."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sgim.outcome.interest import EpisodeReport, InterestMap
from sgim.strategy.modes import Mode
from sgim.strategy.situation import Choice, Situation
from sgim.strategy.strategy import JointChoice, by_name, choose_all


class RoundRobin:
    """Every mode in turn; only the goal is chosen by interest.

    Args:
        modes: The modes, in their order.
        interest: The map that learns which goals bring progress.
        alone: What is done instead of a mode whose teacher is absent.
    """

    def __init__(self, modes: Sequence[Mode], interest: InterestMap, alone: Mode) -> None:
        self.modes = by_name(modes)
        self.interest = interest
        self.alone = alone
        self._order = tuple(modes)

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """The next mode, and a goal that is interesting to pursue by it."""
        mode = self._order[now.episode % len(self._order)]
        goal, _ = self.interest.choose(rng, [mode.name], now.context)
        return Choice(self.alone if mode.teacher in now.absent else mode, goal)

    def update(self, report: EpisodeReport) -> None:
        """Pass the report to the interest map."""
        self.interest.update(report)


class DemonstrationsFirst:
    """All demonstrations at the start, then autonomous exploration only.

    Every teacher is asked in turn, for goals drawn uniformly.

    Args:
        asking: The modes that ask, one after the other.
        requests: How many of the first episodes ask; one whose teacher is absent does not.
        first: Draws the goals of the requests.
        alone: What follows.
        interest: The map that chooses the goals of what follows, and learns from it alone.
    """

    def __init__(
        self,
        asking: Sequence[Mode],
        requests: int,
        first: InterestMap,
        alone: Mode,
        interest: InterestMap,
    ) -> None:
        self.modes = by_name([*asking, alone])
        self.alone = alone
        self.requests = requests
        self.first = first
        self.interest = interest
        self._asking = tuple(asking)

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Ask the next teacher, or explore alone when all demonstrations have been given."""
        if now.episode < self.requests:
            mode = self._asking[now.episode % len(self._asking)]
            goal, _ = self.first.choose(rng, [mode.name], now.context)
            return Choice(self.alone if mode.teacher in now.absent else mode, goal)
        goal, _ = self.interest.choose(rng, [self.alone.name], now.context)
        return Choice(self.alone, goal)

    def update(self, report: EpisodeReport) -> None:
        """Pass what was explored alone to the interest map."""
        if report.mode == self.alone.name:
            self.interest.update(report)


class RestFirst:
    """A number of policies around the one at rest, then what another strategy chooses.

    Args:
        resting: The mode that tries them, which needs no goal.
        episodes: How many of the first episodes are in it.
        then: What chooses afterwards.
    """

    def __init__(self, resting: Mode, episodes: int, then: JointChoice) -> None:
        self.modes = by_name([*then.modes.values(), resting])
        self.alone = then.alone
        self.interest = then.interest
        self.resting = resting
        self.episodes = episodes
        self.then = then

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """The mode at rest at first, then the other strategy's choice."""
        return self.choose_all([now], [rng])[0]

    def choose_all(
        self, now: Sequence[Situation], rngs: Sequence[np.random.Generator]
    ) -> list[Choice]:
        """As `choose` for several episodes, oldest first."""
        resting = sum(one.episode < self.episodes for one in now)
        choices = [Choice(self.resting, None)] * resting
        if resting < len(now):
            choices += choose_all(self.then, now[resting:], rngs[resting:])
        return choices

    def update(self, report: EpisodeReport) -> None:
        """Pass the report to the other strategy."""
        self.then.update(report)
