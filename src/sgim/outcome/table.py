"""Interest over labels and modes: one entry for each pair (thesis algorithms 2.2.2 and 2.2.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

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
        each_first: Whether every pair is tried once before any is preferred, in random order. The
            records of a pair then begin with the competence from before its first episode, so that
            one episode is enough to show progress.
        pick: ``"proportional"``: pairs are drawn with probabilities proportional to their interest;
            ``"argmax"``: the most interesting is taken, of equals one at random.
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
        each_first: bool = False,
        pick: Literal["proportional", "argmax"] = "proportional",
    ) -> None:
        self.kind = kind
        self.labels = labels
        self.costs = dict(modes)
        self.measure = measure
        self.uniform = uniform
        self.each_first = each_first
        self.pick = pick
        pairs = [(label, mode) for label in labels.labels for mode in modes]
        self.records: dict[tuple[str, str], list[Record]] = {pair: [] for pair in pairs}
        self.interest = {(label, mode): prior / modes[mode] for label, mode in pairs}

    def update(self, report: EpisodeReport) -> None:
        """Add the episode's competence to its label and mode (algorithm 2.2.2)."""
        pair = (report.pursued.point, report.mode)
        if report.pursued.kind != self.kind or pair not in self.records:
            return
        if self.each_first and not self.records[pair]:
            self.records[pair].append(Record((), 0.0, report.before))
        record = Record((), self.measure.progress(report), report.after)
        self.records[pair].append(record)
        interest = self.measure.interest(self.records[pair])
        self.interest[pair] = interest / self.costs[report.mode]

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        """Draw a pair by its interest, or any with probability p₁ (algorithm 2.2.3)."""
        pairs = [(label, mode) for label in self.labels.labels for mode in modes]
        if self.each_first:
            untried = [pair for pair in pairs if not self.records[pair]]
            if untried:
                label, mode = untried[int(rng.integers(len(untried)))]
                return Goal(self.kind, label), mode
        weights = np.array([self.interest[pair] for pair in pairs])
        weights -= weights.min()
        if rng.random() < self.uniform or not weights.sum() > 0:
            weights = np.ones(len(pairs))
        elif self.pick == "argmax":
            weights = (weights == weights.max()).astype(np.float64)
        label, mode = pairs[int(rng.choice(len(pairs), p=weights / weights.sum()))]
        return Goal(self.kind, label), mode
