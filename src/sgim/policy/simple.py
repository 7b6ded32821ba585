"""The simple explorers: random policies, mimicry, and noise around the nearest neighbour."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from sgim.errors import TeacherError
from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.spaces import Box, FloatArray, Space


class Stateless:
    """Base of explorers that need no state and never finish early."""

    def begin(self, episode: Episode) -> None:
        """Nothing to prepare."""

    def moved(self, episode: Episode) -> None:
        """Nothing to note."""

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Nothing to note."""

    def refuse(self, episode: Episode) -> None:
        """Nothing to note: the next draw differs anyway."""

    def finished(self, episode: Episode) -> bool:
        """Never before the budget is used up."""
        return False


class RandomPolicies(Stateless):
    """Draws policies from their space, whatever the goal.

    Args:
        space: The policy space.
    """

    def __init__(self, space: Space) -> None:
        self.space = space

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """One draw for each episode."""
        if isinstance(self.space, Box):
            return list(self.space.sample_all([e.rng for e in episodes]))
        return [self.space.sample(e.rng) for e in episodes]


class PolicyOfLabel(Stateless):
    """Proposes the one policy there is for a label, where policies are choices and not vectors.

    Args:
        policies: Label → policy.
    """

    def __init__(self, policies: Mapping[str, Any]) -> None:
        self.policies = dict(policies)

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """The policy of each episode's label."""
        return [None if e.goal is None else self.policies[e.goal.point] for e in episodes]


class Mimicry(Stateless):
    """Repeats a demonstrated policy with small variations (thesis algorithm 3.2.1).

    Variations are uniform in a ball around the demonstrated policy, and clipped to the bounds.

    Args:
        space: The policy space. Policies that are not vectors are repeated as they are.
        radius: Radius ε of the ball.
        scaled: Whether the radius is in the unit box; else it is in the policy's own units.
        exact_first: Whether the first repetition is without variation.
    """

    def __init__(
        self, space: Space, radius: float, *, scaled: bool = False, exact_first: bool = False
    ) -> None:
        self.space = space
        self.radius = radius
        self.scaled = scaled
        self.exact_first = exact_first

    def begin(self, episode: Episode) -> None:
        """Check that there is a policy to repeat."""
        if episode.demonstration is None or episode.demonstration.policy is None:
            raise TeacherError("mimicry needs a demonstration with a policy, or a trajectory")

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A variation of each episode's demonstration."""
        return [self._vary(e) for e in episodes]

    def _vary(self, episode: Episode) -> Any:
        demonstration = episode.demonstration
        assert demonstration is not None  # begin has checked
        policy = demonstration.policy
        if not isinstance(self.space, Box) or (self.exact_first and episode.attempts == 0):
            return policy
        variation = in_ball(episode.rng, self.space.dimension) * self.radius
        return self.space.clip(
            policy + (variation * self.space.range if self.scaled else variation)
        )


def in_ball(rng: np.random.Generator, dimension: int) -> FloatArray:
    """Draw uniformly in the unit ball."""
    direction = rng.standard_normal(dimension)
    radius = rng.random() ** (1.0 / dimension) / np.sqrt(direction @ direction)
    point: FloatArray = direction * radius
    return point


class NoisyNearest(Stateless):
    """The nearest remembered policy plus Gaussian noise: the explorer of random goal babbling.

    Args:
        model: Whose nearest neighbours to start from.
        noise: Standard deviation, as a share of each policy coordinate's range.
        bootstrap: How many policies to draw at random before, so that the first neighbours are
            not all offspring of one policy.
    """

    def __init__(self, model: NearestModel, noise: float = 0.1, bootstrap: int = 30) -> None:
        self.model = model
        self.noise = noise
        self.bootstrap = bootstrap
        self.space = model.memory.task.policy_space

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """A variation of the nearest policy for each; a random policy while there is none."""
        memory = self.model.memory
        aimed: dict[int, Goal] = {}
        if len(memory) >= self.bootstrap:
            for i, episode in enumerate(episodes):
                if episode.goal is not None and len(memory.kinds[episode.goal.kind]):
                    aimed[i] = episode.goal
        policies: list[Any] = [None] * len(episodes)
        if aimed:
            goals = list(aimed.values())
            found = self.model.nearest_all(goals, [episodes[i].context for i in aimed])
            for i, goal, (_, rows) in zip(aimed, goals, found, strict=True):
                policies[i] = memory.policies[int(memory.kinds[goal.kind].trials.rows[rows[0]])]
        return [
            self._vary(episode, policies[i]) if i in aimed else self.space.sample(episode.rng)
            for i, episode in enumerate(episodes)
        ]

    def _vary(self, episode: Episode, policy: Any) -> Any:
        space = self.space
        if not isinstance(space, Box):
            return policy if episode.rng.random() > self.noise else space.sample(episode.rng)
        return space.clip(
            policy + episode.rng.standard_normal(space.dimension) * (self.noise * space.range)
        )
