"""Where, and by which mode, an attempt is expected to gain most."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.outcome.attempted_regions import AttemptedRegions
from sgim.outcome.partition import Region
from sgim.outcome.within_reach import WithinReach
from sgim.records import Goal
from sgim.spaces import FloatArray, Space
from sgim.streams import Streams

IntArray = NDArray[np.int64]

_BELOW_1 = 1.0 - 1e-12

Lacks = Callable[[str, FloatArray, Any], FloatArray]
"""What is lacking now, in [0, 1], for goals of a kind in a context: minus the competence.

The goals are scaled to the unit box, shape ``(m, d)``.
"""


class ExpectedGain(AttemptedRegions):
    """Interest as the gain that a movement is expected to bring, here and now.

    The gain expected in a region by a mode is what attempts there have lately found lacking,
    times the share of it that a movement of this mode removes, divided by the mode's cost. What
    is lacking falls as the learner learns; the share says how good a mode is there, early and
    late alike, so that modes can be compared that were tried at different times.
    It is 0 where nothing can be learned: out of reach, or from a teacher who does not help.

    Goals are chosen so that the *density* of goals follows the expected gain: a region's weight
    is its gain times its volume. Of a few goals drawn so, the one with the largest expected gain
    is taken, by what is lacking at that very goal now. With equal gains everywhere this is
    random goal babbling; it moves away from that where there is nothing to gain, and to the gaps.

    Where outcomes are noisy, gains are mostly luck, and the edge of what can be reached, where luck
    goes on being rewarded, would get most attempts. There goals are drawn `WithinReach` instead,
    evenly of all kinds, and only the mode follows the gain expected.

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
        noisy: How goals are drawn of kinds whose outcomes may be noisy; None to heed no noise.

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
        noisy: WithinReach | None = None,
    ) -> None:
        super().__init__(
            goal_spaces,
            modes,
            streams,
            context_space=context_space,
            capacity=capacity,
            candidates=candidates,
            window=window,
            kind_window=kind_window,
            prior=prior,
            confidence=confidence,
            sharpness=sharpness,
        )
        self.lacks = lacks
        self.noisy = noisy
        self.uniform = uniform
        self.goals = goals
        self._names = tuple(modes)
        self._draws = 2 + self._table.low.shape[1]

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
        """Choose by gain; if some kinds may be noisy, draw one of all, and of the rest by gain."""
        lucks = self._lucks()
        if not lucks:
            return self._by_gain(rngs, offered, context, self._kinds)
        rest = [kind for kind in self._kinds if kind not in lucks]
        drawn = [self._kinds[int(rng.random() * len(self._kinds))] for rng in rngs]
        chosen: dict[int, tuple[Goal, str]] = {}
        for kind in dict.fromkeys(drawn):
            members = [i for i, other in enumerate(drawn) if other == kind]
            some = [rngs[i] for i in members]
            if kind in lucks:
                goals = self._within_reach(some, offered, context, kind, lucks[kind])
            else:
                goals = self._by_gain(some, offered, context, rest)
            chosen.update(zip(members, goals, strict=True))
        return [chosen[i] for i in range(len(rngs))]

    def _lucks(self) -> dict[str, float]:
        """How much an attempt may gain by luck, of kinds whose goals are drawn within reach."""
        if self.noisy is None:
            return {}
        lucks = {kind: self.noisy.luck(kind, box.dimension) for kind, box in self.spaces.items()}
        return {kind: luck for kind, luck in lucks.items() if luck is not None}

    def _within_reach(
        self,
        rngs: Sequence[np.random.Generator],
        offered: IntArray,
        context: Any,
        kind: str,
        luck: float,
    ) -> list[tuple[Goal, str]]:
        """Draw goals of a noisy kind, and modes for them by their expected gain."""
        assert self.noisy is not None

        def promise(place: FloatArray) -> float:
            return self.chance_of_success(self._around(kind, place.tolist(), context), luck)

        places = self.noisy.draw(rngs, kind, self.spaces[kind].dimension, context, promise)
        rows = np.array([self._around(kind, place, context).leaf for place in places.tolist()])
        modes = self._modes_drawn(rows, offered, np.array([rng.random() for rng in rngs]))
        return self._named([self._kinds.index(kind)] * len(rngs), places, modes)

    def _by_gain(
        self,
        rngs: Sequence[np.random.Generator],
        offered: IntArray,
        context: Any,
        kinds: Sequence[str],
    ) -> list[tuple[Goal, str]]:
        """Draw a few goals of some kinds for each generator, and take the best of each few."""
        numbers = [rng.random((self.goals, self._draws)) for rng in rngs]
        drawn = np.array(numbers).reshape(-1, self._draws)
        rows, places, picks = self._drawn(drawn, offered, context, kinds)
        modes = self._modes_drawn(rows, offered, picks)
        of_kind = self._table.kind[rows].tolist()
        chosen = self._best(rows, places, modes, of_kind, context)
        return self._named([of_kind[i] for i in chosen], places[chosen], modes[chosen])

    def _named(
        self, kinds: Sequence[int], places: FloatArray, modes: IntArray
    ) -> list[tuple[Goal, str]]:
        """Goals of these kinds at places of the unit box, and modes by their names."""
        named: list[tuple[Goal, str]] = []
        for kind, place, mode in zip(kinds, places, modes.tolist(), strict=True):
            name = self._kinds[kind]
            space = self.spaces[name]
            goal = Goal(name, space.decode(place[: space.dimension]))
            named.append((goal, self._names[mode]))
        return named

    def _drawn(
        self, numbers: FloatArray, offered: IntArray, context: Any, kinds: Sequence[str]
    ) -> tuple[IntArray, FloatArray, FloatArray]:
        """Regions, places in them, and what is left of the draw of each, for the mode."""
        table, (rules, picks, shares) = self._table, (numbers[:, 0], numbers[:, 1], numbers[:, 2:])
        leaves: IntArray | None = None
        all_kinds, all_modes = len(kinds) == len(self._kinds), len(offered) == len(self.modes)
        if self.context_space is None and all_kinds and all_modes:
            totals = table.totals[: len(self.leaves)]
        else:
            present = self.present(context)
            leaves = np.array([row for row in present if self.leaves[row].kind in kinds])
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
                kind = kinds[int(picks[i] * len(kinds))]
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
    ) -> list[int]:
        """Which of each few goals has the largest expected gain, by what is lacking there now."""
        if self.goals == 1:
            return list(range(len(rows)))
        gains = self._table.shares[rows, modes] / self.costs[modes]
        for kind in dict.fromkeys(kinds):
            members = [i for i, other in enumerate(kinds) if other == kind]
            name = self._kinds[kind]
            goals = places[members, : self.spaces[name].dimension]
            gains[members] *= self.lacks(name, goals, context)
        best = gains.reshape(-1, self.goals).argmax(axis=1).tolist()
        return [self.goals * i + place for i, place in enumerate(best)]
