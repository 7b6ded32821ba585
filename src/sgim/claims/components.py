"""One test of a claim: a measure against another, over the seeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from sgim.claims.measures import JointMeasure, Measure, Unit, learners_of
from sgim.claims.world import World
from sgim.runs.contrasts import common_seeds
from sgim.spaces import FloatArray
from sgim.statistics import (
    Estimate,
    contrast_estimates,
    equivalence_p,
    less_margin,
    mann_whitney_p,
    not_higher_p,
    probability_lower,
    rank_biserial,
    signed_rank_p,
)
from sgim.streams import Streams

Measured = Measure | JointMeasure

Relation = Literal["lower", "not higher", "equal", "reaches", "steadier"]

MARGINS: dict[Unit, float] = {"error": 0.2, "count": 0.2, "share": 0.1}
"""By how much equal ones may differ: a share of the larger one; ten percentage points."""

_SIGNS: dict[Relation, str] = {
    "lower": "<",
    "not higher": "<≈",
    "equal": "≈",
    "reaches": "≲",
    "steadier": "varies less than",
}


@dataclass(frozen=True)
class Component:
    """A measure, how it should be to another, and that other. Made by the functions below.

    Attributes:
        one: What is measured.
        relation: ``lower``; ``not higher``, which is lower or higher by less than the margin;
            ``equal``, within the margin; ``reaches``, where the interval of the ratio reaches
            down to ``times``; or ``steadier``, nearer to its own median.
        other: What it is compared with: of another learner, another time of the same run, or a
            constant.
        times: By which the other is multiplied before: to be at most half of it is .5.
    """

    one: Measured
    relation: Relation
    other: Measured | float
    times: float = 1.0

    def __str__(self) -> str:
        sign = _SIGNS[self.relation] + (f" {self.times:g} ×" if self.times != 1 else "")
        one, other = self.one, self.other
        if isinstance(other, float):
            return f"{one.learner}: {one.what} {sign} {other:.3g}"
        if one.learner == other.learner:
            return f"{one.learner}: {one.what} {sign} {other.what}"
        if one.what == other.what:
            return f"{one.what}: {one.learner} {sign} {other.learner}"
        return f"{one.what} of {one.learner} {sign} {other.what} of {other.learner}"

    @property
    def learners(self) -> list[str]:
        """Whose runs it needs."""
        measures = (m for m in (self.one, self.other) if not isinstance(m, float))
        return [learner for measure in measures for learner in learners_of(measure)]

    @property
    def margin(self) -> float | None:
        """The margin of the test; None if it has none."""
        return MARGINS[self.one.unit] if self.relation in ("not higher", "equal") else None

    def test(self, world: World, streams: Streams, notes: list[str]) -> Finding:
        """Decide it in a world that has its learners.

        Args:
            world: The runs.
            streams: For resampling.
            notes: What a reader should know is added to these.
        """
        seeds, one, other = self._values(world, notes)
        paired = seeds is not None
        if not len(one) or not len(other):
            notes.append(f"{self}: no run has both, so nothing is shown")
            none = Estimate(*[np.array(np.nan)] * 3)
            return Finding(self, seeds, one, other, none, none, 1.0, 0.0)
        if self.relation == "steadier":
            one, other = (np.abs(values - np.median(values)) for values in (one, other))
            seeds, paired = None, False
        rng = streams(f"bootstrap/claim/{self}")
        difference, ratio = contrast_estimates(one, other, rng, paired=paired)
        if self.relation == "reaches":
            reached = bool(ratio.low <= self.times)
            p, direction = (0.0, 1.0) if reached else (1.0, -1.0)
        else:
            p, direction = self._compare(one, self.times * other, paired)
        return Finding(self, seeds, one, other, difference, ratio, p, direction)

    def _values(
        self, world: World, notes: list[str]
    ) -> tuple[list[int | None] | None, FloatArray, FloatArray]:
        """Seeds of the pairs, None if there are no pairs, and the numbers of both."""
        ones = world.values(self.one)
        if isinstance(self.other, float):
            others = dict.fromkeys(ones, self.other)
        else:
            others = world.values(self.other)
        left = {s for values in (ones, others) for s, x in values.items() if x != x}
        if left:
            named = ", ".join(sorted(map(str, left)))
            notes.append(f"{self}: without seeds {named}, which have no such episodes")
        kept, kept_others = ([s for s in values if s not in left] for values in (ones, others))
        pair = " and ".join(dict.fromkeys(self.learners))
        seeds = common_seeds(pair, kept, kept_others, notes)
        if seeds is not None:
            kept = kept_others = [seed for seed in kept if seed in {*seeds}]
        return (
            seeds,
            np.array([ones[seed] for seed in kept], dtype=np.float64),
            np.array([others[seed] for seed in kept_others], dtype=np.float64),
        )

    def _compare(self, one: FloatArray, other: FloatArray, paired: bool) -> tuple[float, float]:
        """P-value, and how clearly the test points the way of the claim, from −1 to 1."""
        if self.relation in ("lower", "steadier"):
            p = signed_rank_p(one - other) if paired else mann_whitney_p(one, other)
            return p, _above(other, one, paired)
        margin, relative = MARGINS[self.one.unit], self.one.unit != "share"
        below = _above(other, less_margin(one, margin, relative), paired)
        if self.relation == "not higher":
            return not_higher_p(one, other, margin, paired=paired, relative=relative), below
        above = _above(one, less_margin(other, margin, relative), paired)
        p = equivalence_p(one, other, margin, paired=paired, relative=relative)
        return p, min(below, above)


@dataclass(frozen=True)
class Finding:
    """What a component came to.

    Attributes:
        component: The component.
        seeds: Those by which runs are paired; None if they are not.
        one: The numbers compared, one a run.
        other: Those they are compared with.
        difference: Of the interquartile means.
        ratio: Of the interquartile means; NaN where the other is 0.
        p: P-value: two-sided for ``lower`` and ``steadier``, one-sided for margins, as is usual;
            0 or 1 for ``reaches``, which is a rule and not a test.
        direction: Rank-biserial correlation in favour of the claim, from −1 to 1. It is that of
            the test, so that it cannot contradict the p-value.
    """

    component: Component
    seeds: list[int | None] | None
    one: FloatArray
    other: FloatArray
    difference: Estimate
    ratio: Estimate
    p: float
    direction: float

    @property
    def p_of_claim(self) -> float:
        """The p-value with which it counts in its claim: 1 if the direction is not right."""
        return self.p if self.direction > 0 else 1.0

    @property
    def effect(self) -> Estimate:
        """How large it is: the ratio of errors or counts, or the difference of shares."""
        return self.difference if self.component.one.unit == "share" else self.ratio

    @property
    def runs(self) -> str:
        """How many runs were compared."""
        if isinstance(self.component.other, float) or len({*self.component.learners}) == 1:
            return f"{len(self.one)} runs"
        if self.seeds is None:
            return f"{len(self.one)}, {len(self.other)}"
        return f"{len(self.one)} pairs"

    def as_json(self, *, numbers: bool) -> dict[str, Any]:
        """What it says, JSON-compatible.

        Args:
            numbers: Whether to add the numbers of each run, and what the test is in detail.
        """
        component = self.component
        found: dict[str, Any] = {
            "component": str(component),
            "unit": component.one.unit,
            "effect": self.effect.as_json(),
            "p": self.p,
            "n": self.runs,
        }
        if numbers:
            found |= {
                "relation": component.relation,
                "times": component.times,
                "margin": component.margin,
                "learners": component.learners,
                "seeds": self.seeds,
                "one": self.one.tolist(),
                "other": self.other.tolist(),
                "difference": self.difference.as_json(),
                "ratio": self.ratio.as_json(),
                "direction": self.direction,
            }
        return found


def lower(one: Measured, other: Measured | float, times: float = 1.0) -> Component:
    """One is lower than so many times the other: Wilcoxon or Mann and Whitney, two-sided."""
    return Component(one, "lower", other, times)


def not_higher(one: Measured, other: Measured | float) -> Component:
    """One is lower than the other, or higher by less than the margin: one-sided."""
    return Component(one, "not higher", other)


def equal(one: Measured, other: Measured | float) -> Component:
    """The two differ by less than the margin: two one-sided tests."""
    return Component(one, "equal", other)


def reaches(one: Measure, other: Measure, times: float) -> Component:
    """The 95 % interval of their ratio reaches down to so much: a rule, beside a test."""
    return Component(one, "reaches", other, times)


def steadier(one: Measure, other: Measure) -> Component:
    """One varies less between runs: distances to the own median, by Mann and Whitney."""
    return Component(one, "steadier", other)


def _above(high: FloatArray, low: FloatArray, paired: bool) -> float:
    """The rank-biserial correlation, 1 if all high ones are above the low ones."""
    if paired:
        return rank_biserial(high - low)
    return 1 - 2 * probability_lower(high, low, paired=False)
