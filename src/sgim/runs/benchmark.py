"""Benchmarks: goals fixed before any learning, by which a repertoire is measured."""

from __future__ import annotations

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
        space = environment.task.outcome_spaces[kind]
        for i, outcome in zip(known, outcomes, strict=True):
            if kind in outcome:
                errors[i] = self._distance(space, outcome[kind], points[i])
        return errors

    def _distance(self, space: Any, outcome: Any, goal: Any) -> float:
        if self.distance == "metric" and isinstance(space, Box):
            return float(np.linalg.norm(outcome - goal))
        return min(1.0, float(np.linalg.norm(space.encode(outcome) - space.encode(goal))))
