"""Goal-directed search that a learned map of the whole guides while trials are few."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.memory.memory import KindMemory
from sgim.policy.around import taken
from sgim.policy.explorer import Episode
from sgim.policy.local_search import LocalSearch
from sgim.policy.outcome_map import OutcomeMap, with_context
from sgim.policy.smoothness import Smoothness
from sgim.records import Trial
from sgim.spaces import FloatArray

OPERATIONS_PER_SECOND = 1e9
"""By which seconds are turned into trials: few for a computer of today."""

MOST_TRIALS = 4000
"""How many trials are guided at most: the map takes 8 bytes for each pair of twice so many."""

_NEVER_TOO_FAR = 0.25  # By the metric: variations of so much are allowed in any case.
_LEARNING = 3e8  # Operations of learning how smooth the map is, which needs a few neighbourhoods.


def guided_trials(seconds: float) -> int:
    """How many trials a map can guide, if every decision is to take no longer than so many seconds.

    The costliest decision is the one at which the map of n trials is made anew: 2 n³ operations to
    invert their covariance, and 3 · 10⁸ to learn how smooth the map is. It is allowed while that is
    at most `OPERATIONS_PER_SECOND` times the seconds. So the number depends on what is stated, and
    not on how fast the computer happens to be: the same run comes out everywhere.

    Args:
        seconds: What a trial may take to decide.
    """
    spare = max(OPERATIONS_PER_SECOND * seconds - _LEARNING, 0.0)
    return int(min((spare / 2) ** (1 / 3), MOST_TRIALS))


class GuidedSearch:
    """Asks a map from policies to outcomes what to try, while trials are few; then `LocalSearch`.

    The map is a Gaussian process over all trials so far (`OutcomeMap`), whose constants are learned
    again whenever there are twice as many. The policy that it expects to come nearest to the goal
    is varied by as much as should change the outcome by about what is lacking, but not so far that
    the map says nothing of it (a quarter of the box's side is never too far), and no less than
    noise does, since nothing could be learned from less. Of a few variations the one is tried whose
    outcome is the least certain.

    With few trials each is worth much, and a map over all of them foresees more than one over the
    few nearest; with many it would cost more than it brings. Where the map shows nothing, or misses
    as if outcomes jumped (`Smoothness.guides`), and for kinds of outcome that were hardly produced
    yet, the local search decides.

    Args:
        local: The search for later; its model is this one's too.
        trials: How many remembered trials are few; `guided_trials` tells it from seconds.
        if_noisy: How many are few at least, unless the world is known to be deterministic.
        near_outcomes: Of so many trials with the nearest outcomes the map takes its first guess.
        variation: Smallest and largest size of the variation's effect on the outcome, as a share
            of what is lacking.
        most_of_length: How far a variation may be, over the length over which outcomes change: what
            is lacking may be out of reach, and says nothing then. A quarter of the unit box's side
            is never too far.
        above_noise: The least effect, over the standard deviation of noise.
        variations: How many variations to choose among.
        least_global: Probability of a random policy.
    """

    def __init__(
        self,
        local: LocalSearch,
        trials: int = 500,
        *,
        if_noisy: int = 0,
        near_outcomes: int = 8,
        variation: tuple[float, float] = (0.5, 1.5),
        most_of_length: float = 0.15,
        above_noise: float = 2.0,
        variations: int = 8,
        least_global: float = 0.1,
    ) -> None:
        self.local = local
        self.model = local.model
        self.trials = trials
        self.if_noisy = if_noisy
        self.near_outcomes = near_outcomes
        self.variation = variation
        self.most_of_length = most_of_length
        self.above_noise = above_noise
        self.variations = variations
        self.least_global = least_global
        self._maps: dict[KindMemory, OutcomeMap] = {}

    def begin(self, episode: Episode) -> None:
        """Prepare the local search."""
        self.local.begin(episode)

    def begin_all(self, episodes: Sequence[Episode]) -> None:
        """As `begin` for several episodes."""
        self.local.begin_all(episodes)

    def moved(self, episode: Episode) -> None:
        """Tell the local search."""
        self.local.moved(episode)

    def propose(self, episodes: Sequence[Episode]) -> list[Any]:
        """What the map expects to come near, varied; or what the local search proposes."""
        if len(self.model.memory) >= max(self.trials, self.if_noisy):
            self._maps.clear()
            return self.local.propose(episodes)
        policies = [self._proposed(episode) for episode in episodes]
        left = [i for i, policy in enumerate(policies) if policy is None]
        if left:
            unguided = self.local.propose([episodes[i] for i in left])
            for i, policy in zip(left, unguided, strict=True):
                policies[i] = policy
        return policies

    def _proposed(self, episode: Episode) -> Any:
        """The guided proposal for an episode; None if there is no map, or it says nothing."""
        assert episode.goal is not None
        memory, space = self.model.memory.kinds[episode.goal.kind], self.local.space
        if memory.deterministic and len(self.model.memory) >= self.trials:
            return None
        # Of outcomes far beyond all bounds a map may say anything.
        with np.errstate(all="ignore"):
            try:
                known = self._map(memory)
                if known is None:
                    return None
                if episode.rng.random() < self.least_global:
                    point = episode.rng.random(space.dimension)
                else:
                    point = self._varied(episode, memory, known)
            except np.linalg.LinAlgError:
                return None
        if not np.isfinite(point).all():
            return None
        episode.state.take_in()
        episode.state.proposed = point
        return space.decode(point)

    def _map(self, memory: KindMemory) -> OutcomeMap | None:
        """The map of a kind's outcomes, up to date; None if there is none that can guide."""
        smoothness: Smoothness | None = self.model.smoothness(memory)
        if smoothness is None or not smoothness.guides:
            return None
        known = self._maps.get(memory)
        if known is None or known.smoothness is not smoothness:
            first = smoothness.trials
            outcomes, inputs = taken(memory, slice(0, first))
            known = self._maps[memory] = OutcomeMap(smoothness, inputs, outcomes, 2 * first)
        if known.count < len(memory):
            outcomes, inputs = taken(memory, slice(known.count, len(memory)))
            known.extend(inputs, outcomes)
        return known

    def _varied(self, episode: Episode, memory: KindMemory, known: OutcomeMap) -> FloatArray:
        """The policy expected to come nearest to the goal, varied: in the unit box."""
        assert episode.goal is not None
        assert episode.best is not None
        rng, smoothness, dimension = episode.rng, known.smoothness, self.local.space.dimension
        key = self.model.goal_key(episode.goal, episode.context)
        goal, context = key[: memory.dimension], key[memory.dimension :]
        _, rows = memory.nearest(key, self.near_outcomes)
        policy, expected = known.nearing(goal, context, memory.encoded_policies(rows))
        lacking = max(float(np.linalg.norm(expected - goal)), -episode.best)
        signal = math.sqrt(float(smoothness.variance.sum()))
        least, most = self.variation
        effect = lacking * least * (most / least) ** rng.random()
        # How far a policy is to be changed for the outcome to change by so much, by the metric.
        per_effect = smoothness.length / (signal + 1e-300)
        length = min(
            effect * per_effect, max(self.most_of_length * smoothness.length, _NEVER_TOO_FAR)
        )
        length = max(length, self.above_noise * smoothness.deviation * per_effect)
        # A variation of every coordinate by 1 is as long by the metric as their number's root.
        scale = min(length / math.sqrt(dimension), 1.0)
        offsets = scale * rng.standard_normal((self.variations, dimension))
        varied: FloatArray = np.minimum(np.maximum(policy + offsets, 0.0), 1.0)
        _, unknown = known.expected(with_context(varied, context))
        chosen: FloatArray = varied[int(np.argmax(unknown))]
        return chosen

    def learn(self, episode: Episode, trial: Trial, competence: float | None) -> None:
        """Tell the local search; the map learns from memory."""
        self.local.learn(episode, trial, competence)

    def refuse(self, episode: Episode) -> None:
        """Nothing to add: the next variation is drawn anew."""

    def finished(self, episode: Episode) -> bool:
        """Whether the local search would end."""
        return self.local.finished(episode)
