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

    __slots__ = ("best", "costs", "count", "goal", "keys", "policies", "proposed", "turn")

    def __init__(self, goal: FloatArray, policies: FloatArray, keys: FloatArray, room: int) -> None:
        n = len(policies)
        self.goal = goal
        self.policies = np.empty((n + room, policies.shape[1]))
        self.keys = np.empty((n + room, keys.shape[1]))
        self.costs = np.empty(n + room)
        self.policies[:n] = policies
        self.keys[:n] = keys
        offsets = keys - goal
        self.costs[:n] = np.sqrt(np.einsum("ij,ij->i", offsets, offsets))
        self.count = n
        self.best = int(self.costs[:n].argmin()) if n else -1
        self.turn = 0
        self.proposed: FloatArray | None = None

    def add(self, policy: FloatArray, key: FloatArray) -> None:
        n = self.count
        if n == len(self.costs):
            for name in ("policies", "keys", "costs"):
                old = getattr(self, name)
                setattr(self, name, np.concatenate((old, np.empty_like(old))))
        self.policies[n] = policy
        self.keys[n] = key
        offset = key - self.goal
        cost = self.costs[n] = float(np.sqrt(offset @ offset))
        self.count = n + 1
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
        most_global: Largest probability of a random policy, once the kind has been produced.
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
        most_global: float = 1.0,
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
        self.most_global = most_global
        self.tolerance = tolerance

    def begin(self, episode: Episode) -> None:
        """Gather the remembered trials nearest to the goal."""
        goal = episode.goal
        assert goal is not None
        memory = self.model.memory.kinds[goal.kind]
        _, rows = self.model.nearest(goal, episode.context)
        key = self.model.memory.key(goal.kind, goal.point, episode.context)
        episode.state = _State(
            key, memory.encoded_policies(rows), memory.keys.rows[rows], self.budget
        )

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A random, linear or differential step for each episode."""
        linear: dict[int, list[int]] = {}
        points: list[FloatArray] = []
        for i, episode in enumerate(episodes):
            state: _State = episode.state
            draws = episode.rng.random(4)
            cost = state.costs[state.best] if state.count else 1.0
            if state.count == 0 or draws[0] < min(self.most_global, max(self.least_global, cost)):
                points.append(episode.rng.random(self.space.dimension))
                continue
            state.turn += 1
            if state.turn % 2 and state.count > 2:
                linear.setdefault(state.keys.shape[1], []).append(i)
                points.append(state.policies[state.best])
            else:
                points.append(self._differential(state, draws))
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

    def _differential(self, state: _State, draws: FloatArray) -> FloatArray:
        n = state.count
        i, j = int(draws[1] * n), int(draws[2] * n)
        weight = self.differential_weight * draws[3]
        step = weight * (state.policies[i] - state.policies[j])
        point: FloatArray = state.policies[state.best] + step
        return point

    def _linear_steps(self, states: Sequence[_State]) -> list[FloatArray]:
        """The step of each state's local linear map to its goal.

        Arrays are stacked, so that each state's numbers go through the same operations on the
        same shapes however many there are.
        """
        size, dimension = self.local_policies, self.space.dimension
        contexts = self.context_dimension
        outcomes = states[0].keys.shape[1] - contexts
        inputs = np.zeros((len(states), size, dimension + contexts))
        effects = np.zeros((len(states), size, outcomes))
        wanted = np.empty((len(states), outcomes + contexts))
        radius = np.empty(len(states))
        for i, state in enumerate(states):
            n, best = state.count, state.best
            apart = state.policies[:n] - state.policies[best]
            squares = np.einsum("ij,ij->i", apart, apart)
            keys = state.keys[:n]
            if n > size:
                chosen = squares.argpartition(size - 1)[:size]
                apart, squares, keys = apart[chosen], squares[chosen], keys[chosen]
            rows = len(apart)
            keys = keys - state.keys[best]
            inputs[i, :rows, :dimension] = apart
            inputs[i, :rows, dimension:] = keys[:, outcomes:]
            effects[i, :rows] = keys[:, :outcomes]
            radius[i] = np.sqrt(squares.max())
            wanted[i] = state.goal - state.keys[best]
        steps = self._solve(inputs, effects, wanted, radius)
        return [s.policies[s.best] + step for s, step in zip(states, steps, strict=True)]

    def _solve(
        self, inputs: FloatArray, effects: FloatArray, wanted: FloatArray, radius: FloatArray
    ) -> FloatArray:
        """Minimum-norm policy steps, shape ``(states, policy dimension)``.

        The map is fitted over policies and contexts; the context's share of the wanted effect
        comes without a step.
        """
        size, dimension, outcomes = inputs.shape[1], self.space.dimension, effects.shape[2]
        gram = inputs @ inputs.transpose(0, 2, 1)
        _add_to_diagonal(gram, self.ridge / size)
        linear = inputs.transpose(0, 2, 1) @ np.linalg.solve(gram, effects)
        target = wanted[:, :outcomes, None]
        if self.context_dimension:
            by_context = linear[:, dimension:].transpose(0, 2, 1)
            target = target - by_context @ wanted[:, outcomes:, None]
            linear = linear[:, :dimension]
        square = linear.transpose(0, 2, 1) @ linear
        _add_to_diagonal(square, 1e-9)
        steps: FloatArray = (linear @ np.linalg.solve(square, target))[:, :, 0]
        lengths = np.sqrt(np.einsum("bi,bi->b", steps, steps))
        steps *= (radius / np.maximum(lengths, np.maximum(radius, 1e-300)))[:, None]
        return steps

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Add the trial to those near the goal, if it produced the goal's kind."""
        goal, state = episode.goal, episode.state
        assert goal is not None
        point = trial.outcome.get(goal.kind)
        if point is not None:
            key = self.model.memory.key(goal.kind, point, trial.context)
            state.add(self.space.encode(trial.policy), key)

    def refuse(self, episode: Episode) -> None:
        """Nothing to add: the next step is drawn anew."""

    def finished(self, episode: Episode) -> bool:
        """Whether the goal is reached, well within its task's tolerance."""
        assert episode.goal is not None
        assert episode.best is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return -episode.best <= self.tolerance * tolerance


def _add_to_diagonal(matrices: FloatArray, share: float) -> None:
    """Add a share of each matrix's trace to its diagonal, in place; shape ``(b, n, n)``."""
    n = matrices.shape[1]
    diagonals = matrices.reshape(len(matrices), n * n)[:, :: n + 1]
    diagonals += diagonals.sum(axis=1, keepdims=True) * share + 1e-300
