"""Interest as a mixture over recent time, goals and competence: G_IM of section 5.2.3."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from sgim.mixtures import GaussianMixture, fit
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.mixture_goals import MixtureGoals, Source
from sgim.records import Goal
from sgim.spaces import FloatArray, Space
from sgim.streams import Streams

Weighting = Literal["covariance", "correlation", "none"]
Produced = Callable[[str], GaussianMixture | None]
Recent = Callable[[str], FloatArray]

_FEWEST = 20  # Episodes of a kind, from which on a mixture is fitted.
_FLOOR = 1e-4  # Variance added in each direction of time, unit box and competence.
_SWEEPS = 20
_NEGLIGIBLE = 1e-9  # Beside the total of the weights: what a component without progress keeps.


class MixtureInterest(MixtureGoals):
    """Goals where competence has lately grown over time (section 5.2.3, algorithms 5.2.1, 5.2.2).

    From the last ``window`` episodes, every ``every`` episodes, a mixture is fitted to time, goal
    and competence (and mode, and context) by classical EM. Each component's weight is multiplied
    by the positive part of its covariance between time and competence, and the goals' marginal
    of that mixture is what goals are drawn from. Where no component has any progress, the
    weights remain as they are.

    Until the first fit, goals are what the first trials have ``produced``.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ, by which interest is divided.
        streams: Random streams, for the fits.
        context_space: The task's context space if there is one; it must be a `Box`.
        produced: A kind's outcomes in the first trials, in the unit box, as a mixture; or None.
        recent: A kind's latest outcomes in the unit box, shape ``(n, d)``.
        components: Gaussians in each mixture.
        window: How many of the latest episodes of a kind count.
        every: Episodes between two fits.
        weighting: Whether weights are multiplied by the ``covariance`` of time and competence, by
            their ``correlation``, or by ``none``, the control without progress.
        uniform_share: Probability that goal and mode are drawn from all alike instead.
        recent_share: Probability that a goal is a recent outcome, with noise, instead.
        recent_noise: Standard deviation of that noise in the unit box.
        random_modes: Probability that the mode is drawn from all alike.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        streams: Streams,
        *,
        context_space: Space | None = None,
        produced: Produced | None = None,
        recent: Recent | None = None,
        components: int = 6,
        window: int = 2000,
        every: int = 400,
        weighting: Weighting = "covariance",
        uniform_share: float = 0.0,
        recent_share: float = 0.0,
        recent_noise: float = 0.05,
        random_modes: float = 0.0,
    ) -> None:
        super().__init__(goal_spaces, modes, context_space, uniform_share)
        self.streams = streams
        self.produced = produced
        self.recent = recent
        self.components = components
        self.window = window
        self.every = every
        self.weighting = weighting
        self.recent_share = recent_share
        self.recent_noise = recent_noise
        self.random_modes = random_modes
        self.episodes = 0
        self._histories = {kind: _History(self.width(kind) + 1) for kind in self.spaces}

    def update(self, report: EpisodeReport) -> None:
        """Note the competence reached for the goal pursued; fit anew at every so manieth."""
        self.episodes += 1
        goal = report.pursued
        if self.usable(report, goal):
            mode = self.modes[report.mode]
            self._histories[goal.kind].waiting.append(
                (goal.point, report.context, mode, report.after)
            )
        if self.episodes % self.every == 0:
            for kind, history in self._histories.items():
                self._fit(kind, history)

    def _fit(self, kind: str, history: _History) -> None:
        if history.waiting:
            points, contexts, modes, competences = zip(*history.waiting, strict=True)
            rows = self.rows(kind, points, contexts, modes)
            history.take(np.column_stack((rows, competences)), self.window)
        if len(history.rows) < _FEWEST:
            return
        n = len(history.rows)
        data = np.column_stack((history.rows, (np.arange(n) + 0.5) / n))
        rng = self.streams(f"interest/mixture/{kind}", self.episodes)
        mixture = fit(data, self.components, rng, floor=_FLOOR, sweeps=_SWEEPS)
        progress = self.progress(mixture) * self.discount(kind, mixture)
        weights = mixture.weights * progress
        total = float(weights.sum())
        if total > 0:
            weights = weights + _NEGLIGIBLE * total * mixture.weights
        goals = mixture.marginal(list(range(self.width(kind))))
        self.sources[kind] = Source(
            goals.reweighted(weights if total > 0 else mixture.weights), self.contexts
        )
        self.kind_weights[kind] = max(total, _NEGLIGIBLE)

    def progress(self, mixture: GaussianMixture) -> FloatArray:
        """What each component's weight is multiplied by, shape ``(k,)``.

        Args:
            mixture: Its last two coordinates are competence and time.
        """
        if self.weighting == "none":
            return np.ones(mixture.components)
        shared = mixture.covariances[:, -1, -2]
        if self.weighting == "correlation":
            squares = mixture.covariances[:, -1, -1] * mixture.covariances[:, -2, -2]
            shared = shared / np.sqrt(squares)
        progress: FloatArray = np.maximum(shared, 0.0)
        return progress

    def amendments(
        self, rng: np.random.Generator, kind: str, modes: Sequence[str]
    ) -> tuple[Goal | None, str | None]:
        """A recent outcome with noise for a goal, and any mode, as often as was said."""
        goal = mode = None
        if self.random_modes and len(modes) > 1 and rng.random() < self.random_modes:
            mode = modes[int(rng.integers(len(modes)))]
        if self.recent_share and self.recent is not None and rng.random() < self.recent_share:
            outcomes = self.recent(kind)
            if len(outcomes):
                noise = self.recent_noise * rng.standard_normal(outcomes.shape[1])
                point = outcomes[int(rng.integers(len(outcomes)))] + noise
                goal = Goal(kind, self.spaces[kind].decode(np.clip(point, 0.0, 1.0)))
        return goal, mode

    def first(self, rng: np.random.Generator, modes: Sequence[str]) -> tuple[Goal, str]:
        """A goal before the first fit: what was produced, or any if that is not known."""
        anything = self.uniform(rng, modes)
        known = self.produced and {k: m for k in self.spaces if (m := self.produced(k))}
        if not known:
            return anything
        kind = list(known)[int(rng.integers(len(known)))]
        point = np.clip(known[kind].sample(rng, 1)[0], 0.0, 1.0)
        return Goal(kind, self.spaces[kind].decode(point)), anything[1]


class _History:
    """The latest episodes of a kind: coordinates and competence; and those not yet among them."""

    def __init__(self, width: int) -> None:
        self.rows = np.empty((0, width))
        self.waiting: list[tuple[Any, Any, int, float]] = []

    def take(self, rows: FloatArray, window: int) -> None:
        """Take in what was waiting, and forget what is older than the window."""
        self.rows = np.concatenate((self.rows, rows))[-window:]
        self.waiting = []
