"""Black-box search for a goal, a population of policies at a time: CMA-ES and PI².

Section 6.2.3 of the thesis asks how such optimisers would do in the place of Nelder-Mead.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from sgim.errors import SgimError
from sgim.policy.explorer import Episode, well_reached
from sgim.policy.model import NearestModel
from sgim.records import Trial
from sgim.spaces import Box, FloatArray


class Distribution(Protocol):
    """A distribution over policies in the unit box that moves to where costs are low."""

    def ask(self) -> FloatArray:
        """A population, shape ``(size, dimension)``; may lie outside the box."""
        ...

    def tell(self, points: FloatArray, costs: FloatArray) -> None:
        """Learn what each point of the last population cost, shape ``(size,)``."""
        ...


MakeDistribution = Callable[[FloatArray, float, np.random.Generator], Distribution]
"""From mean, standard deviation of a coordinate, and the episode's stream."""


class PathIntegral:
    """Policy improvement with path integrals, in its black-box form.

    The mean moves to the average of a population, weighted by exp(−h · normalised cost); the
    spread of later populations falls by a constant factor. (Theodorou et al. 2010; PI^BB of Stulp
    and Sigaud 2012, with their h = 10.)

    Args:
        mean: Shape ``(dimension,)``.
        spread: Standard deviation of a coordinate.
        rng: The episode's stream.
    """

    size = 10
    eliteness = 10.0
    decay = 0.9

    def __init__(self, mean: FloatArray, spread: float, rng: np.random.Generator) -> None:
        self.mean = mean
        self.spread = spread
        self.rng = rng

    def ask(self) -> FloatArray:
        """Gaussian variations of the mean."""
        variations = self.rng.standard_normal((self.size, len(self.mean)))
        points: FloatArray = self.mean + self.spread * variations
        return points

    def tell(self, points: FloatArray, costs: FloatArray) -> None:
        """Move the mean, and narrow the spread."""
        low, high = costs.min(), costs.max()
        weights = np.exp(-self.eliteness * (costs - low) / max(high - low, 1e-300))
        self.mean = weights @ points / weights.sum()
        self.spread *= self.decay


class CovarianceAdaptation:
    """CMA-ES (Hansen and Ostermeier 2001), by the package ``cma``; arguments as `PathIntegral`.

    Raises:
        SgimError: If ``cma`` is not installed.
    """

    def __init__(self, mean: FloatArray, spread: float, rng: np.random.Generator) -> None:
        # NaN as a seed leaves NumPy's global generator alone; numbers come from the episode's.
        options = {
            "randn": lambda *shape: rng.standard_normal(shape),
            "seed": math.nan,
            "verbose": -9,
        }
        self._strategy = _cma().CMAEvolutionStrategy(mean, spread, options)

    def ask(self) -> FloatArray:
        """A population of 4 + 3 ln(dimension)."""
        return np.array(self._strategy.ask())

    def tell(self, points: FloatArray, costs: FloatArray) -> None:
        """Adapt mean, step size and covariance."""
        self._strategy.tell(list(points), costs.tolist())


def _cma() -> Any:
    try:
        return importlib.import_module("cma")
    except ImportError as error:
        raise SgimError(
            "this search needs the package cma; install it with: pip install 'sgim[cma]'"
        ) from error


class _State:
    """An episode's distribution, its population, and what of it is known."""

    __slots__ = ("costs", "distribution", "population", "proposed")

    def __init__(self, distribution: Distribution | None) -> None:
        self.distribution = distribution
        self.population = np.empty((0, 0)) if distribution is None else distribution.ask()
        self.costs: list[float] = []
        self.proposed = False  # whether what was proposed last is of the population

    def add(self, cost: float) -> None:
        if not self.proposed or self.distribution is None:
            return
        self.costs.append(cost)
        if len(self.costs) == len(self.population):
            self.distribution.tell(self.population, np.array(self.costs))
            self.population, self.costs = self.distribution.ask(), []


class PopulationSearch:
    """Search for a goal by a distribution that starts at the nearest remembered policy.

    Its first spread is the mean distance, by coordinate, to the remembered policies nearest to it.
    With a probability equal to the goal's cost, and no less than ``least_global``, a random policy
    is tried instead (thesis algorithm 3.2.4). An episode shorter than a population only samples.

    Args:
        model: The memory's model; the policy space must be a `Box`.
        make: Makes the distribution: `PathIntegral` or `CovarianceAdaptation`.
        least_global: Least probability of a random policy.
        reached_share: An episode has nothing left to gain when its goal is within the task's
            tolerance and its cost at most this share of what it was before.
    """

    def __init__(
        self,
        model: NearestModel,
        make: MakeDistribution,
        *,
        least_global: float = 0.05,
        reached_share: float = 0.5,
    ) -> None:
        space = model.memory.task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"population search needs policies in a Box, got {space!r}")
        self.model = model
        self.space = space
        self.make = make
        self.least_global = least_global
        self.reached_share = reached_share

    def begin(self, episode: Episode) -> None:
        """Place a distribution at the policy nearest to the goal, if there is one."""
        goal = episode.goal
        assert goal is not None
        memory = self.model.memory.kinds[goal.kind]
        _, rows = self.model.nearest(goal, episode.context)
        if not len(rows):
            episode.state = _State(None)
            return
        mean = memory.encoded_policies(rows[:1])[0]
        apart, _ = memory.nearest_policies(mean, self.space.dimension + 1)
        spread = float(apart.mean()) / math.sqrt(self.space.dimension)
        # A lone policy has no neighbours to say how far to look.
        episode.state = _State(self.make(mean, spread if spread > 1e-6 else 0.1, episode.rng))

    def moved(self, episode: Episode) -> None:
        """Start anew: costs in another context say little about this one."""
        self.begin(episode)

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """The next of each episode's population, or a random policy."""
        points = np.empty((len(episodes), self.space.dimension))
        for i, episode in enumerate(episodes):
            state: _State = episode.state
            cost = 1.0 if episode.best is None else -episode.best
            state.proposed = state.distribution is not None and episode.rng.random() >= max(
                self.least_global, cost
            )
            if state.proposed:
                points[i] = state.population[len(state.costs)]
            else:
                points[i] = episode.rng.random(self.space.dimension)
        return list(self.space.decode(points.clip(0.0, 1.0)))

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Note what the policy cost; the distribution moves when its population is known."""
        episode.state.add(1.0 if competence is None else -competence)

    def refuse(self, episode: Episode) -> None:
        """A refused policy costs as much as any can."""
        episode.state.add(1.0)

    def finished(self, episode: Episode) -> bool:
        """Whether the goal is reached, and much nearer than it was before."""
        assert episode.goal is not None
        tolerance = self.model.memory.task.tolerances[episode.goal.kind]
        return well_reached(episode, tolerance, self.reached_share)
