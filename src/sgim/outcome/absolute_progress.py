"""Interest as a mixture over goals and absolute learning progress: ALP-GMM."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any

import numpy as np

from sgim.memory.neighbours import NearestNeighbours
from sgim.mixtures import fit_by_criterion
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.mixture_goals import MixtureGoals, Source
from sgim.spaces import Space
from sgim.streams import Streams

_FEWEST = 20  # Episodes of a kind, from which on a mixture is fitted.
_FLOOR = 1e-4  # Variance added in each direction of the unit box and of progress.
_SWEEPS = 30


class AbsoluteProgress(MixtureGoals):
    """Goals where competence has lately changed most, up or down (Portelas et al. 2019).

    The progress of an episode is the absolute difference of its competence and that of the nearest
    earlier goal of its mode, of all there were. Every ``every`` episodes, mixtures over goal (and
    context, and mode) and progress are fitted to the last ``window`` episodes, the number of
    components chosen by Akaike's criterion. A component is drawn in proportion to its mean
    progress, divided by its modes' costs, and a goal from that component.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        modes: Mode name → cost κ.
        streams: Random streams, for the fits.
        context_space: The task's context space if there is one; it must be a `Box`.
        most: Most components; at least two are tried.
        window: How many of the latest episodes of a kind count.
        every: Episodes between two fits.
        random_share: Probability of any goal and mode, all alike, instead.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        modes: Mapping[str, float],
        streams: Streams,
        *,
        context_space: Space | None = None,
        most: int = 10,
        window: int = 250,
        every: int = 250,
        random_share: float = 0.2,
    ) -> None:
        super().__init__(goal_spaces, modes, context_space, random_share)
        self.streams = streams
        self.most = most
        self.every = every
        self.episodes = 0
        pairs = [(kind, mode) for kind in self.spaces for mode in self.modes]
        self._earlier = {
            pair: NearestNeighbours(self.contexts + self.spaces[pair[0]].dimension)
            for pair in pairs
        }
        self._competences: dict[tuple[str, str], list[float]] = {pair: [] for pair in pairs}
        self._recent = {kind: deque[_Episode](maxlen=window) for kind in self.spaces}

    def update(self, report: EpisodeReport) -> None:
        """Note an episode's progress; fit anew at every so manieth."""
        self.episodes += 1
        goal = report.pursued
        if self.usable(report, goal):
            mode = self.modes[report.mode]
            place = self.rows(goal.kind, [goal.point], [report.context], [mode])
            known = self._earlier[goal.kind, report.mode]
            competences = self._competences[goal.kind, report.mode]
            key = place[0, : self.contexts + self.spaces[goal.kind].dimension]
            progress = 0.0
            if competences:
                nearest = int(known.query(key, 1)[1][0])
                progress = abs(report.after - competences[nearest])
            known.extend(key[None])
            competences.append(report.after)
            self._recent[goal.kind].append((goal.point, report.context, mode, progress))
        if self.episodes % self.every == 0:
            for kind, recent in self._recent.items():
                if len(recent) >= _FEWEST:
                    self._fit(kind, recent)

    def _fit(self, kind: str, recent: deque[_Episode]) -> None:
        points, contexts, modes, progress = zip(*recent, strict=True)
        data = np.column_stack((self.rows(kind, points, contexts, modes), progress))
        rng = self.streams(f"interest/mixture/{kind}", self.episodes)
        numbers = range(2, max(3, min(self.most, len(recent) // _FEWEST) + 1))
        mixture = fit_by_criterion(data, numbers, rng, floor=_FLOOR, sweeps=_SWEEPS)
        weights = np.maximum(mixture.means[:, -1], 0.0) * self.discount(kind, mixture)
        total = float(weights.sum())
        goals = mixture.marginal(list(range(self.width(kind))))
        self.sources[kind] = Source(
            goals.reweighted(weights if total > 0 else mixture.weights), self.contexts
        )
        self.kind_weights[kind] = max(float(mixture.weights @ weights), 1e-9)


_Episode = tuple[Any, Any, int, float]
