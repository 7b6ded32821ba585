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

    def near(self, size: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Offsets from the best policy, and of their keys, for the policies nearest to it.

        Returns:
            Shapes ``(size, dimension)`` and ``(size, key dimension)``, and the squared lengths
            of the offsets, shape ``(size,)``; rows of zeros where there are too few.
        """
        n = self.count
        if n < size:  # the rows behind the last are zero, but their offsets would not be
            apart = np.zeros((size, self.policies.shape[1]))
            effects = np.zeros((size, self.keys.shape[1]))
            apart[:n] = self.policies[:n] - self.policies[self.best]
            effects[:n] = self.keys[:n] - self.keys[self.best]
            return apart, effects, np.einsum("ij,ij->i", apart, apart)
        apart = self.policies[:n] - self.policies[self.best]
        squares = np.einsum("ij,ij->i", apart, apart)
        chosen = squares.argpartition(size - 1)[:size]
        return apart[chosen], self.keys[chosen] - self.keys[self.best], squares[chosen]

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
    """Alternates steps on a local linear map from policies to outcomes with differential steps.

    Starting from the remembered trials with the outcomes nearest to the goal, to which the
    episode's own are added: (a) fit a linear map by ridge regression to the trials whose
    policies are nearest to the best one, and take its minimum-norm step to the goal, no longer
    than the neighbourhood is wide; (b) add a scaled difference of two of the policies to the
    best one, as differential evolution does (Storn and Price 1997). With a probability equal to
    the goal's cost, and no less than ``least_global``, try a random policy instead (thesis
    algorithm 3.2.4).

    Args:
        model: The memory's model; the policy space must be a `Box`.
        budget: Movements an episode usually has; only a hint for allocation.
        local_policies: How many policies the linear map is fitted to.
        ridge: Ridge, relative to the mean squared offset of the policies.
        differential_weight: Largest weight F of the difference.
        differential_block: How many differences are drawn at once.
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
        differential_block: int = 3,
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
        self.differential_block = differential_block
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
        decoded = []
        for episode, point in zip(episodes, points, strict=True):
            clipped = np.minimum(np.maximum(point, 0.0), 1.0)
            episode.state.proposed = clipped
            decoded.append(self.space.decode(clipped))
        return decoded

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

        The map is fitted over policies and contexts; the context's share of the wanted effect
        comes without a step. Arrays are stacked, so that each state's numbers go through the
        same operations on the same shapes however many there are.
        """
        dimension, outcomes = self.space.dimension, len(states[0].goal) - self.context_dimension
        inputs, effects, squares = _stacked([s.near(self.local_policies) for s in states])
        wanted = np.array([s.goal - s.keys[s.best] for s in states])
        if self.context_dimension:
            inputs = np.concatenate((inputs, effects[:, :, outcomes:]), axis=2)
            effects = effects[:, :, :outcomes]
        transposed = inputs.transpose(0, 2, 1)
        ridge = self.ridge / self.local_policies
        linear = transposed @ _solved(inputs @ transposed, effects, ridge)
        target = wanted[:, :outcomes, None]
        if self.context_dimension:
            by_context = linear[:, dimension:].transpose(0, 2, 1)
            target = target - by_context @ wanted[:, outcomes:, None]
            linear = linear[:, :dimension]
        steps = (linear @ _solved(linear.transpose(0, 2, 1) @ linear, target, 1e-9))[:, :, 0]
        lengths = np.einsum("bi,bi->b", steps, steps)
        shares = np.sqrt(squares.max(axis=1) / np.maximum(lengths, 1e-300))
        start = np.array([s.policies[s.best] for s in states])
        point: FloatArray = start + steps * np.minimum(shares, 1.0)[:, None]
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
        """Whether the goal is reached, well within its task's tolerance."""
        assert episode.goal is not None
        assert episode.best is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return -episode.best <= self.tolerance * tolerance


def _stacked(
    parts: Sequence[tuple[FloatArray, FloatArray, FloatArray]],
) -> tuple[FloatArray, FloatArray, FloatArray]:
    if len(parts) == 1:
        first, second, third = parts[0]
        return first[None], second[None], third[None]
    firsts, seconds, thirds = zip(*parts, strict=True)
    return np.array(firsts), np.array(seconds), np.array(thirds)


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
