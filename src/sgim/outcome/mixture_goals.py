"""What interest maps of Gaussian mixtures share: goals and modes drawn from mixtures together."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from sgim.mixtures import Conditional, GaussianMixture
from sgim.outcome.interest import EpisodeReport
from sgim.records import Goal
from sgim.spaces import Box, FloatArray, Space


class MixtureGoals:
    """Base of maps that draw context, goal and mode from one mixture for each kind.

    A mixture's coordinates are the context and the goal, scaled to the unit box, then one for
    each mode but the first: 1 for that mode, else 0. A draw means the mode that it is nearest to;
    with two modes, this is the thesis's strategy dimension.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ, by which interest is divided.
        context_space: The task's context space if there is one; it must be a `Box`.

    Raises:
        TypeError: If a space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        context_space: Space | None = None,
    ) -> None:
        self.spaces: dict[str, Box] = {}
        for kind, space in goal_spaces.items():
            if not isinstance(space, Box):
                raise TypeError(f"mixtures need goal spaces that are a Box, got {space!r}")
            self.spaces[kind] = space
        if context_space is not None and not isinstance(context_space, Box):
            raise TypeError(f"mixtures need a context space that is a Box, got {context_space!r}")
        self.context_space = context_space
        self.contexts = 0 if context_space is None else context_space.dimension
        self.modes = {name: i for i, name in enumerate(modes)}
        self.costs = np.array(list(modes.values()), dtype=np.float64)
        self._names = tuple(modes)
        self._ends = {kind: self.contexts + space.dimension for kind, space in self.spaces.items()}
        corners = np.eye(len(self.modes))[:, 1:]
        self._corners: FloatArray = corners
        self.sources: dict[str, Source] = {}
        self.kind_weights: dict[str, float] = {}

    def width(self, kind: str) -> int:
        """Coordinates of a kind's mixture: context, goal and modes."""
        return self._ends[kind] + len(self.modes) - 1

    def usable(self, report: EpisodeReport, goal: Goal) -> bool:
        """Whether an episode was in a known mode, for a goal within its space."""
        space = self.spaces.get(goal.kind)
        return space is not None and report.mode in self.modes and space.contains(goal.point)

    def rows(
        self, kind: str, points: Sequence[Any], contexts: Sequence[Any], modes: Sequence[int]
    ) -> FloatArray:
        """The coordinates of episodes, shape ``(n, width)``."""
        parts = [self.spaces[kind].encode(np.array(points)), self._corners[list(modes)]]
        if self.context_space is not None:
            parts.insert(0, self.context_space.encode(np.array(contexts)))
        return np.concatenate(parts, axis=1)

    def discount(self, kind: str, mixture: GaussianMixture) -> FloatArray:
        """What each component's interest is multiplied by for its modes' costs, shape ``(k,)``."""
        others = mixture.means[:, self._ends[kind] : self.width(kind)]
        shares = np.concatenate((1.0 - others.sum(axis=1, keepdims=True), others), axis=1)
        shares = np.clip(shares, 0.0, 1.0)
        discounts: FloatArray = (shares / self.costs).sum(axis=1) / shares.sum(axis=1)
        return discounts

    def drawn(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str] | None:
        """Draw a kind by its weight, then goal and mode; None where there is no mixture yet."""
        if not self.sources:
            return None
        kind = self._kind(rng)
        source = self.sources[kind]
        given = None if self.context_space is None else self.context_space.encode(context)
        vector = source.draw(rng, given)
        space = self.spaces[kind]
        d = space.dimension
        point = np.minimum(np.maximum(vector[:d], 0.0), 1.0)
        return Goal(kind, space.decode(point)), self._nearest(vector[d:], modes, rng)

    def _kind(self, rng: np.random.Generator) -> str:
        kinds = list(self.sources)
        if len(kinds) == 1:
            return kinds[0]
        weights = [self.kind_weights[kind] for kind in kinds]
        wanted = rng.random() * sum(weights)
        for kind, weight in zip(kinds, weights, strict=True):
            wanted -= weight
            if wanted < 0:
                return kind
        return kinds[-1]

    def _nearest(
        self, coordinates: FloatArray, modes: Sequence[str], rng: np.random.Generator
    ) -> str:
        if len(modes) == 1:
            return modes[0]
        if len(coordinates) == 0:  # a mixture without modes
            return modes[int(rng.integers(len(modes)))]
        offered = [self.modes[mode] for mode in modes]
        distances = ((self._corners[offered] - coordinates) ** 2).sum(axis=1)
        return modes[int(distances.argmin())]

    def uniform(self, rng: np.random.Generator, modes: Sequence[str]) -> tuple[Goal, str]:
        """Any kind, goal and mode, all alike."""
        kinds = list(self.spaces)
        kind = kinds[int(rng.integers(len(kinds)))]
        return Goal(kind, self.spaces[kind].sample(rng)), modes[int(rng.integers(len(modes)))]


class Source:
    """Draws from a mixture quickly, one at a time, given the first coordinates if there are any.

    Args:
        mixture: The mixture; weights are as they are.
        contexts: How many coordinates are given.
    """

    def __init__(self, mixture: GaussianMixture, contexts: int = 0) -> None:
        self.mixture = mixture
        self._given = Conditional(mixture, contexts) if contexts else None
        self._cumulated = mixture.weights.cumsum().tolist()
        self._means: list[FloatArray] = list(mixture.means)
        self._factors: list[FloatArray] = list(mixture.factors)

    def draw(self, rng: np.random.Generator, context: FloatArray | None) -> FloatArray:
        """Draw the other coordinates."""
        pick = rng.random()
        if self._given is not None and context is not None:
            normals = rng.standard_normal((1, self._given.means.shape[1]))
            vector: FloatArray = self._given.draw(context[None], np.array([pick]), normals)[0]
            return vector
        place = min(bisect_right(self._cumulated, pick * self._cumulated[-1]), len(self._means) - 1)
        mean = self._means[place]
        offset: FloatArray = self._factors[place].dot(rng.standard_normal(mean.shape))
        offset += mean
        return offset
