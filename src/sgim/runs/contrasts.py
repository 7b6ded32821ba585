"""A learner against another, over their seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.runs.measured import MeasuredRun
from sgim.spaces import FloatArray
from sgim.statistics import (
    Estimate,
    contrast_estimates,
    equivalence_p,
    holm,
    least_pairs,
    mann_whitney_p,
    performance_profile,
    probability_lower,
    rank_biserial,
    signed_rank_p,
)
from sgim.streams import Streams

LEVEL = 0.05
"""Level of the verdicts, after correction."""

FEWEST_COMMON = 6
"""Common seeds from which learners with different seeds are paired: fewer can show nothing."""

TESTS = {
    True: "Wilcoxon signed-rank, paired by seed",
    False: "Mann–Whitney, not paired",
}
EQUIVALENCE = "two one-sided tests, each as for the difference"


@dataclass(frozen=True)
class Group:
    """A learner over its seeds.

    Attributes:
        name: Its name in the comparison.
        runs: Its runs, in the order of their seeds.
        errors: At the common evaluations, shape ``(runs, evaluations)``.
        median: Of the errors at the last of them.
        middle: Interquartile mean of these, with its interval.
        area: Interquartile mean of the runs' mean errors over movements, with its interval.
        curve: Interquartile mean at each evaluation, with its pointwise interval.
    """

    name: str
    runs: tuple[MeasuredRun, ...]
    errors: FloatArray
    median: float
    middle: Estimate
    area: Estimate
    curve: Estimate

    @property
    def last(self) -> FloatArray:
        """The errors compared, one a run."""
        return self.errors[:, -1]

    @property
    def seeds(self) -> list[int | None]:
        """The seeds of its runs."""
        return [run.seed for run in self.runs]

    def as_json(self, thresholds: FloatArray) -> dict[str, Any]:
        """Everything, JSON-compatible, with the profile at these errors."""
        return {
            "name": self.name,
            "learner": self.runs[0].learner,
            "configuration": self.runs[0].configuration,
            "seeds": self.seeds,
            "journals": [str(run.path) for run in self.runs],
            "errors": self.errors.tolist(),
            "median": self.median,
            "iqm": self.middle.as_json(),
            "area": self.area.as_json(),
            "curve": self.curve.as_json(),
            "profile": performance_profile(self.last, thresholds).tolist(),
        }


@dataclass(frozen=True)
class Contrast:
    """A learner against the reference; differences and ratios are its error over the reference's.

    Attributes:
        name: The learner.
        seeds: Those by which runs are paired; None if they are not.
        counts: Runs used of the learner and of the reference.
        difference: Of the interquartile means.
        ratio: Of the interquartile means; NaN where the reference's is 0.
        p: Two-sided p-value.
        p_holm: Corrected for the number of comparisons.
        equivalence: P-value of equivalence within the margin.
        equivalence_holm: Corrected in the same way.
        lower: How often its error is the lower one (`probability_lower`).
        rank_biserial: `rank_biserial` of the differences if paired; else 2 · (½ − lower).
    """

    name: str
    seeds: list[int | None] | None
    counts: tuple[int, int]
    difference: Estimate
    ratio: Estimate
    p: float
    p_holm: float
    equivalence: float
    equivalence_holm: float
    lower: float
    rank_biserial: float

    @property
    def verdict(self) -> str:
        """In a word or two: ``lower`` or ``higher``, ``equivalent``, or ``undecided``."""
        words = []
        if self.p_holm < LEVEL:
            words.append("lower" if self.rank_biserial < 0 else "higher")
        if self.equivalence_holm < LEVEL:
            words.append("equivalent")
        return " but ".join(words) or "undecided"

    def as_json(self) -> dict[str, Any]:
        """Everything, JSON-compatible."""
        return {
            "name": self.name,
            "test": TESTS[self.seeds is not None],
            "seeds": self.seeds,
            "runs": list(self.counts),
            "difference": self.difference.as_json(),
            "ratio": self.ratio.as_json(),
            "p": self.p,
            "p_holm": self.p_holm,
            "equivalence_test": EQUIVALENCE,
            "equivalence_p": self.equivalence,
            "equivalence_p_holm": self.equivalence_holm,
            "probability_lower": self.lower,
            "rank_biserial": self.rank_biserial,
            "verdict": self.verdict,
        }


def contrast_all(
    others: Sequence[Group],
    reference: Group,
    margin: float,
    streams: Streams,
    notes: list[str],
) -> list[Contrast]:
    """Each of these learners against one, with p-values corrected for their number.

    Args:
        others: The learners.
        reference: What they are compared with.
        margin: By which share of the larger error equivalent learners may differ.
        streams: For the resampling.
        notes: What a reader should know is added to these.
    """
    found = [_against(group, reference, margin, streams, notes) for group in others]
    corrected = holm([facts["p"] for facts in found])
    equivalences = holm([facts["equivalence"] for facts in found])
    needed = least_pairs(len(found))
    if any(f["seeds"] is not None and len(f["seeds"]) < needed for f in found):
        notes.append(
            f"{needed} seeds or more are needed for a difference to show after correction for "
            f"{len(found)} comparison{'s' * (len(found) > 1)}; run more seeds"
        )
    return [
        Contrast(**facts, p_holm=p, equivalence_holm=equivalence)
        for facts, p, equivalence in zip(found, corrected, equivalences, strict=True)
    ]


def _against(
    group: Group, reference: Group, margin: float, streams: Streams, notes: list[str]
) -> dict[str, Any]:
    """The facts of a contrast, but for corrections."""
    pair = f"{group.name} and {reference.name}"
    seeds = common_seeds(pair, group.seeds, reference.seeds, notes)
    one, other = group.last, reference.last
    if seeds is not None:
        one, other = _of_seeds(group, seeds), _of_seeds(reference, seeds)
    paired = seeds is not None
    rng = streams(f"bootstrap/{group.name}/{reference.name}")
    difference, ratio = contrast_estimates(one, other, rng, paired=paired)
    lower = probability_lower(one, other, paired=paired)
    return {
        "name": group.name,
        "seeds": seeds,
        "counts": (len(one), len(other)),
        "difference": difference,
        "ratio": ratio,
        "p": signed_rank_p(one - other) if paired else mann_whitney_p(one, other),
        "equivalence": equivalence_p(one, other, margin, paired=paired),
        "lower": lower,
        "rank_biserial": rank_biserial(one - other) if paired else 1 - 2 * lower,
    }


def common_seeds(
    pair: str, ones: Sequence[int | None], others: Sequence[int | None], notes: list[str]
) -> list[int | None] | None:
    """The seeds by which the runs of two are paired; None if they are not.

    Args:
        pair: What the two are called in a note, such as ``"sgim-acts and random"``.
        ones: Seeds of the runs of one.
        others: Seeds of the runs of the other.
        notes: What is not plain is added to these.
    """
    if None in ones or None in others:
        notes.append(f"{pair} are not paired: some of their journals do not say their seed")
        return None
    if [*ones] == [*others]:
        return [*ones]
    common = [seed for seed in ones if seed in {*others}]
    if len(common) >= FEWEST_COMMON:
        notes.append(f"{pair} have different seeds: compared on the {len(common)} they share")
        return common
    notes.append(f"{pair} have different seeds, {len(common)} in common: not paired")
    return None


def _of_seeds(group: Group, seeds: Sequence[int | None]) -> FloatArray:
    by_seed: Mapping[int | None, float] = dict(zip(group.seeds, group.last, strict=True))
    return np.array([by_seed[seed] for seed in seeds])
