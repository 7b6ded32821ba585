"""Goal-directed local search: steps on a local linear map, and differential steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.records import Trial
from sgim.spaces import Box, FloatArray


class _State:
    """What an episode's search knows: trials near the goal, the episode's own among them."""

    __slots__ = (
        "best",
        "costs",
        "count",
        "goal",
        "keys",
        "policies",
        "proposed",
        "steps",
        "turn",
    )

    def __init__(
        self,
        goal: FloatArray,
        policies: FloatArray,
        keys: FloatArray,
        distances: FloatArray,
        room: int,
    ) -> None:
        n = self.count = len(policies)
        self.goal = goal
        self.policies = np.zeros((room, policies.shape[1]))
        self.keys = np.zeros((room, len(goal)))
        self.policies[:n] = policies
        self.keys[:n] = keys
        self.costs: list[float] = distances.tolist()
        self.best = 0 if n else -1
        self.turn = -1
        self.steps: list[FloatArray] = []
        self.proposed = policies[:0]

    def aim(self, goal: FloatArray) -> None:
        self.goal = goal
        offsets = self.keys[: self.count] - goal
        self.costs = np.sqrt(np.einsum("ij,ij->i", offsets, offsets)).tolist()
        if self.count:
            self.best = min(range(self.count), key=self.costs.__getitem__)

    def add(self, policy: FloatArray, key: FloatArray, cost: float) -> None:
        n = self.count
        if n == len(self.policies):  # the farthest from the goal makes room
            n = max(range(n), key=self.costs.__getitem__)
            self.costs[n] = cost
        else:
            self.count = n + 1
            self.costs.append(cost)
        self.policies[n] = policy
        self.keys[n] = key
        if self.best < 0 or cost < self.costs[self.best]:
            self.best = n


class LocalSearch:
    """Alternates steps on a local linear map with differential steps.

    Starting from the remembered trials with the outcomes nearest to the goal, to which the
    episode's own are added: (a) combine the offsets of their policies from the best one so that
    the offsets of their outcomes add up to what the best one lacks, by least squares weighted by
    the inverse squared distance in policy space, and step no farther than the nearest of them
    are; (b) add a scaled difference of two of the policies to the best one, as differential
    evolution does (Storn and Price 1997). With a probability equal to the goal's cost, and no
    less than ``least_global``, try a random policy instead (thesis algorithm 3.2.4).

    Contexts are part of the outcomes here, so a step also makes up for the present context.

    Args:
        model: The memory's model; the policy space must be a `Box`.
        budget: Movements an episode usually has; only a hint for allocation.
        within: A linear step is no longer than the distance of so many of the policies.
        differential_weight: Largest weight F of the difference.
        differential_block: How many differences are drawn at once.
        least_global: Least probability of a random policy.
        reached_share: An episode has nothing left to gain when its goal is within the task's
            tolerance and its cost at most this share of what it was before.
    """

    def __init__(
        self,
        model: NearestModel,
        *,
        budget: int = 20,
        within: int = 8,
        differential_weight: float = 0.7,
        differential_block: int = 3,
        least_global: float = 0.02,
        reached_share: float = 0.5,
    ) -> None:
        space = model.memory.task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"local search needs a policy space that is a Box, got {space!r}")
        self.model = model
        self.space = space
        self.budget = budget
        self.within = within
        self.differential_weight = differential_weight
        self.differential_block = differential_block
        self.least_global = least_global
        self.reached_share = reached_share

    def begin(self, episode: Episode) -> None:
        """Gather the remembered trials nearest to the goal."""
        goal = episode.goal
        assert goal is not None
        memory = self.model.memory.kinds[goal.kind]
        distances, rows = self.model.nearest(goal, episode.context)
        episode.state = _State(
            self.model.goal_key(goal, episode.context),
            memory.encoded_policies(rows),
            memory.keys.rows[rows],
            distances,
            self.model.neighbourhood + self.budget,
        )

    def moved(self, episode: Episode) -> None:
        """Measure what is known against the goal in the new context."""
        assert episode.goal is not None
        episode.state.aim(self.model.goal_key(episode.goal, episode.context))

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A random, linear or differential step for each episode."""
        points: list[FloatArray] = []
        linear: dict[int, list[int]] = {}
        for i, episode in enumerate(episodes):
            state: _State = episode.state
            state.turn += 1
            cost = min(1.0, state.costs[state.best]) if state.count else 1.0
            if state.count == 0 or episode.rng.random() < max(self.least_global, cost):
                points.append(episode.rng.random(self.space.dimension))
            elif state.turn % 2 == 0 and state.count > 2:
                linear.setdefault(len(state.goal), []).append(i)
                points.append(state.goal)
            else:
                points.append(self._differential(state, episode.rng))
        for chosen in linear.values():
            steps = self._linear_steps([episodes[i].state for i in chosen])
            for i, point in zip(chosen, steps, strict=True):
                points[i] = point
        clipped = np.minimum(np.maximum(np.array(points), 0.0), 1.0)
        for episode, point in zip(episodes, clipped, strict=True):
            episode.state.proposed = point
        return list(self.space.decode(clipped))

    def _differential(self, state: _State, rng: np.random.Generator) -> FloatArray:
        """The next of a few differential steps that are drawn together."""
        if not len(state.steps):
            one, other, share = rng.random((3, self.differential_block))
            pairs = (one * state.count).astype(np.intp), (other * state.count).astype(np.intp)
            apart = state.policies[pairs[0]] - state.policies[pairs[1]]
            state.steps = list(apart * (self.differential_weight * share)[:, None])
        point: FloatArray = state.policies[state.best] + state.steps.pop()
        return point

    def _linear_steps(self, states: Sequence[_State]) -> FloatArray:
        """Where each state's local linear map puts its goal, shape ``(states, dimension)``.

        Arrays are stacked, so that each state's numbers go through the same operations on the
        same shapes however many there are.
        """
        if len(states) == 1:
            (state,) = states
            policies, keys = state.policies[None], state.keys[None]
            start, origin = policies[:, state.best], keys[:, state.best]
            goals = state.goal[None]
        else:
            policies = np.array([s.policies for s in states])
            keys = np.array([s.keys for s in states])
            start = np.array([s.policies[s.best] for s in states])
            origin = np.array([s.keys[s.best] for s in states])
            goals = np.array([s.goal for s in states])
        apart = policies - start[:, None]
        effects = keys - origin[:, None]
        squares = np.einsum("bij,bij->bi", apart, apart)
        for i, state in enumerate(states):
            squares[i, state.count :] = np.inf
        reach = np.partition(squares, self.within, axis=1)[:, self.within]
        for i, state in enumerate(states):
            if state.count <= self.within:
                reach[i] = squares[i, : state.count].max()
        weights = 1.0 / (squares + (0.01 * reach + 1e-300)[:, None])
        weighted = effects * weights[:, :, None]
        gram = effects.transpose(0, 2, 1) @ weighted
        shares = weighted @ _solved(gram, goals - origin)[:, :, None]
        steps = (shares.transpose(0, 2, 1) @ apart)[:, 0]
        lengths = np.einsum("bi,bi->b", steps, steps)
        limits = np.sqrt(np.minimum(reach / np.maximum(lengths, 1e-300), 1.0))
        point: FloatArray = start + steps * limits[:, None]
        return point

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Add the trial to those near the goal, if it produced the goal's kind."""
        assert episode.goal is not None
        key = self.model.key_of(trial, episode.goal.kind)
        if key is not None and competence is not None:
            state: _State = episode.state
            state.add(state.proposed, key, -competence)

    def refuse(self, episode: Episode) -> None:
        """Nothing to add: the next step is drawn anew."""

    def finished(self, episode: Episode) -> bool:
        """Whether the goal is reached, and much nearer than it was before."""
        assert episode.goal is not None
        assert episode.best is not None
        assert episode.before is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return -episode.best <= min(tolerance, self.reached_share * -episode.before)


def _solved(squares: FloatArray, right: FloatArray) -> FloatArray:
    """Solve positive semidefinite systems, a little damped.

    In plain Python: for the few coordinates of an outcome that is faster than LAPACK, and
    elimination needs no pivots here.

    Args:
        squares: Matrices, shape ``(b, n, n)``.
        right: Right-hand sides, shape ``(b, n)``.
    """
    return np.array(
        [_eliminated(m, r) for m, r in zip(squares.tolist(), right.tolist(), strict=True)]
    )


def _eliminated(rows: list[list[float]], right: list[float]) -> list[float]:
    n = len(rows)
    damping = 1e-6 / n * sum(rows[i][i] for i in range(n)) + 1e-300
    for i in range(n):
        rows[i][i] += damping
        for j in range(i):
            factor = rows[i][j] / rows[j][j]
            for k in range(j + 1, n):
                rows[i][k] -= factor * rows[j][k]
            right[i] -= factor * right[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            right[i] -= rows[i][j] * right[j]
        right[i] /= rows[i][i]
    return right
