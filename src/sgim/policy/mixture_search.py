"""Policies drawn from a joint mixture, given a goal; and draws around the policy at rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from sgim.policy.explorer import Episode
from sgim.policy.mixture_model import MixtureModel
from sgim.policy.simple import Stateless
from sgim.spaces import Box, FloatArray
from sgim.task import Task

Bounds = Literal["clip", "reflect"]


class AroundRest(Stateless):
    """Gaussian draws around the task's policy at rest, or the middle if it has none.

    Args:
        task: The task, whose policy space must be a `Box`.
        spread: Standard deviation, as a share of each coordinate's range.
        bounds: What becomes of draws outside the bounds: the nearest policy within, or the mirror
            image at the bound.

    Raises:
        TypeError: If the policy space is not a `Box`.
    """

    def __init__(self, task: Task, spread: float, bounds: Bounds = "reflect") -> None:
        space = task.policy_space
        if not isinstance(space, Box):
            raise TypeError(f"draws around a policy need a space that is a Box, got {space!r}")
        self.space = space
        middle = np.full(space.dimension, 0.5)
        self.rest = middle if task.rest is None else space.encode(task.rest)
        self.spread = spread
        self.bounds: Bounds = bounds

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """One draw for each episode."""
        normals = np.array([e.rng.standard_normal(self.space.dimension) for e in episodes])
        vectors = within(self.rest + self.spread * normals, self.bounds)
        return list(self.space.decode(vectors))


class MixtureSearch(Stateless):
    """Draws policies from the model's mixture, given goal and context (algorithm 5.2.1, line 4).

    Where nothing is known of a goal's kind yet, it draws around the policy at rest.

    Args:
        model: The model.
        ignorant: Proposes while nothing is known.
        bounds: What becomes of draws outside the policy space (see `AroundRest`).
    """

    def __init__(
        self, model: MixtureModel, ignorant: AroundRest, bounds: Bounds = "reflect"
    ) -> None:
        self.model = model
        self.ignorant = ignorant
        self.bounds: Bounds = bounds

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """One draw for each episode, those for goals of one kind all at once."""
        kinds: dict[str | None, list[int]] = {}
        for i, episode in enumerate(episodes):
            kinds.setdefault(episode.goal.kind if episode.goal else None, []).append(i)
        policies: list[Any] = [None] * len(episodes)
        for kind, members in kinds.items():
            proposed = self._drawn(kind, [episodes[i] for i in members])
            for i, policy in zip(members, proposed, strict=True):
                policies[i] = policy
        return policies

    def _drawn(self, kind: str | None, episodes: list[Episode]) -> list[Any]:
        inverse = None if kind is None else self.model.inverse(kind)
        if kind is None or inverse is None:
            return self.ignorant.propose(episodes)
        space = self.model.policy_space
        points = [episode.goal.point for episode in episodes if episode.goal is not None]
        keys = self.model.keys(kind, points, [episode.context for episode in episodes])
        picks = np.array([episode.rng.random() for episode in episodes])
        normals = np.array([e.rng.standard_normal(space.dimension) for e in episodes])
        return list(space.decode(within(inverse.draw(keys, picks, normals), self.bounds)))


def within(vectors: FloatArray, bounds: Bounds) -> FloatArray:
    """Vectors brought into the unit box: by clipping, or by reflection as often as needed."""
    if bounds == "clip":
        return np.clip(vectors, 0.0, 1.0)
    folded: FloatArray = np.abs(vectors - 2.0 * np.round(vectors / 2.0))
    return np.minimum(folded, 1.0)
