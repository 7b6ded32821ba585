"""The upper level, meta-learning: which sampling mode, which teacher, for which goal.

Choosing mode and goal together (SGIM-ACTS) and always the same mode (SAGG-RIAC, random
policies, one teacher) are here; fixed schedules, and imitation now and then (SGIM-D, SGIM-IM),
have files of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from sgim.errors import unknown
from sgim.outcome.interest import EpisodeReport, InterestMap, choose_goals
from sgim.records import Demonstration
from sgim.strategy.modes import Mode
from sgim.strategy.news import News
from sgim.strategy.situation import Choice, Situation


class Strategy(Protocol):
    """Chooses how each episode learns.

    Attributes:
        modes: The modes to choose among, by name.
        alone: What an episode falls back to when its request is not answered.
    """

    modes: dict[str, Mode]
    alone: Mode

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Choose how an episode learns.

        Args:
            now: Its number, who is absent, the context, and what is under way.
            rng: Its own generator.

        Returns:
            A mode whose teacher is not absent, a goal for the context, if the mode has one, and
            a limit to its movements, if they are to be fewer than usual.
        """
        ...

    def update(self, report: EpisodeReport) -> None:
        """Learn from an episode.

        What a strategy keeps may change here only, so that it is a fold over the record.
        """
        ...


def chooses_together(strategy: Strategy) -> bool:
    """Whether it has ``choose_all(situations, rngs)``, to choose for a whole batch at once.

    Such a strategy must not look at what is under way, which it would choose itself.
    """
    return hasattr(strategy, "choose_all")


def choose_all(
    strategy: Strategy, now: Sequence[Situation], rngs: Sequence[np.random.Generator]
) -> list[Choice]:
    """`Strategy.choose` for several episodes of one moment, at once if the strategy can.

    Args:
        strategy: The strategy.
        now: Their situations; the same teachers are absent in all of them.
        rngs: Each one's own generator.
    """
    together = getattr(strategy, "choose_all", None)
    if together is None:
        return [strategy.choose(*pair) for pair in zip(now, rngs, strict=True)]
    choices: list[Choice] = together(now, rngs)
    return choices


def by_name(modes: Sequence[Mode]) -> dict[str, Mode]:
    """Modes by their names, which must differ."""
    named = {mode.name: mode for mode in modes}
    if len(named) < len(modes) or not modes:
        raise ValueError(f"modes need different names, got {[m.name for m in modes]}")
    return named


def mode_named(strategy: Strategy, name: str) -> Mode:
    """The strategy's mode of this name; `UnknownNameError` if there is none."""
    if name == strategy.alone.name:
        return strategy.modes.get(name, strategy.alone)
    mode = strategy.modes.get(name)
    if mode is None:
        raise unknown("mode", name, [*strategy.modes, strategy.alone.name])
    return mode


def mode_for(strategy: Strategy, demonstration: Demonstration) -> Mode:
    """How to learn from an unasked demonstration: as from its teacher, mimicry first."""
    modes = [m for m in strategy.modes.values() if m.teacher == demonstration.teacher]
    usable = [m for m in modes if m.needs_policy and demonstration.policy is not None]
    usable += [m for m in modes if not m.needs_policy]
    return usable[0] if usable else strategy.alone


class JointChoice:
    """Chooses mode and goal at once by interest (thesis section 4.3.2.4).

    With a single mode this is goal babbling driven by interest: SAGG-RIAC if that mode is
    autonomous exploration.

    Args:
        modes: The modes to choose among.
        interest: The map that learns which goals and modes bring progress.
        alone: What an episode falls back to when its request is not answered, and what is done
            while every teacher is absent; it need not be among ``modes``.
        news: Estimates what a request can still bring; a request is given up for ``alone``
            unless it is expected to bring news. None to ask whenever the map says so.
    """

    def __init__(
        self,
        modes: Sequence[Mode],
        interest: InterestMap,
        alone: Mode,
        news: News | None = None,
    ) -> None:
        self.modes = by_name(modes)
        self.interest = interest
        self.alone = alone
        self.news = news

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """Let the interest map choose among the modes that are possible now."""
        return self.choose_all([now], [rng])[0]

    def choose_all(
        self, now: Sequence[Situation], rngs: Sequence[np.random.Generator]
    ) -> list[Choice]:
        """As `choose` for several episodes."""
        present = [m.name for m in self.modes.values() if m.teacher not in now[0].absent]
        modes = present or list(self.modes)
        chosen = choose_goals(self.interest, rngs, modes, [one.context for one in now])
        choices = []
        for rng, (goal, name) in zip(rngs, chosen, strict=True):
            mode = self.modes[name] if present else self.alone
            if self.news is not None and mode.teacher is not None:
                mode = mode if rng.random() < self.news.expected(name) else self.alone
            choices.append(Choice(mode, goal))
        return choices

    def update(self, report: EpisodeReport) -> None:
        """Pass the report to the interest map; take in what was demonstrated."""
        self.interest.update(report)
        if self.news is not None and report.demonstration is not None:
            self.news.take_in(report.mode, report.demonstration)


class Aimless:
    """Always one mode that needs no goal.

    Args:
        mode: The mode.
    """

    def __init__(self, mode: Mode) -> None:
        self.modes = {mode.name: mode}
        self.alone = mode

    def choose(self, now: Situation, rng: np.random.Generator) -> Choice:
        """The mode, and no goal."""
        return Choice(self.alone, None)

    def choose_all(
        self, now: Sequence[Situation], rngs: Sequence[np.random.Generator]
    ) -> list[Choice]:
        """As `choose` for several episodes."""
        return [Choice(self.alone, None)] * len(now)

    def update(self, report: EpisodeReport) -> None:
        """Nothing is learned."""
