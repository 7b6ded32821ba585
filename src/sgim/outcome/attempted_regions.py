"""Regions of goals, with what attempts there found lacking and gained, by each mode."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from sgim.outcome.gain_table import GainTable
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.partition import Partition, Region
from sgim.spaces import BoolArray, FloatArray, Space
from sgim.streams import Streams


class Attempt(NamedTuple):
    """One episode: its place, what was lacking there, the share gained a movement, its mode.

    And how much nearer it came to the goal there, in all; None if it pursued another.
    """

    place: tuple[float, ...]
    lack: float
    share: float
    mode: int
    nearer: float | None


class AttemptedRegions(Partition):
    """Estimates, for every region and mode, what is lacking and which share a movement removes.

    A share is estimated from a mode's last attempts in the region, and, while these are few, from
    its last ones anywhere for goals of that kind, which start from an optimistic ``prior``. So a
    useless mode is found out after a few attempts in all, not a few in each region.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ, by which gain is divided.
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

    Attributes:
        modes: Mode name → its number.
        costs: Of the modes, by number.

    Raises:
        TypeError: If a goal or context space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        streams: Streams,
        *,
        context_space: Space | None,
        capacity: int,
        candidates: int,
        window: int,
        kind_window: int,
        prior: float,
        confidence: float,
        sharpness: float,
    ) -> None:
        super().__init__(goal_spaces, streams, context_space=context_space, candidates=candidates)
        self.modes = {name: i for i, name in enumerate(modes)}
        self.costs = np.array(list(modes.values()), dtype=np.float64)
        self.capacity = capacity
        self.window = window
        self.prior = prior
        self.confidence = confidence
        self._kinds = tuple(self.spaces)
        dimension = max(box.dimension for box in self.spaces.values())
        self._table = GainTable(self.costs, dimension, confidence, sharpness)
        self._recent = {
            kind: [deque[float](maxlen=kind_window) for _ in modes] for kind in self.spaces
        }
        # The shares of each region's attempts by each mode, oldest first, a row a region.
        self._attempted: list[list[list[float]]] = []
        self._priors = {kind: np.full(len(modes), float(prior)) for kind in self.spaces}
        for kind in self.spaces:
            self._enter(self.plant(kind, []))

    def _enter(self, region: Region) -> None:
        """Note a new region in the table."""
        d, row = self.spaces[region.kind].dimension, region.leaf
        kind = self._kinds.index(region.kind)
        self._table.enter(row, kind, region.low[:d], region.high[:d])
        self._table.expect(row, self._priors[region.kind])
        if row == len(self._attempted):
            self._attempted.append([])
        self._attempted[row] = [[] for _ in self.modes]

    def gains(self) -> FloatArray:
        """The gain expected of a movement in every leaf by every mode, ``(leaves, modes)``."""
        n, table = len(self.leaves), self._table
        gains: FloatArray = table.lack[:n, None] * table.shares[:n] / self.costs
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
        lacking = float(self._table.lack[region.leaf])
        before = min(-report.before, 1.0)  # more, where gains in earlier contexts are added
        kept = _kept_to_its_goal(report)
        usual = lacking if region.records or not kept else before
        lack = max(before, usual)
        gain = report.after - report.before
        share = gain / (lack * report.movements) if lack > 0 else 0.0
        found = before if kept else usual
        region.records.append(Attempt(place, found, share, mode, gain if kept else None))
        recent = self._recent[region.kind][mode]
        recent.append(share)
        self._priors[region.kind][mode] = (sum(recent) + self.confidence * self.prior) / (
            len(recent) + self.confidence
        )
        shares = self._attempted[region.leaf]
        shares[mode].append(share)
        changed = {mode}
        if len(region.records) > self.capacity:
            cut = self.best_cut(region, region.records, partial(_gaps, region.records))
            if cut is not None:
                self._split(region, *cut)
                return
            first = region.records.pop(0).mode
            del shares[first][0]
            changed.add(first)
        self._weigh(region, changed)

    def _split(self, region: Region, axis: int, cut: float) -> None:
        children = self.divide(region, axis, cut)
        for child in children:
            self._enter(child)
        self._table.lack[children[1].leaf] = self._table.lack[children[0].leaf]
        for attempt in region.records:
            child = children[attempt.place[axis] > cut]
            child.records.append(attempt)
            self._attempted[child.leaf][attempt.mode].append(attempt.share)
        region.records = []
        for child in children:
            self._weigh(child, range(len(self.costs)))

    def _weigh(self, region: Region, modes: Iterable[int]) -> None:
        """Estimate what is lacking in a region, and the shares of these modes there."""
        row, table, shares = region.leaf, self._table, self._attempted[region.leaf]
        lately = region.records[-self.window :]
        if lately:
            table.lack[row] = sum([attempt.lack for attempt in lately]) / len(lately)
        for mode in modes:
            table.note(row, mode, shares[mode][-self.window :])
        table.expect(row, self._priors[region.kind])

    def chance_of_success(self, region: Region, least: float) -> float:
        """How likely an attempt in a region is to come nearer by more than so much.

        It is told by the last ones there that pursued their goal, as (successes + 1/2)/(attempts +
        1) (R. E. Krichevsky and V. K. Trofimov, "The performance of universal encoding", IEEE
        Transactions on Information Theory 27, 1981).
        """
        lately: list[Attempt] = region.records[-self.window :]
        nearer = [attempt.nearer for attempt in lately if attempt.nearer is not None]
        return (sum([came > least for came in nearer]) + 0.5) / (len(nearer) + 1)


def _gaps(attempts: Sequence[Attempt], below: BoolArray) -> FloatArray:
    """How far apart the mean gains of two parts of the attempts are, for several ways to part."""
    gains = np.array([attempt.lack * attempt.share for attempt in attempts])[:, None]
    counts = below.sum(axis=0)
    lower, upper = np.where(below, gains, 0.0).sum(axis=0), np.where(below, 0.0, gains).sum(axis=0)
    gaps: FloatArray = np.abs(lower / counts - upper / (len(attempts) - counts))
    return gaps


def _kept_to_its_goal(report: EpisodeReport) -> bool:
    """Whether the goal chosen was the one pursued; not so in emulation."""
    chosen, pursued = report.chosen, report.pursued
    if pursued is chosen:
        return True
    return pursued.kind == chosen.kind and np.array_equal(pursued.point, chosen.point)
