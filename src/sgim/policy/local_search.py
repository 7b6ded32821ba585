"""Goal-directed local search: steps on a local linear map, and differential steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.linalg.lapack import dposv

from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.records import Trial
from sgim.spaces import Box, FloatArray


class _State:
    """What an episode's search knows: trials near the goal, the episode's own among them."""

    __slots__ = ("best", "costs", "count", "goal", "keys", "policies", "proposed", "turn")

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
        self.turn = 0
        self.proposed = policies[:0]

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
    """Alternates a step on a local linear map from policies to outcomes with differential steps.

    Starting from the remembered trials with the outcomes nearest to the goal, to which the
    episode's own are added: (a) fit a linear map by ridge regression to the trials whose
    policies are nearest to the best one, and take its minimum-norm step to the goal, no longer
    than the neighbourhood is wide; (b) add a scaled difference of two of the policies to the
    best one, as differential evolution does (Storn and Price 1997). With a probability equal
    to the goal's cost, within limits, try a random policy instead (thesis algorithm 3.2.4).

    Args:
        model: The memory's model; the policy space must be a `Box`.
        budget: Movements an episode usually has; only a hint for allocation.
        local_policies: How many policies the linear map is fitted to.
        ridge: Ridge, relative to the mean squared offset of the policies.
        differential_weight: Largest weight F of the difference.
        least_global: Least probability of a random policy.
        tolerance: Share of the task's tolerance below which a goal counts as reached.
    """

    def __init__(
        self,
        model: NearestModel,
        *,
        budget: int = 20,
        local_policies: int = 16,
        ridge: float = 1e-3,
        differential_weight: float = 0.7,
        least_global: float = 0.02,
        tolerance: float = 0.1,
    ) -> None:
        space = model.memory.task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"local search needs a policy space that is a Box, got {space!r}")
        self.model = model
        self.space = space
        context_space = model.memory.task.context_space
        self.context_dimension = (context_space.dimension or 0) if context_space else 0
        self.budget = budget
        self.local_policies = local_policies
        self.ridge = ridge
        self.differential_weight = differential_weight
        self.least_global = least_global
        self.tolerance = tolerance

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

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A random, linear or differential step for each episode."""
        linear: dict[int, list[int]] = {}
        points: list[FloatArray] = []
        for i, episode in enumerate(episodes):
            state: _State = episode.state
            chance, *draws = episode.rng.random(4).tolist()
            cost = min(1.0, state.costs[state.best]) if state.count else 1.0
            if state.count == 0 or chance < max(self.least_global, cost):
                points.append(episode.rng.random(self.space.dimension))
                continue
            state.turn += 1
            if state.turn % 2 and state.count > 2:
                linear.setdefault(len(state.goal), []).append(i)
                points.append(state.goal)
            else:
                points.append(self._differential(state, *draws))
        for chosen in linear.values():
            steps = self._linear_steps([episodes[i].state for i in chosen])
            for i, point in zip(chosen, steps, strict=True):
                points[i] = point
        decoded = []
        for episode, point in zip(episodes, points, strict=True):
            clipped = np.minimum(np.maximum(point, 0.0), 1.0)
            episode.state.proposed = clipped
            decoded.append(self.space.decode(clipped))
        return decoded

    def _differential(self, state: _State, one: float, other: float, share: float) -> FloatArray:
        i, j = int(one * state.count), int(other * state.count)
        step = self.differential_weight * share * (state.policies[i] - state.policies[j])
        point: FloatArray = state.policies[state.best] + step
        return point

    def _linear_steps(self, states: Sequence[_State]) -> FloatArray:
        """Where each state's local linear map puts its goal, shape ``(states, dimension)``.

        Arrays are stacked, so that each state's numbers go through the same operations on the
        same shapes however many there are.
        """
        size, outcomes = self.local_policies, len(states[0].goal) - self.context_dimension
        each = np.arange(len(states))
        best = np.array([state.best for state in states])
        counts = [state.count for state in states]
        if len(states) == 1:
            policies, keys = states[0].policies[None], states[0].keys[None]
            goals = states[0].goal[None]
        else:
            policies = np.array([state.policies for state in states])
            keys = np.array([state.keys for state in states])
            goals = np.array([state.goal for state in states])
        start = policies[each, best]
        origin = keys[each, best]
        apart = policies - start[:, None]
        squares = np.einsum("bij,bij->bi", apart, apart)
        for i, count in enumerate(counts):
            squares[i, count:] = np.inf
        rows, chosen = each[:, None], squares.argpartition(size - 1)[:, :size]
        squares = squares[rows, chosen]
        inputs = apart[rows, chosen]
        effects = keys[rows, chosen] - origin[:, None]
        if min(counts) < size:
            empty = squares == np.inf
            squares[empty] = inputs[empty] = effects[empty] = 0.0
        if self.context_dimension:
            inputs = np.concatenate((inputs, effects[:, :, outcomes:]), axis=2)
        steps = self._solve(inputs, effects[:, :, :outcomes], goals - origin)
        limits = squares.max(axis=1) / np.einsum("bi,bi->b", steps, steps).clip(1e-300)
        point: FloatArray = start + steps * np.sqrt(np.minimum(limits, 1.0))[:, None]
        return point

    def _solve(self, inputs: FloatArray, effects: FloatArray, wanted: FloatArray) -> FloatArray:
        """Minimum-norm policy steps, shape ``(states, policy dimension)``.

        The map is fitted over policies and contexts; the context's share of the wanted effect
        comes without a step.
        """
        dimension, outcomes = self.space.dimension, effects.shape[2]
        transposed = inputs.transpose(0, 2, 1)
        linear = transposed @ _solved(inputs @ transposed, effects, self.ridge / len(inputs[0]))
        target = wanted[:, :outcomes, None]
        if self.context_dimension:
            by_context = linear[:, dimension:].transpose(0, 2, 1)
            target = target - by_context @ wanted[:, outcomes:, None]
            linear = linear[:, :dimension]
        square = linear.transpose(0, 2, 1) @ linear
        steps: FloatArray = (linear @ _solved(square, target, 1e-9))[:, :, 0]
        return steps

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
        """Whether the goal is reached, well within its task's tolerance."""
        assert episode.goal is not None
        assert episode.best is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return -episode.best <= self.tolerance * tolerance


def _solved(squares: FloatArray, right: FloatArray, ridge: float) -> FloatArray:
    """Solve symmetric systems, with a share of each matrix's trace added to its diagonal.

    One by one: LAPACK itself is faster here than its stacked form, and its rounding does not
    depend on how many there are.

    Args:
        squares: Positive semidefinite matrices, shape ``(b, n, n)``; overwritten.
        right: Right-hand sides, shape ``(b, n, m)``.
        ridge: The share.
    """
    b, n, _ = squares.shape
    diagonals = squares.reshape(b, n * n)[:, :: n + 1]
    diagonals += diagonals.sum(axis=1, keepdims=True) * ridge + 1e-300
    solutions = np.empty_like(right)
    for i in range(b):
        solutions[i] = dposv(squares[i], right[i])[1]
    return solutions
