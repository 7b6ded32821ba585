"""What interest maps of Gaussian mixtures share: goals and modes drawn from mixtures together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from sgim.mixtures import Conditional, GaussianMixture
from sgim.mixtures.conditional import rowwise
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
        uniform_share: Probability that goal and mode are drawn from all alike instead.

    Raises:
        TypeError: If a space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        context_space: Space | None = None,
        uniform_share: float = 0.0,
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
        self.uniform_share = uniform_share
        self._ends = {kind: self.contexts + space.dimension for kind, space in self.spaces.items()}
        corners = np.eye(len(self.modes))[:, 1:]
        self._corners: FloatArray = corners
        self.sources: dict[str, Source] = {}  # none for a kind that nothing is known of
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

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Draw a goal and one of ``modes`` by interest."""
        return self.choose_all([rng], modes, [context])[0]

    def choose_all(
        self, rngs: Sequence[np.random.Generator], modes: Sequence[str], contexts: Sequence[Any]
    ) -> list[tuple[Goal, str]]:
        """As `choose` for several episodes, each with its own generator and context."""
        chosen: list[tuple[Goal, str]] = [_NOTHING] * len(rngs)
        drawn: dict[str, list[_Drawn]] = {}
        for i, rng in enumerate(rngs):
            if self.uniform_share and rng.random() < self.uniform_share:
                chosen[i] = self.uniform(rng, modes)
            elif not self.sources:
                chosen[i] = self.first(rng, modes)
            else:
                kind = self._kind(rng)
                pick, normals = rng.random(), rng.standard_normal(self.sources[kind].width)
                drawn.setdefault(kind, []).append(
                    _Drawn(i, pick, normals, *self.amendments(rng, kind, modes))
                )
        for kind, members in drawn.items():
            given = None
            if self.context_space is not None:
                given = self.context_space.encode(np.array([contexts[m.number] for m in members]))
            vectors = self.sources[kind].draw(
                np.array([m.pick for m in members]), np.array([m.normals for m in members]), given
            )
            space = self.spaces[kind]
            d = space.dimension
            points = space.decode(np.clip(vectors[:, :d], 0.0, 1.0))
            nearest = self._nearest(vectors[:, d:], modes)
            for member, point, mode in zip(members, points, nearest, strict=True):
                goal = Goal(kind, point) if member.goal is None else member.goal
                chosen[member.number] = goal, mode if member.mode is None else member.mode
        return chosen

    def first(self, rng: np.random.Generator, modes: Sequence[str]) -> tuple[Goal, str]:
        """A goal and a mode while there is no mixture yet."""
        return self.uniform(rng, modes)

    def amendments(
        self, rng: np.random.Generator, kind: str, modes: Sequence[str]
    ) -> tuple[Goal | None, str | None]:
        """A goal and a mode to take instead of those that are drawn, if there are."""
        return None, None

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

    def _nearest(self, coordinates: FloatArray, modes: Sequence[str]) -> list[str]:
        """The mode offered that each row of mode coordinates is nearest to."""
        if len(modes) == 1:
            return [modes[0]] * len(coordinates)
        corners = self._corners[[self.modes[mode] for mode in modes]]
        distances = ((corners - coordinates[:, None, :]) ** 2).sum(axis=-1)
        return [modes[place] for place in distances.argmin(axis=1).tolist()]

    def uniform(self, rng: np.random.Generator, modes: Sequence[str]) -> tuple[Goal, str]:
        """Any kind, goal and mode, all alike."""
        kinds = list(self.spaces)
        kind = kinds[int(rng.integers(len(kinds)))]
        return Goal(kind, self.spaces[kind].sample(rng)), modes[int(rng.integers(len(modes)))]


class Source:
    """Draws from a mixture, given the first coordinates if there are any.

    Args:
        mixture: The mixture.
        contexts: How many coordinates are given.

    Attributes:
        width: How many coordinates are drawn.
    """

    def __init__(self, mixture: GaussianMixture, contexts: int = 0) -> None:
        self.width = mixture.dimension - contexts
        self._given = Conditional(mixture, contexts) if contexts else None
        self._mixture = mixture
        self._cumulated = mixture.weights.cumsum()

    def draw(
        self, picks: FloatArray, normals: FloatArray, contexts: FloatArray | None
    ) -> FloatArray:
        """Draw the other coordinates; see `sgim.mixtures.Conditional.draw`."""
        if self._given is not None and contexts is not None:
            return self._given.draw(contexts, picks, normals)
        wanted = picks * self._cumulated[-1]
        chosen = self._cumulated.searchsorted(wanted, "right")
        chosen = np.minimum(chosen, len(self._cumulated) - 1)
        vectors = rowwise(self._mixture.factors[chosen], normals)
        vectors += self._mixture.means[chosen]
        return vectors


class _Drawn(NamedTuple):
    """Random numbers of one episode, and what replaces the goal and the mode they give."""

    number: int
    pick: float
    normals: FloatArray
    goal: Goal | None
    mode: str | None


_NOTHING = Goal("", None), ""
