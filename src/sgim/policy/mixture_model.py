"""A joint mixture over policies and outcomes, from which policies for a goal are inferred.

G_SM of the thesis's section 5.2.2, one for each kind of outcome.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.mixtures import Conditional, GaussianMixture, fit, split_starved, updated
from sgim.mixtures.incremental import falling_rate
from sgim.policy.competence import NoAnswerError
from sgim.policy.model import NearestModel
from sgim.records import Goal, Solution, Trial
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams
from sgim.task import Task

_FAR = 10.0  # Box widths: outcomes farther outside their box than that count as that far.
_POINTS_A_COMPONENT = 10  # Fewer points than that for each are too few to begin with.


@dataclass(frozen=True, slots=True)
class Learning:
    """How a `MixtureModel` learns.

    Attributes:
        components: Gaussians in each mixture.
        every: Trials between two updates.
        first_rate: Weight of an update's trials against all before, at first.
        last_rate: The same at the end of the lifetime, and after it; it falls logarithmically.
        lifetime: Trials after which the rate falls no more.
        sweeps: Most repetitions of EM in an update.
        floor: Least variance in any direction, in the unit box.
        starving: Weight below which a component is given half of the heaviest one; 0 for never.
    """

    components: int = 28
    every: int = 400
    first_rate: float = 0.1
    last_rate: float = 0.01
    lifetime: int = 240_000
    sweeps: int = 5
    floor: float = 1e-5
    starving: float = 0.0


class MixtureModel:
    """Learns mixtures over outcome, context and policy, little by little.

    Every `Learning.every` trials, the mixture of each kind is updated with the trials that
    produced it: by EM from k-means the first time, then incrementally (Calinon 2009), older trials
    being remembered only through the mixture. Everything is scaled to the unit box.

    Competence for a goal is what trials for it show: e^{−d} − 1, in [−1, 0], where d is the
    distance from outcome to goal. It is the thesis's e^{−d} less 1, so that perfection is 0 as
    everywhere.
    Mixtures remember no trial: before an episode's own ones, competence is −1.

    Args:
        task: The task; policies, contexts, and outcomes must be vectors in a `Box`.
        streams: Random streams, for the first fits.
        learning: How it learns.
        nearest: Remembers every trial and answers in the mixture's place, if given: the answer is
            then never worse than the nearest remembered outcome in a deterministic world.
        scaled: Whether distances are measured with each coordinate scaled to [−1, 1]; else in
            the outcome's own units.

    Raises:
        TypeError: If a space is not a `Box`.
    """

    def __init__(
        self,
        task: Task,
        streams: Streams,
        learning: Learning | None = None,
        *,
        nearest: NearestModel | None = None,
        scaled: bool = False,
    ) -> None:
        self.task = task
        self.streams = streams
        self.learning = Learning() if learning is None else learning
        self.nearest = nearest
        self.policy_space = _box(task.policy_space, "policy")
        contexts = None if task.context_space is None else _box(task.context_space, "context")
        self.context_space = contexts
        self.spaces = {
            kind: _box(s, f"outcome {kind!r}") for kind, s in task.outcome_spaces.items()
        }
        self.trials = 0
        self.kinds = {kind: _Kind() for kind in self.spaces}
        self._units = {
            kind: 2.0 / space.range if scaled else np.ones(space.dimension)
            for kind, space in self.spaces.items()
        }

    def update(self, trial: Trial) -> None:
        """Note a trial; at every so manieth, learn from those since the last time."""
        if self.nearest is not None:
            self.nearest.update(trial)
        self._note(trial)

    def learn_all(
        self, trials: Sequence[Trial], goals: Sequence[Goal | None], contexts: Sequence[Any]
    ) -> list[float | None]:
        """Learn from several trials; for each, what `shown_by` says of it and its goal."""
        if self.nearest is not None:
            self.nearest.learn_all(trials, [None] * len(trials), contexts)
        for trial in trials:
            self._note(trial)
        pairs = zip(trials, goals, contexts, strict=True)
        return [None if g is None else self.shown_by(trial, g, c) for trial, g, c in pairs]

    def _note(self, trial: Trial) -> None:
        for kind, point in trial.outcome.items():
            self.kinds[kind].waiting.append((point, trial.context, trial.policy))
        self.trials += 1
        if self.trials % self.learning.every == 0:
            for kind, known in self.kinds.items():
                self._learn(kind, known)

    def _learn(self, kind: str, known: _Kind) -> None:
        learning, rows = self.learning, known.waiting
        wanted = 2 * _POINTS_A_COMPONENT if known.mixture is None else 1
        if len(rows) < min(wanted, learning.every):
            return
        points, contexts, policies = zip(*rows, strict=True)
        outcomes = np.clip(self.spaces[kind].encode(np.array(points)), -_FAR, 1.0 + _FAR)
        parts = [outcomes, self.policy_space.encode(np.array(policies))]
        if self.context_space is not None:
            parts.insert(1, self.context_space.encode(np.array(contexts)))
        data = np.concatenate(parts, axis=1)
        if known.mixture is None:
            components = max(1, min(learning.components, len(rows) // _POINTS_A_COMPONENT))
            rng = self.streams(f"model/mixture/{kind}", self.trials)
            known.replace(fit(data, components, rng, floor=learning.floor), self.given(kind))
            known.produced = known.mixture and known.mixture.marginal([*range(outcomes.shape[1])])
        else:
            done = self.trials / learning.lifetime
            rate = falling_rate(done, learning.first_rate, learning.last_rate)
            rate *= min(1.0, len(rows) / learning.every)
            made = updated(known.mixture, data, rate, floor=learning.floor, sweeps=learning.sweeps)
            if learning.starving:
                made = split_starved(made, learning.starving)
            known.replace(made, self.given(kind))
        known.recent = outcomes
        known.waiting = []

    def given(self, kind: str) -> int:
        """How many of a mixture's coordinates are given with a goal: outcome and context."""
        contexts = 0 if self.context_space is None else self.context_space.dimension
        return self.spaces[kind].dimension + contexts

    def produced(self, kind: str) -> GaussianMixture | None:
        """The outcomes of a kind in the first trials, in the unit box; None before those."""
        return self.kinds[kind].produced

    def recent(self, kind: str) -> FloatArray:
        """The outcomes of a kind last learned from, in the unit box, shape ``(n, d)``."""
        return self.kinds[kind].recent

    def inverse(self, kind: str) -> Conditional | None:
        """The distribution of policies given outcome and context, in the unit box."""
        return self.kinds[kind].inverse

    def keys(self, kind: str, points: Sequence[Any], contexts: Sequence[Any]) -> FloatArray:
        """Outcomes or goals of a kind in their contexts, in the unit box, shape ``(n, given)``."""
        encoded = self.spaces[kind].encode(np.array(points))
        if self.context_space is None:
            return encoded
        return np.concatenate((encoded, self.context_space.encode(np.array(contexts))), axis=1)

    def competence(self, goal: Goal, context: Any) -> float:
        """−1 for every goal: only trials show more."""
        return -1.0

    def competences(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[float]:
        """As `competence` for several goals."""
        return [-1.0] * len(goals)

    def shown_by(self, trial: Trial, goal: Goal, context: Any) -> float:
        """e^{−d} − 1 for the distance d from the trial's outcome to the goal; −1 without one."""
        point = trial.outcome.get(goal.kind)
        if point is None:
            return -1.0
        difference = (point - goal.point) * self._units[goal.kind]
        return math.exp(-math.sqrt(difference.dot(difference))) - 1.0

    def best_policy(self, goal: Goal, context: Any) -> Any:
        """The mean policy, given the goal, of the component that is likeliest there."""
        if self.nearest is not None:
            return self.nearest.best_policy(goal, context)
        policy = self.best_policies([goal], [context])[0]
        if policy is None:
            raise NoAnswerError(f"no mixture has been learned for outcomes of kind {goal.kind!r}")
        return policy

    def best_policies(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[Any]:
        """As `best_policy` for many goals of one kind at once; None where nothing is known."""
        if self.nearest is not None:
            return self.nearest.best_policies(goals, contexts)
        inverse = self.kinds[goals[0].kind].inverse if goals else None
        if inverse is None:
            return [None] * len(goals)
        keys = self.keys(goals[0].kind, [goal.point for goal in goals], contexts)
        centres = inverse.centres(keys, inverse.likeliest(keys))
        return list(self.policy_space.decode(np.clip(centres, 0.0, 1.0)))

    def solve(self, goal: Goal, context: Any, radius: float | None = None) -> Solution:
        """The best policy, and the mixture's forecast of what it produces.

        The forecast is that of the component which is likeliest given policy and context. A goal
        seems reachable when it lies within the radius of the forecast, the task's tolerance if not
        said, or within twice its spread in every coordinate.
        """
        if self.nearest is not None:
            return self.nearest.solve(goal, context, radius)
        policy = self.best_policy(goal, context)
        known, space = self.kinds[goal.kind], self.spaces[goal.kind]
        forward = known.forward(space.dimension)
        given = self.policy_space.encode(policy)[None]
        if self.context_space is not None:
            given = np.concatenate((self.context_space.encode(context)[None], given), axis=1)
        component = forward.likeliest(given)
        expected = space.decode(forward.centres(given, component)[0])
        spread = np.sqrt((forward.factors[component[0]] ** 2).sum(axis=1)) * space.range
        offset = (expected - goal.point) / space.range
        cost = min(1.0, float(np.sqrt((offset**2).sum())))
        near = bool((np.abs(expected - goal.point) <= 2 * spread).all())
        radius = self.task.tolerances[goal.kind] if radius is None else radius
        return Solution(policy, expected, cost, spread, near or cost <= radius, radius)


class _Kind:
    """What is known of one kind: its mixture, and the trials not yet learned from."""

    def __init__(self) -> None:
        self.mixture: GaussianMixture | None = None
        self.inverse: Conditional | None = None
        self.produced: GaussianMixture | None = None
        self.recent: FloatArray = np.empty((0, 0))
        self.waiting: list[tuple[Any, Any, Any]] = []
        self._forward: Conditional | None = None

    def replace(self, mixture: GaussianMixture, given: int) -> None:
        """Take a new mixture, over ``given`` coordinates of outcome and context, and policies."""
        self.mixture, self.inverse = mixture, Conditional(mixture, given)
        self._forward = None

    def forward(self, outcome: int) -> Conditional:
        """The distribution of outcomes, the first coordinates, given the others."""
        assert self.mixture is not None
        if self._forward is None:
            d = self.mixture.dimension
            order = [*range(outcome, d), *range(outcome)]
            self._forward = Conditional(self.mixture.marginal(order), d - outcome)
        return self._forward


def _box(space: Any, what: str) -> Box:
    if not isinstance(space, Box):
        raise TypeError(f"mixtures need a {what} space that is a Box, got {space!r}")
    return space
