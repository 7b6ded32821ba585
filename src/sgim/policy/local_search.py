"""Goal-directed local search: varied steps on a local linear map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.memory.memory import IntArray, KindMemory
from sgim.policy.explorer import Episode, well_reached
from sgim.policy.model import NearestModel
from sgim.policy.near_trials import NearTrials
from sgim.policy.small_systems import solved
from sgim.policy.smoothness import Smoothness
from sgim.records import Goal, Trial
from sgim.spaces import Box, FloatArray

_BLUR = 0.1  # Policies this much nearer than the farthest, squared, weigh alike: noise.
_SPREAD = (0.1, 0.3)  # Least and largest size of a variation that feeds a map, over its length.
_RARE_VARIED, _WIDE = 0.05, 0.1  # Standard deviations of all coordinates, in the unit box.
_REPEATED = 0.05  # Of policies, where it must be told noise from jumps.
_COARSE = 0.01  # From this cost on a goal has its full share of wide variations.
_RARE = 10  # Of so many trials less than one produced what is rare.
_WIDEST = 1.0  # Of the standard deviation of a varied policy's coordinates in the unit box.
_BLOCK = 128  # Episodes whose arrays are stacked at once, so that they stay in a cache.
_SAME = 1e-20  # Of a squared distance between policies in the unit box.


class LocalSearch:
    """Steps on a local linear map, with variations of all sizes.

    Starting from the remembered trials with the outcomes nearest to the goal, to which the
    episode's own are added: take the best of them, and those ``within`` whose policies are
    nearest to its own. Combine the offsets of their policies so that the offsets of their
    outcomes add up to what the best one lacks, by least squares weighted by the inverse squared
    distance in policy space; step no farther than the farthest of them is. So the map is fitted
    where it is used: trials with like outcomes but unlike policies say nothing about the step.

    A random variation is added, whose effect on the outcome is expected to be between a small
    part of what is lacking and more than that, all orders of size alike: small ones home in where
    the map is good, large ones explore where it is not, or where outcomes are noisy. With a
    probability equal to the goal's cost, and no less than ``least_global``, a random policy is
    tried instead (thesis algorithm 3.2.4).

    A map that is fitted near the best policy may home in on the best there is near it, and no
    nearer. So now and then the best policy is varied in all coordinates by about a tenth of their
    range instead, as in random goal babbling; the seldomer, the less is lacking, as from near a
    goal hardly one of them would come nearer. And where one or two trials of a rare kind are all
    that is known, the better one is varied, by half of that, since the next random policy that
    produces it may be hundreds away.

    Homing in pays where the best outcome comes again. Where there is noise it may have been luck,
    answers come from a map that is smoothed over like policies (`LocalModel`), and such a map is
    fed by policies that lie as far apart as it is about linear. So, once there is one, variations
    are of that size, whatever is lacking. What looks like noise may be jumps, after which the same
    outcome comes again. Where there is not little of it, one policy in twenty is the best one once
    more, to tell.

    Contexts are part of the outcomes here, so a step also makes up for the present context.

    Args:
        model: The memory's model; the policy space must be a `Box`.
        budget: Movements an episode usually has; only a hint for allocation.
        within: How many policies the linear map is fitted to.
        variation: Smallest and largest size of the variation's effect on the outcome, as a share
            of what is lacking.
        least_global: Least probability of a random policy.
        wide_share: Probability of a wide variation of the best policy instead of a step, unless
            variations feed a map. In proportion less where the goal's cost is below 0.01.
        reached_share: An episode has nothing left to gain when its goal is within the task's
            tolerance and its cost at most this share of what it was before.
        feeds_map: Whether variations are of the size that suits the map, where there is noise, and
            policies are tried again where that may be jumps.
    """

    def __init__(
        self,
        model: NearestModel,
        *,
        budget: int = 2,
        within: int = 8,
        variation: tuple[float, float] = (0.03, 1.5),
        least_global: float = 0.02,
        wide_share: float = 0.1,
        reached_share: float = 0.5,
        feeds_map: bool = False,
    ) -> None:
        space = model.memory.task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"local search needs a policy space that is a Box, got {space!r}")
        self.model = model
        self.space = space
        self.budget = budget
        self.within = within
        self.variation = variation
        self.least_global = least_global
        self.wide_share = wide_share
        self.reached_share = reached_share
        self.feeds_map = feeds_map

    def begin(self, episode: Episode) -> None:
        """Gather the remembered trials nearest to the goal."""
        self.begin_all([episode])

    def begin_all(self, episodes: Sequence[Episode]) -> None:
        """As `begin` for several episodes."""
        aimed: dict[str, list[tuple[Episode, Goal]]] = {}
        for episode in episodes:
            assert episode.goal is not None
            aimed.setdefault(episode.goal.kind, []).append((episode, episode.goal))
        for kind, members in aimed.items():
            goals, contexts = [goal for _, goal in members], [e.context for e, _ in members]
            memory = self.model.memory.kinds[kind]
            distances, near = self.model.neighbours(goals, contexts)
            # What follows the nearest makes room for the episode's own trials.
            count = near.shape[1]
            shape = len(members), self.model.neighbourhood + self.budget
            rows, costs = np.zeros(shape, dtype=np.intp), np.zeros(shape)
            rows[:, :count], costs[:, :count] = near, distances
            if len(members) == 1:
                wanted = self.model.goal_key(goals[0], contexts[0])[None]
            else:
                wanted = self.model.memory.keys(kind, [goal.point for goal in goals], contexts)
            places = zip(members, wanted, rows, costs, strict=True)
            for (episode, _), goal, nearest, apart in places:
                episode.state = NearTrials(memory, goal, nearest, apart, count)

    def moved(self, episode: Episode) -> None:
        """Measure what is known against the goal in the new context."""
        assert episode.goal is not None
        episode.state.take_in()
        episode.state.aim(self.model.goal_key(episode.goal, episode.context))

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A step and a variation for each episode, the best policy varied, or a random one."""
        points = np.empty((len(episodes), self.space.dimension))
        stepping: dict[int, list[int]] = {}  # by the goal's kind
        for i, episode in enumerate(episodes):
            state: NearTrials = episode.state
            state.take_in()
            point = self._unaimed(episode)
            if point is not None:
                points[i] = point
            else:
                stepping.setdefault(id(state.memory), []).append(i)
        for members in stepping.values():
            for first in range(0, len(members), _BLOCK):
                chosen = members[first : first + _BLOCK]
                points[chosen] = self._steps([episodes[i] for i in chosen])
        clipped = np.minimum(np.maximum(points, 0.0), 1.0)
        for episode, point in zip(episodes, clipped, strict=True):
            episode.state.proposed = point
        return list(self.space.decode(clipped))

    def _unaimed(self, episode: Episode) -> FloatArray | None:
        """What is tried without a map: a random policy, or the best one varied; None for a step."""
        state, rng, dimension = episode.state, episode.rng, self.space.dimension
        if state.count < 3:
            rare = 0 < len(state.memory) * _RARE < len(self.model.memory)
            if not (rare and state.count) or rng.random() < self.least_global:
                return rng.random(dimension)
            return self._best_of(state) + _RARE_VARIED * rng.standard_normal(dimension)
        if rng.random() < max(self.least_global, min(1.0, state.cost)):
            return rng.random(dimension)
        fed = self._fed(state.memory)
        if self._to_be_told(fed) and rng.random() < _REPEATED:
            return self._best_of(state)
        wide = self.wide_share * min(1.0, state.cost / _COARSE)
        if rng.random() < wide and fed is None:
            return self._best_of(state) + _WIDE * rng.standard_normal(dimension)
        return None

    def _best_of(self, state: NearTrials) -> FloatArray:
        own = state.own.get(state.best)
        if own is not None:
            return own[0]
        best: FloatArray = state.memory.encoded_policies(state.rows[[state.best]])[0]
        return best

    def _to_be_told(self, fed: Smoothness | None) -> bool:
        """Whether noise is to be told from jumps, as it can be where no context differs."""
        return fed is not None and fed.may_jump and self.model.memory.task.context_space is None

    def _fed(self, memory: KindMemory) -> Smoothness | None:
        """The map that variations are to feed; None if there is none."""
        return self.model.map_of_noisy(memory) if self.feeds_map else None

    def _steps(self, episodes: Sequence[Episode]) -> FloatArray:
        """Where each state's local linear map puts its goal, varied: ``(episodes, dimension)``.

        Arrays are stacked, so that each state's numbers go through the same operations on the
        same shapes however many there are.
        """
        states: list[NearTrials] = [episode.state for episode in episodes]
        policies, keys = self._gathered(states)
        room = policies.shape[1]
        places = np.arange(0, len(states) * room, room)[:, None]  # of each state's first
        best = places + np.array([[s.best] for s in states])
        start, origin = _taken(policies, best), _taken(keys, best)
        policies -= start
        squares = np.einsum("bij,bij->bi", policies, policies)
        counts = np.array([[s.count] for s in states])
        squares[np.arange(room) >= counts] = np.inf
        squares[squares < _SAME] = np.inf  # the best one itself, and its copies, show no way
        near = squares.argpartition(self.within - 1, axis=1)[:, : self.within] + places
        squares, apart = squares.take(near), _taken(policies, near)
        known = np.isfinite(squares)
        squares[~known] = 0.0
        reach = squares.max(axis=1)
        weights = known / (squares + (_BLUR * reach + 1e-300)[:, None])
        effects = _taken(keys, near) - origin
        weighted = effects * weights[:, :, None]
        gram = effects.transpose(0, 2, 1) @ weighted
        goals = np.array([s.goal for s in states])
        shares = weighted @ solved(gram, goals - origin[:, 0])[:, :, None]
        steps = (shares.transpose(0, 2, 1) @ apart)[:, 0]
        lengths = np.einsum("bi,bi->b", steps, steps)
        steps *= np.sqrt(np.minimum(reach / np.maximum(lengths, 1e-300), 1.0))[:, None]
        # How far outcomes lie apart, over how far policies do: the far ones tell, not the noise.
        changes = np.einsum("bij,bij->bi", effects, effects)
        slopes = np.sqrt((changes * known).sum(axis=1) / (squares.sum(axis=1) + 1e-300))
        point: FloatArray = start[:, 0] + steps
        point += self._variations(episodes, slopes.tolist())
        return point

    def _gathered(self, states: Sequence[NearTrials]) -> tuple[FloatArray, FloatArray]:
        """Policies in the unit box and keys of what states of one kind know, in their places."""
        memory = states[0].memory
        rows = np.array([s.rows for s in states]) if len(states) > 1 else states[0].rows[None]
        policies, keys = memory.encoded_policies(rows), memory.keys.rows.take(rows, axis=0)
        for i, state in enumerate(states):
            for at, (policy, key) in state.own.items():
                policies[i, at], keys[i, at] = policy, key
        return policies, keys

    def _variations(self, episodes: Sequence[Episode], slopes: list[float]) -> FloatArray:
        """Random offsets that should each change the outcome by some share of the cost.

        Those that feed a map are instead of the size that suits it.
        """
        fed = self._fed(episodes[0].state.memory)
        (least, most), dimension = self.variation if fed is None else _SPREAD, self.space.dimension
        offsets, scales = [], []
        for episode, slope in zip(episodes, slopes, strict=True):
            state, rng = episode.state, episode.rng
            whole, slope = (state.cost, slope) if fed is None else (fed.length, 1.0)
            size = whole * least * (most / least) ** rng.random()
            scales.append(min(size / (slope * math.sqrt(dimension) + 1e-300), _WIDEST))
            offsets.append(rng.standard_normal(dimension))
        varied: FloatArray = np.array(offsets)
        varied *= np.array(scales)[:, None]
        return varied

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Keep the trial for the next proposal, if it produced the goal's kind."""
        assert episode.goal is not None
        key = self.model.key_of(trial, episode.goal.kind)
        if key is not None and competence is not None:
            state: NearTrials = episode.state
            state.told.append((state.proposed, key, -competence))

    def refuse(self, episode: Episode) -> None:
        """Nothing to add: the next step is drawn anew."""

    def finished(self, episode: Episode) -> bool:
        """Whether the goal is reached, and much nearer than it was before."""
        assert episode.goal is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return well_reached(episode, tolerance, self.reached_share)


def _taken(vectors: FloatArray, places: IntArray) -> FloatArray:
    """Vectors of an array of shape ``(b, room, n)``, by their places in all of it."""
    return vectors.reshape(-1, vectors.shape[2]).take(places, axis=0)
