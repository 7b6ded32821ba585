"""Benchmarks: goals fixed before any learning, by which a repertoire is measured."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol

import numpy as np

from sgim.answers import Answers
from sgim.environments.base import Generators, MinimalEnvironment, draw_context, execute_all
from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.records import Goal, Outcome
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams


class Measures(Protocol):
    """What a run is measured by: `Benchmark`, or what else can say how good a learner is."""

    def describe(self) -> dict[str, Any]:
        """What it measures by, JSON-compatible: equal for those whose errors compare."""
        ...

    def evaluate(self, learner: Learner, streams: Streams, index: int) -> dict[str, float]:
        """Errors by kind, and ``total``, of a learner after ``index`` movements."""
        ...


class Benchmark:
    """Executes the learner's best policy for each goal and measures how far it ends from it.

    Args:
        goals: The goals; their kinds must be encodable outcomes of the environment.
        environment: Where policies are executed; noiseless, to measure the policy itself.
        distance: ``"scaled"``: in the unit box, at most 1 (the thesis's measure); ``"metric"``:
            in the outcome's own units. A goal whose kind was not produced costs 1, as does one
            whose movement failed with an `SgimError`.
        origins: Kind → the outcome of doing nothing. For these kinds the relative error of
            eq. 3.8 is given as well: the distance over that from the origin to the goal, at
            most 1.
    """

    def __init__(
        self,
        goals: Sequence[Goal],
        environment: MinimalEnvironment,
        distance: Literal["scaled", "metric"] = "scaled",
        origins: Mapping[str, Any] | None = None,
    ) -> None:
        self.environment = environment
        self.distance = distance
        self.goals: dict[str, list[Any]] = {}
        for goal in goals:
            self.goals.setdefault(goal.kind, []).append(goal.point)
        self._ways = {
            kind: self._apart(kind, self.goals[kind], [origin] * len(self.goals[kind]))
            for kind, origin in (origins or {}).items()
        }

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

    def evaluate(self, learner: Answers, streams: Streams, index: int) -> dict[str, float]:
        """Mean error per goal kind, and ``total``, the mean of the kinds.

        For kinds with an origin there is ``KIND relative`` too, which does not count in the total.

        Args:
            learner: Whose best policies are executed.
            streams: For contexts and for a world with noise, ``evaluation/…``.
            index: Number of the evaluation: the movements made before it.
        """
        errors: dict[str, float] = {}
        means = []
        for kind in self.goals:
            measured = self._measured(learner, kind, streams, index)
            means.append(float(np.mean(_or_1(measured))))
            errors[kind] = means[-1]
            if kind in self._ways:
                errors[f"{kind} relative"] = float(np.mean(self.relative(kind, measured)))
        return {**errors, "total": float(np.mean(means))}

    def relative(self, kind: str, distances: FloatArray) -> FloatArray:
        """Costs of eq. 3.8, in [0, 1]: distances over those from the origin to the goals.

        Args:
            kind: A kind with an origin.
            distances: Of all its goals, NaN where nothing of the kind was produced, which costs
                1; shape ``(n,)``.
        """
        # A goal at the origin itself: any distance at all is as far as it can be.
        ways = np.maximum(self._ways[kind], 1e-12)
        return np.minimum(_or_1(distances / ways), 1.0)

    def distances(self, learner: Answers, kind: str, streams: Streams, index: int) -> FloatArray:
        """The error of each goal of one kind, in the order of the goals."""
        return _or_1(self._measured(learner, kind, streams, index))

    def _measured(self, learner: Answers, kind: str, streams: Streams, index: int) -> FloatArray:
        """The distance to each goal of one kind; NaN where nothing of the kind was produced."""
        points, environment = self.goals[kind], self.environment
        rng = streams(f"evaluation/{kind}", index)
        contexts: list[Any] | None = None
        if environment.task.context_space is not None:
            contexts = [draw_context(environment, rng) for _ in points]
        policies = learner.best_policies(kind, points, contexts)
        known = [i for i, policy in enumerate(policies) if policy is not None]
        errors = np.full(len(points), np.nan)
        if not known:
            return errors
        outcomes = _executed(
            environment,
            [policies[i] for i in known],
            None if contexts is None else [contexts[i] for i in known],
            None if environment.deterministic else [rng] * len(known),
        )
        produced = [j for j, outcome in enumerate(outcomes) if kind in outcome]
        if produced:
            reached = [outcomes[j][kind] for j in produced]
            wanted = [points[known[j]] for j in produced]
            errors[[known[j] for j in produced]] = self._apart(kind, reached, wanted)
        return errors

    def _apart(self, kind: str, reached: Sequence[Any], wanted: Sequence[Any]) -> FloatArray:
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


def _or_1(distances: FloatArray) -> FloatArray:
    """The distances, 1 instead of NaN."""
    return np.where(np.isnan(distances), 1.0, distances)


def _executed(
    environment: MinimalEnvironment,
    policies: Sequence[Any],
    contexts: Sequence[Any] | None,
    rngs: Generators | None,
) -> list[Outcome]:
    """What each policy produces; nothing where the world says that its movement failed."""
    try:
        return execute_all(environment, policies, contexts, rngs)
    except SgimError:
        if len(policies) == 1:
            return [{}]
    outcomes: list[Outcome] = []
    for i in range(len(policies)):
        one = slice(i, i + 1)
        outcomes += _executed(
            environment, policies[one], contexts and contexts[one], rngs and rngs[one]
        )
    return outcomes
