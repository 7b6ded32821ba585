"""Benchmarks: goals fixed before any learning, by which a repertoire is measured."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from sgim.environments.base import MinimalEnvironment, draw_context, execute_all
from sgim.learner import Learner
from sgim.records import Goal
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams


class Benchmark:
    """Executes the learner's best policy for each goal and measures how far it ends from it.

    Args:
        goals: The goals; their kinds must be encodable outcomes of the environment.
        environment: Where policies are executed; noiseless, to measure the policy itself.
        distance: ``"scaled"``: in the unit box, at most 1 (the thesis's measure); ``"metric"``:
            in the outcome's own units. A goal whose kind was not produced costs 1.
    """

    def __init__(
        self,
        goals: Sequence[Goal],
        environment: MinimalEnvironment,
        distance: Literal["scaled", "metric"] = "scaled",
    ) -> None:
        self.environment = environment
        self.distance = distance
        self.goals: dict[str, list[Any]] = {}
        for goal in goals:
            self.goals.setdefault(goal.kind, []).append(goal.point)

    def describe(self) -> dict[str, Any]:
        """What it measures by, JSON-compatible: equal for benchmarks whose errors compare.

        Returns:
            ``goals``: kind → how many; ``distance``; ``digest`` of the goals.
        """
        spaces, digest = self.environment.task.outcome_spaces, hashlib.blake2b(digest_size=8)
        for kind, points in self.goals.items():
            for point in points:
                packed = spaces[kind].pack(spaces[kind].check(point))
                digest.update(kind.encode() + b"\0" + packed)
        counts = {kind: len(points) for kind, points in self.goals.items()}
        return {"goals": counts, "distance": self.distance, "digest": digest.hexdigest()}

    def evaluate(self, learner: Learner, streams: Streams, index: int) -> dict[str, float]:
        """Mean error per goal kind, and ``total``, the mean of the kinds.

        Args:
            learner: Whose best policies are executed.
            streams: For contexts and for a world with noise, ``evaluation/…``.
            index: Number of the evaluation: the movements made before it.
        """
        errors = {
            kind: float(np.mean(self.distances(learner, kind, streams, index)))
            for kind in self.goals
        }
        return {**errors, "total": float(np.mean(list(errors.values())))}

    def distances(self, learner: Learner, kind: str, streams: Streams, index: int) -> FloatArray:
        """The error of each goal of one kind, in the order of the goals."""
        points, environment = self.goals[kind], self.environment
        rng = streams(f"evaluation/{kind}", index)
        contexts: list[Any] | None = None
        if environment.task.context_space is not None:
            contexts = [draw_context(environment, rng) for _ in points]
        policies = learner.best_policies(kind, points, contexts)
        known = [i for i, policy in enumerate(policies) if policy is not None]
        errors = np.ones(len(points))
        if not known:
            return errors
        outcomes = execute_all(
            environment,
            [policies[i] for i in known],
            None if contexts is None else [contexts[i] for i in known],
            None if environment.deterministic else [rng] * len(known),
        )
        produced = [j for j, outcome in enumerate(outcomes) if kind in outcome]
        if produced:
            reached = [outcomes[j][kind] for j in produced]
            wanted = [points[known[j]] for j in produced]
            errors[[known[j] for j in produced]] = self._distances(kind, reached, wanted)
        return errors

    def _distances(self, kind: str, reached: Sequence[Any], wanted: Sequence[Any]) -> FloatArray:
        space = self.environment.task.outcome_spaces[kind]
        if isinstance(space, Box):  # encodes arrays of points at once
            apart = np.array(reached) - np.array(wanted)
            if self.distance == "metric":
                return np.asarray(np.linalg.norm(apart, axis=1))
            apart = apart / space.range
        else:
            apart = np.array(
                [space.encode(a) - space.encode(b) for a, b in zip(reached, wanted, strict=True)]
            )
        return np.asarray(np.minimum(np.linalg.norm(apart, axis=1), 1.0))
