"""Where, and by which mode, an attempt is expected to gain most."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from sgim.outcome.interest import EpisodeReport
from sgim.outcome.partition import Partition, Region
from sgim.records import Goal
from sgim.spaces import FloatArray, Space
from sgim.streams import Streams

Lacks = Callable[[str, FloatArray, Any], FloatArray]
"""What is lacking now, in [0, 1], for goals of a kind in a context: minus the competence.

The goals are scaled to the unit box, shape ``(m, d)``.
"""


class Attempt(NamedTuple):
    """One episode: its place, what was lacking there, the share gained a movement, its mode."""

    place: tuple[float, ...]
    lack: float
    share: float
    mode: int


class ExpectedGain(Partition):
    """Interest as the gain that a movement is expected to bring, here and now.

    The gain expected in a region by a mode is what attempts there have lately found lacking,
    times the share of it that a movement of this mode removes, divided by the mode's cost. What
    is lacking falls as the learner learns; the share says how good a mode is there, early and
    late alike, so that modes can be compared that were tried at different times.
    It is 0 where nothing can be learned: out of reach, or from a teacher who does not help.

    A share is estimated from a mode's last attempts in the region, and, while these are few, from
    its last ones anywhere for goals of that kind, which start from an optimistic ``prior``. So a
    useless mode is found out after a few attempts in all, not a few in each region.

    Goals are chosen so that the *density* of goals follows the expected gain: a region's weight
    is its gain times its volume. Of a few goals drawn so, the one with the largest expected gain
    is taken, by what is lacking at that very goal now. With equal gains everywhere this is
    random goal babbling; it moves away from that where there is nothing to gain, and to the gaps.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ, by which gain is divided.
        lacks: What is lacking now at given places of the unit box.
        streams: Random streams, for the candidate splits.
        context_space: The task's context space if there is one; it must be a `Box`.
        capacity: Most attempts in a region before it is split.
        candidates: Random splits to choose among.
        window: How many of the last attempts count, for what is lacking and for each share.
        kind_window: How many of a mode's last attempts for a kind of goal count for its prior.
        prior: Share expected of a mode that was never tried.
        confidence: How many attempts a prior is worth.
        sharpness: How much a mode is preferred to others that gain less in the same region; 1
            for proportional choice.
        uniform: Probability to draw a goal of any kind uniformly instead.
        goals: How many goals are drawn to choose among.

    Raises:
        TypeError: If a goal or context space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        lacks: Lacks,
        streams: Streams,
        *,
        context_space: Space | None = None,
        capacity: int = 40,
        candidates: int = 10,
        window: int = 10,
        kind_window: int = 20,
        prior: float = 0.5,
        confidence: float = 2.0,
        sharpness: float = 3.0,
        uniform: float = 0.1,
        goals: int = 3,
    ) -> None:
        super().__init__(goal_spaces, streams, context_space=context_space, candidates=candidates)
        self.modes = {name: i for i, name in enumerate(modes)}
        self.costs = np.array(list(modes.values()), dtype=np.float64)
        self.lacks = lacks
        self.capacity = capacity
        self.window = window
        self.prior = prior
        self.confidence = confidence
        self.sharpness = sharpness
        self.uniform = uniform
        self.goals = goals
        self._names = tuple(modes)
        self._recent = {
            kind: [deque[float](maxlen=kind_window) for _ in modes] for kind in self.spaces
        }
        self._lack = np.ones(64)
        self._shares = np.full((64, len(modes)), prior)
        self._weights = np.zeros((64, len(modes)))
        self._totals = np.zeros(64)
        self._draws = 2 + max(box.dimension for box in self.spaces.values())
        for kind in self.spaces:
            root = self.plant(kind, [])
            self._reserve()
            self._weigh(root)

    def gains(self) -> FloatArray:
        """The gain expected of a movement in every leaf by every mode, ``(leaves, modes)``."""
        n = len(self.leaves)
        gains: FloatArray = self._lack[:n, None] * self._shares[:n] / self.costs
        return gains

    def update(self, report: EpisodeReport) -> None:
        """Learn what an episode found lacking where its goal was chosen, and what it gained.

        A gain counts as a share of what is usually lacking in the region, at least: to come still
        nearer to what is nearly reached gains little, and so does emulating what is mastered.
        Emulation, which pursues another goal, says nothing of what is lacking here.
        """
        mode = self.modes.get(report.mode)
        place = self.place_of(report.chosen, report.context)
        if mode is None or place is None:
            return
        region = self.region_of(report.chosen.kind, place)
        before = min(-report.before, 1.0)  # more, where gains in earlier contexts are added
        kept = _kept_to_its_goal(report)
        usual = float(self._lack[region.leaf]) if region.records or not kept else before
        lack = max(before, usual)
        gain = report.after - report.before
        share = gain / (lack * report.movements) if lack > 0 else 0.0
        found = before if kept else usual
        region.records.append(Attempt(place, found, share, mode))
        self._recent[region.kind][mode].append(share)
        if len(region.records) > self.capacity:
            cut = self.best_cut(region, region.records, _mean_gain)
            if cut is not None:
                self._split(region, *cut)
                return
            del region.records[0]
        self._weigh(region)

    def _split(self, region: Region, axis: int, cut: float) -> None:
        children = self.divide(region, axis, cut)
        self._reserve()
        self._lack[children[1].leaf] = self._lack[children[0].leaf]
        for attempt in region.records:
            children[attempt.place[axis] > cut].records.append(attempt)
        region.records = []
        for child in children:
            self._weigh(child)

    def _shrunk(self, shares: Sequence[float] | deque[float], prior: float) -> float:
        return (sum(shares) + self.confidence * prior) / (len(shares) + self.confidence)

    def _weigh(self, region: Region) -> None:
        """Estimate what is lacking and the modes' shares; weigh the modes by gain and volume."""
        row, recent = region.leaf, self._recent[region.kind]
        lately = region.records[-self.window :]
        if lately:
            self._lack[row] = sum(a.lack for a in lately) / len(lately)
        here: list[list[float]] = [[] for _ in recent]
        for attempt in region.records:
            here[attempt.mode].append(attempt.share)
        shares = self._shares[row]
        for mode, own in enumerate(here):
            prior = self._shrunk(recent[mode], self.prior)
            shares[mode] = self._shrunk(own[-self.window :], prior) if own else prior
        values = np.maximum(shares / self.costs, 0.0)
        best = float(values.max())
        if best > 0:
            values = values * (values / best) ** (self.sharpness - 1)
        d = self.spaces[region.kind].dimension
        volume = math.prod((region.high[:d] - region.low[:d]).tolist())
        self._weights[row] = weights = values * (volume * float(self._lack[row]))
        self._totals[row] = weights.sum()

    def _reserve(self) -> None:
        if len(self.leaves) > len(self._lack):
            self._lack = np.concatenate((self._lack, np.ones_like(self._lack)))
            self._shares = np.concatenate((self._shares, np.empty_like(self._shares)))
            self._weights = np.concatenate((self._weights, np.zeros_like(self._weights)))
            self._totals = np.concatenate((self._totals, np.zeros_like(self._totals)))

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Choose the most promising of a few goals, each drawn with one of ``modes``."""
        offered = [self.modes[mode] for mode in modes]
        everything = len(offered) == len(self.modes)
        leaves = self.present(context)
        if everything and self.context_space is None:
            totals = self._totals[: len(self.leaves)]
        else:
            totals = self._weights[np.ix_(leaves, offered)].sum(axis=1)
        cumulated = totals.cumsum()
        draws = []
        for numbers in rng.random((self.goals, self._draws)).tolist():
            rule, pick, *shares = numbers
            if rule < self.uniform:
                kind = tuple(self.spaces)[int(pick * len(self.spaces))]
                place = shares[: self.spaces[kind].dimension]
                region, pick = self._around(kind, place, context), rule / self.uniform
            else:
                wanted = pick * float(cumulated[-1])
                i = min(int(cumulated.searchsorted(wanted, "right")), len(cumulated) - 1)
                if wanted > 0.0:
                    pick = min((cumulated[i] - wanted) / totals[i], 1.0 - 1e-12)
                else:  # as also where nothing is expected anywhere
                    i, pick = int(pick * len(totals)), rule
                region = self.leaves[leaves[i]]
                corners = zip(shares, region.low.tolist(), region.high.tolist(), strict=False)
                place = [low + share * (high - low) for share, low, high in corners]
                del place[self.spaces[region.kind].dimension :]
            draws.append((region, place, self._mode(region, offered, pick)))
        region, place, mode = draws[self._best(draws, context)] if len(draws) > 1 else draws[0]
        goal = Goal(region.kind, self.spaces[region.kind].decode(np.array(place)))
        return goal, self._names[mode]

    def _mode(self, region: Region, offered: list[int], pick: float) -> int:
        """One of the modes offered, with probability proportional to its weight in the region."""
        if len(offered) == 1:
            return offered[0]
        row = self._weights[region.leaf].tolist()
        left = pick * sum(row[mode] for mode in offered)
        if left == 0.0:  # as also where nothing is expected of any
            return offered[int(pick * len(offered))]
        for mode in offered:
            left -= row[mode]
            if left < 0:
                return mode
        return offered[-1]

    def _around(self, kind: str, place: list[float], context: Any) -> Region:
        if self.context_space is None:
            return self.region_of(kind, place)
        here = np.clip(self.context_space.encode(context), 0.0, 1.0).tolist()
        return self.region_of(kind, [*place, *here])

    def _best(self, draws: list[tuple[Region, list[float], int]], context: Any) -> int:
        """Which of the goals drawn has the largest expected gain, by what is lacking there now."""
        gains = [0.0] * len(draws)
        for kind in dict.fromkeys(region.kind for region, *_ in draws):
            members = [i for i, (region, *_) in enumerate(draws) if region.kind == kind]
            places = np.array([draws[i][1] for i in members])
            for i, lack in zip(members, self.lacks(kind, places, context).tolist(), strict=True):
                region, _, mode = draws[i]
                gains[i] = lack * self._shares[region.leaf, mode] / self.costs[mode]
        return gains.index(max(gains))


def _mean_gain(attempts: Sequence[Attempt]) -> float:
    return sum(a.lack * a.share for a in attempts) / len(attempts)


def _kept_to_its_goal(report: EpisodeReport) -> bool:
    """Whether the goal chosen was the one pursued; not so in emulation."""
    chosen, pursued = report.chosen, report.pursued
    if pursued is chosen:
        return True
    return pursued.kind == chosen.kind and np.array_equal(pursued.point, chosen.point)
