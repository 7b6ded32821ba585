"""Interest over labels and modes: one entry for each pair (thesis algorithms 2.2.2 and 2.2.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from sgim.outcome.interest import EpisodeReport
from sgim.outcome.progress import InterestMeasure, Record
from sgim.records import Goal
from sgim.spaces import Choices


class InterestTable:
    """A table of interests over the labels of one goal kind and the modes.

    Args:
        kind: The goal kind.
        labels: Its space.
        modes: Mode name → cost κ, by which interest is divided.
        measure: Turns records into interest.
        uniform: Probability of any label and mode, all alike (p₁).
        prior: Interest of pairs not yet tried, before division by the cost.
    """

    def __init__(
        self,
        kind: str,
        labels: Choices,
        modes: Mapping[str, float],
        measure: InterestMeasure,
        *,
        uniform: float = 0.2,
        prior: float = 0.3,
    ) -> None:
        self.kind = kind
        self.labels = labels
        self.costs = dict(modes)
        self.measure = measure
        self.uniform = uniform
        pairs = [(label, mode) for label in labels.labels for mode in modes]
        self.records: dict[tuple[str, str], list[Record]] = {pair: [] for pair in pairs}
        self.interest = {(label, mode): prior / modes[mode] for label, mode in pairs}

    def update(self, report: EpisodeReport) -> None:
        """Add the episode's competence to its label and mode (algorithm 2.2.2)."""
        pair = (report.pursued.point, report.mode)
        if report.pursued.kind != self.kind or pair not in self.records:
            return
        record = Record((), self.measure.progress(report), report.after)
        self.records[pair].append(record)
        interest = self.measure.interest(self.records[pair])
        self.interest[pair] = interest / self.costs[report.mode]

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Draw a pair with probability proportional to its interest (algorithm 2.2.3)."""
        pairs = [(label, mode) for label in self.labels.labels for mode in modes]
        weights = np.array([self.interest[pair] for pair in pairs])
        weights -= weights.min()
        if rng.random() < self.uniform or not weights.sum() > 0:
            weights = np.ones(len(pairs))
        label, mode = pairs[int(rng.choice(len(pairs), p=weights / weights.sum()))]
        return Goal(self.kind, label), mode
