"""Goal-directed optimisation as the thesis has it: local data, then Nelder-Mead.

Sections 3.2.4.1 and 3.2.4.2, algorithms 3.2.3 to 3.2.5.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.policy.answering import localities
from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.records import Trial
from sgim.spaces import Box, FloatArray

Search = Generator[FloatArray, float, None]
"""Yields a policy scaled to the unit box and is sent its cost."""


def nelder_mead(points: Sequence[FloatArray], values: Sequence[float | None]) -> Search:
    """The simplex search of algorithm 3.2.3 (Lagarias et al. 1998), one evaluation at a time.

    Args:
        points: The n + 1 vertices to start from.
        values: Their costs; None for vertices yet to be evaluated.

    Yields:
        The next point to evaluate; send its cost. It never ends by itself.
    """
    simplex: list[tuple[float, FloatArray]] = []
    for point, value in zip(points, values, strict=True):
        simplex.append(((yield point) if value is None else value, point))
    while True:
        simplex.sort(key=lambda vertex: vertex[0])
        (best_value, best), (worst_value, worst) = simplex[0], simplex[-1]
        centre = np.mean([point for _, point in simplex[:-1]], axis=0)
        reflected = 2 * centre - worst
        value = yield reflected
        if best_value <= value < simplex[-2][0]:
            simplex[-1] = (value, reflected)
        elif value < best_value:
            expanded = centre + 2 * (centre - worst)
            further = yield expanded
            simplex[-1] = (further, expanded) if further < value else (value, reflected)
        else:
            towards, least = (reflected, value) if value < worst_value else (worst, worst_value)
            contracted = centre + (towards - centre) / 2
            nearer = yield contracted
            if nearer < least:
                simplex[-1] = (nearer, contracted)
            else:
                for i, (_, point) in enumerate(simplex[1:], start=1):
                    shrunk = best + (point - best) / 2
                    simplex[i] = ((yield shrunk), shrunk)


@dataclass
class _State:
    search: Search
    point: FloatArray | None = None
    cost: float | None = None  # of the point, once that is known


class NelderMeadSearch:
    """Global or local search for a goal (algorithm 3.2.4), the local one by Nelder-Mead.

    Each draw is global with probability equal to the goal's cost, clipped to
    ``[least_global, 1]``: one random policy. Otherwise local search goes on until the
    episode ends.

    Args:
        model: The memory's model; the policy space must be a `Box`.
        least_global: Least probability of a random policy.
        near_outcomes: How many of the nearest outcomes to consider (h_max of eq. 3.9).
        outcome_radius: Farthest of them from the goal, in the unit box (distM).
        policy_radius: Farthest neighbours in policy space, in the unit box (distN).
        variance_weight: The α in a locality's reliability, distance + α · variance.
        perturbation: Edge of the start simplex where memory has too few points, unit box.
    """

    def __init__(
        self,
        model: NearestModel,
        *,
        least_global: float = 0.05,
        near_outcomes: int = 10,
        outcome_radius: float = 0.3,
        policy_radius: float = 0.5,
        variance_weight: float = 0.5,
        perturbation: float = 0.05,
    ) -> None:
        space = model.memory.task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"Nelder-Mead needs a policy space that is a Box, got {space!r}")
        self.model = model
        self.space = space
        self.least_global = least_global
        self.near_outcomes = near_outcomes
        self.outcome_radius = outcome_radius
        self.policy_radius = policy_radius
        self.variance_weight = variance_weight
        self.perturbation = perturbation

    def begin(self, episode: Episode) -> None:
        """Start a search at the memory as it is now."""
        episode.state = _State(self._search(episode))

    def moved(self, episode: Episode) -> None:
        """Start anew: what the vertices cost in another context says little about this one."""
        self.begin(episode)

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """The point each search waits for; the same again until its cost is known."""
        policies = []
        for episode in episodes:
            state: _State = episode.state
            if state.point is None:
                state.point = next(state.search)
            elif state.cost is not None:
                state.point, state.cost = state.search.send(state.cost), None
            policies.append(self.space.decode(np.clip(state.point, 0.0, 1.0)))
        return policies

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Keep the trial's cost for the search."""
        episode.state.cost = 1.0 if competence is None else -competence

    def refuse(self, episode: Episode) -> None:
        """A refused policy costs as much as any can."""
        episode.state.cost = 1.0

    def finished(self, episode: Episode) -> bool:
        """Whether the goal is reached within its task's tolerance."""
        assert episode.goal is not None
        assert episode.best is not None
        return -episode.best <= self.model.memory.task.tolerances[episode.goal.kind]

    def _search(self, episode: Episode) -> Search:
        assert episode.goal is not None
        assert episode.best is not None
        memory = self.model.memory.kinds[episode.goal.kind]
        while True:
            probability = min(1.0, max(self.least_global, -episode.best))
            if not len(memory) or episode.rng.random() < probability:
                yield episode.rng.random(self.space.dimension)
            else:
                points, values = self.local_data(episode)
                yield from nelder_mead(points, values)

    def local_data(self, episode: Episode) -> tuple[list[FloatArray], list[float | None]]:
        """The start simplex: the interpolated policy, and the most reliable locality around it.

        Algorithm 3.2.5. Points from memory keep their remembered cost; vertices that memory
        cannot give are small perturbations of the interpolated policy.
        """
        goal = episode.goal
        assert goal is not None
        n = self.space.dimension
        memory = self.model.memory.kinds[goal.kind]
        key = self.model.memory.key(goal.kind, goal.point, episode.context)
        distances, rows = memory.nearest(key, self.near_outcomes)
        near = max(1, int((distances < self.outcome_radius).sum()))
        _, locality = min(
            localities(
                memory, distances[:near], rows[:near], self.policy_radius, self.variance_weight
            ),
            key=lambda found: found[0],
        )
        policies = memory.encoded_policies(locality)
        offsets = memory.keys.rows[locality] - key
        costs = np.sqrt((offsets**2).sum(axis=1))
        width = max(float(costs.mean()), 1e-12)
        weights = np.exp(-0.5 * (costs / width) ** 2)
        guess = weights @ policies / weights.sum()
        points: list[FloatArray] = [guess, *policies[:n]]
        values: list[float | None] = [None, *np.minimum(costs[:n], 1.0).tolist()]
        for axis in range(n + 1 - len(points)):
            vertex = guess.copy()
            step = self.perturbation
            vertex[axis] += step if vertex[axis] + step <= 1.0 else -step
            points.append(vertex)
            values.append(None)
        return points, values
