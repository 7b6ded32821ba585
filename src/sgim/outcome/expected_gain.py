"""Where, and by which mode, an attempt is expected to gain most."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sgim.outcome.gain_table import GainTable
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.partition import BoolArray, Partition, Region
from sgim.records import Goal
from sgim.spaces import FloatArray, Space
from sgim.streams import Streams

IntArray = NDArray[np.int64]

_BELOW_1 = 1.0 - 1e-12

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

    Where outcomes are noisy, what an attempt gains is soon less than noise, and the edge of what
    can be reached, where luck goes on being rewarded, would get all attempts. So the first of the
    few goals is drawn uniformly then, and taken at once if less is lacking there than noise hides.

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
        hidden: How much must be lacking for a goal of a kind, in [0, 1], for noise not to hide what
            is gained: 0 where there is none. None if there never is; not used if ``goals`` is 1.

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
        hidden: Callable[[str], float] | None = None,
    ) -> None:
        super().__init__(goal_spaces, streams, context_space=context_space, candidates=candidates)
        self.modes = {name: i for i, name in enumerate(modes)}
        self.costs = np.array(list(modes.values()), dtype=np.float64)
        self.lacks = lacks
        self.hidden = hidden
        self.capacity = capacity
        self.window = window
        self.prior = prior
        self.confidence = confidence
        self.uniform = uniform
        self.goals = goals
        self._names = tuple(modes)
        self._kinds = tuple(self.spaces)
        dimension = max(box.dimension for box in self.spaces.values())
        self._draws = 2 + dimension
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
        region.records.append(Attempt(place, found, share, mode))
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

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Choose the most promising of a few goals, each drawn with one of ``modes``."""
        return self.choose_all([rng], modes, [context])[0]

    def choose_all(
        self, rngs: Sequence[np.random.Generator], modes: Sequence[str], contexts: Sequence[Any]
    ) -> list[tuple[Goal, str]]:
        """As `choose` for several episodes."""
        offered = np.array([self.modes[mode] for mode in modes])
        if self.context_space is None:
            return self._chosen(rngs, offered, None)
        pairs = zip(rngs, contexts, strict=True)
        return [self._chosen([rng], offered, context)[0] for rng, context in pairs]

    def _chosen(
        self, rngs: Sequence[np.random.Generator], offered: IntArray, context: Any
    ) -> list[tuple[Goal, str]]:
        """Draw a few goals for each generator, and take the best of each few."""
        numbers = np.array([rng.random((self.goals, self._draws)) for rng in rngs])
        hidden = [0.0] * len(self._kinds)
        if self.hidden is not None and self.goals > 1:
            hidden = [self.hidden(kind) for kind in self._kinds]
        if any(hidden):
            numbers[:, 0, 0] *= self.uniform  # by the rule that draws uniformly
        rows, places, picks = self._drawn(numbers.reshape(-1, self._draws), offered, context)
        modes = self._modes_drawn(rows, offered, picks)
        kinds = self._table.kind[rows].tolist()
        chosen = self._best(rows, places, modes, kinds, context, hidden)
        named: list[tuple[Goal, str]] = []
        for i, mode in zip(chosen, modes[chosen].tolist(), strict=True):
            kind = self._kinds[kinds[i]]
            space = self.spaces[kind]
            point = space.decode(places[i, : space.dimension])
            named.append((Goal(kind, point), self._names[mode]))
        return named

    def _drawn(
        self, numbers: FloatArray, offered: IntArray, context: Any
    ) -> tuple[IntArray, FloatArray, FloatArray]:
        """Regions, places in them, and what is left of the draw of each, for the mode."""
        table, (rules, picks, shares) = self._table, (numbers[:, 0], numbers[:, 1], numbers[:, 2:])
        leaves: IntArray | None = None
        if self.context_space is None and len(offered) == len(self.modes):
            totals = table.totals[: len(self.leaves)]
        else:
            leaves = np.array(self.present(context))
            totals = table.weights[np.ix_(leaves, offered)].sum(axis=1)
        cumulated = totals.cumsum()
        if cumulated[-1] > 0:
            wanted = picks * cumulated[-1]
            rows = np.minimum(cumulated.searchsorted(wanted, "right"), len(totals) - 1)
            left = (cumulated[rows] - wanted) / np.maximum(totals[rows], 1e-300)
            left = np.minimum(left, _BELOW_1)
        else:  # nothing is expected anywhere
            rows, left = (picks * len(totals)).astype(np.int64), rules.copy()
        if leaves is not None:
            rows = leaves[rows]
        lows = table.low[rows]
        places = lows + shares * (table.high[rows] - lows)
        for i, rule in enumerate(rules.tolist()):
            if rule < self.uniform:
                kind = self._kinds[int(picks[i] * len(self._kinds))]
                place = shares[i, : self.spaces[kind].dimension].tolist()
                rows[i], places[i] = self._around(kind, place, context).leaf, shares[i]
                left[i] = rule / self.uniform
        return rows, places, left

    def _modes_drawn(self, rows: IntArray, offered: IntArray, picks: FloatArray) -> IntArray:
        """One of the modes offered for each region, by their weights there."""
        weights = self._table.weights[rows]
        if len(offered) < len(self.modes):
            weights = weights[:, offered]
        cumulated = weights.cumsum(axis=1)
        totals = cumulated[:, -1]
        places = (cumulated <= (picks * totals)[:, None]).sum(axis=1)
        if not totals.all():  # nothing is expected of any
            places = np.where(totals > 0, places, (picks * len(offered)).astype(np.int64))
        modes: IntArray = offered[np.minimum(places, len(offered) - 1)]
        return modes

    def _around(self, kind: str, place: list[float], context: Any) -> Region:
        if self.context_space is None:
            return self.region_of(kind, place)
        here = np.clip(self.context_space.encode(context), 0.0, 1.0).tolist()
        return self.region_of(kind, [*place, *here])

    def _best(
        self,
        rows: IntArray,
        places: FloatArray,
        modes: IntArray,
        kinds: list[int],
        context: Any,
        hidden: Sequence[float],
    ) -> list[int]:
        """Which of each few goals has the largest expected gain, by what is lacking there now.

        Or the first of them, if noise hides what is lacking there.
        """
        if self.goals == 1:
            return list(range(len(rows)))
        gains = self._table.shares[rows, modes] / self.costs[modes]
        for kind in dict.fromkeys(kinds):
            members = [i for i, other in enumerate(kinds) if other == kind]
            name = self._kinds[kind]
            goals = places[members, : self.spaces[name].dimension]
            lacks = self.lacks(name, goals, context)
            gains[members] *= lacks
            first = np.array(members) % self.goals == 0
            gains[np.array(members)[first & (lacks < hidden[kind])]] = np.inf
        best = gains.reshape(-1, self.goals).argmax(axis=1).tolist()
        return [self.goals * i + place for i, place in enumerate(best)]


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
