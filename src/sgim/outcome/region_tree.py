"""Interest in regions of goals (and contexts) by recent progress, with a list per mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from sgim.outcome.interest import EpisodeReport
from sgim.outcome.partition import Partition, Region
from sgim.outcome.progress import InterestMeasure, Record
from sgim.outcome.weights import BlockSums
from sgim.records import Goal
from sgim.spaces import BoolArray, FloatArray, Space
from sgim.streams import Streams


class RegionTree(Partition):
    """Interest over regions and modes (thesis algorithms 3.1.2 and 4.3.2).

    Every kind starts as one region. A region whose list for one mode exceeds ``capacity`` is
    split where that best separates different interests. A goal and a mode are chosen by one of
    three rules: ``uniform`` over everything, ``interesting``: a (region, mode) pair with
    probability proportional to its interest and a goal anywhere in that region, or
    ``worst_point``: the same, and a goal near the least competent one attempted there.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ, by which interest is divided.
        measure: Turns records into interest.
        streams: Random streams, for the candidate splits.
        context_space: The task's context space if there is one; it must be a `Box`.
        capacity: Most records of one mode in a region (g_max).
        candidates: Random splits to choose among (m).
        probabilities: Of the rules uniform, interesting, worst_point.
        prior: Interest of pairs not yet tried, before division by the cost.
        staleness: Interest, before division by the cost, that a pair regains with age.
        patience: Episodes in which it regains half of that.
        credit: Whether an episode counts where its goal was ``chosen``, or at what it ``pursued``.

    Raises:
        TypeError: If a goal or context space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        measure: InterestMeasure,
        streams: Streams,
        *,
        context_space: Space | None = None,
        capacity: int = 10,
        candidates: int = 20,
        probabilities: tuple[float, float, float] = (0.05, 0.7, 0.25),
        prior: float = 0.3,
        staleness: float = 0.0,
        patience: float = 100.0,
        credit: Literal["chosen", "pursued"] = "pursued",
    ) -> None:
        super().__init__(goal_spaces, streams, context_space=context_space, candidates=candidates)
        self.modes = {name: i for i, name in enumerate(modes)}
        self.costs = np.array(list(modes.values()), dtype=np.float64)
        self.measure = measure
        self.capacity = capacity
        self.probabilities = probabilities
        self.prior = prior
        self.staleness = staleness
        self.patience = patience
        self.credit = credit
        self._interest = np.empty((64, len(self.modes)))
        self._tried = np.empty((64, len(self.modes)))
        self._episode = 0
        self._sums = BlockSums()
        self._draws = 2 + self.contexts + max(box.dimension for box in self.spaces.values())
        self._names = tuple(modes)
        for kind in self.spaces:
            root = self.plant(kind, [[] for _ in self.modes])
            self._reserve()
            self._interest[root.leaf] = prior / self.costs
            self._tried[root.leaf] = 0.0
            self._sums.refresh(self._interest[: len(self.leaves)], root.leaf)

    def _reserve(self) -> None:
        if len(self.leaves) > len(self._interest):
            self._interest = np.concatenate((self._interest, np.empty_like(self._interest)))
            self._tried = np.concatenate((self._tried, np.empty_like(self._tried)))

    def interests(self) -> FloatArray:
        """Interest of every leaf and mode, shape ``(leaves, modes)``, staleness included."""
        n = len(self.leaves)
        interest = self._interest[:n]
        if self.staleness:
            age = self._episode - self._tried[:n]
            return interest + age / (age + self.patience) * (self.staleness / self.costs)
        return interest.copy()

    def update(self, report: EpisodeReport) -> None:
        """Add the episode's progress to its region and mode; split the region if it is full."""
        self._episode = max(self._episode, report.episode + 1)
        mode = self.modes.get(report.mode)
        goal = report.chosen if self.credit == "chosen" else report.pursued
        place = self.place_of(goal, report.context)
        if mode is None or place is None:
            return
        region = self.region_of(goal.kind, place)
        records = region.records[mode]
        records.append(Record(place, self.measure.progress(report), report.after))
        self._interest[region.leaf, mode] = self.measure.interest(records) / self.costs[mode]
        self._tried[region.leaf, mode] = self._episode
        if len(records) > self.capacity and not self._split(region, mode):
            del records[0]
        self._sums.refresh(self._interest[: len(self.leaves)], region.leaf)

    def _split(self, region: Region, mode: int) -> bool:
        records: list[Record] = region.records[mode]

        def gap(below: BoolArray) -> float:
            parts: tuple[list[Record], list[Record]] = [], []
            for record, is_below in zip(records, below.tolist(), strict=True):
                parts[is_below].append(record)
            return abs(self.measure.interest(parts[1]) - self.measure.interest(parts[0]))

        best = self.best_cut(region, records, lambda ways: np.array([gap(w) for w in ways.T]))
        if best is None:
            return False
        axis, cut = best
        lower, upper = self.divide(region, axis, cut)
        self._reserve()
        self._interest[upper.leaf] = self._interest[lower.leaf]
        self._tried[upper.leaf] = self._tried[lower.leaf]
        for i, records in enumerate(region.records):
            for child in (lower, upper):
                above = child is upper
                child.records.append([r for r in records if (r.place[axis] > cut) == above])
                if child.records[i]:
                    interest = self.measure.interest(child.records[i]) / self.costs[i]
                    self._interest[child.leaf, i] = interest
        self._sums.refresh(self._interest[: len(self.leaves)], upper.leaf)
        region.records = []
        return True

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Choose a goal and one of ``modes`` (thesis section 4.3.2.4, eq. 4.4)."""
        rule, pick, *place = rng.random(self._draws).tolist()
        uniform, interesting, _ = self.probabilities
        if rule < uniform:
            kinds = list(self.spaces)
            kind = kinds[int(pick * len(kinds))]
            mode = modes[int(rng.integers(len(modes)))]
            return Goal(kind, self.spaces[kind].sample(rng)), mode
        region, mode = self._pick(pick, modes, context)
        d = self.spaces[region.kind].dimension
        bounds = zip(place, region.low[:d].tolist(), region.high[:d].tolist(), strict=False)
        point = np.array([low + share * (high - low) for share, low, high in bounds])
        if rule >= uniform + interesting:
            point = self._near_worst(region, self.modes[mode], point)
        return Goal(region.kind, self.spaces[region.kind].decode(point)), mode

    def _pick(self, pick: float, modes: Sequence[str], context: Any) -> tuple[Region, str]:
        columns = [self.modes[m] for m in modes]
        if not self.staleness and self.context_space is None and len(columns) == len(self.modes):
            row, column = self._sums.draw(self._interest[: len(self.leaves)], pick)
            return self.leaves[row], self._names[column]
        leaves = self.present(context)
        interest = self.interests()[np.ix_(leaves, columns)]
        cumulated = (interest.ravel() - interest.min()).cumsum()
        total = cumulated[-1]
        if total > 0:
            chosen = int(cumulated.searchsorted(pick * total, "right"))
            chosen = min(chosen, len(cumulated) - 1)
        else:
            chosen = int(pick * len(cumulated))
        row, column = divmod(chosen, len(columns))
        return self.leaves[leaves[row]], modes[column]

    def _near_worst(self, region: Region, mode: int, elsewhere: FloatArray) -> FloatArray:
        """A point of the region a tenth of the way from its worst point to a random one."""
        records = region.records[mode] or [r for records in region.records for r in records]
        if not records:
            return elsewhere
        place = min(records, key=lambda r: r.competence).place
        worst: FloatArray = np.array(place[: len(elsewhere)])
        return worst + 0.1 * (elsewhere - worst)
