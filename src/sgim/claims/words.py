"""What tables say of a finding and of a verdict."""

from __future__ import annotations

from sgim.claims.claim import Verdict
from sgim.claims.components import Finding
from sgim.statistics import Estimate
from sgim.statistics.words import interval


def effect_words(finding: Finding) -> str:
    """How large an effect is: the ratio (×), or the difference of shares in points."""
    effect = finding.effect
    if finding.component.one.unit != "share":
        return f"× {interval(effect)}"
    points = Estimate(100 * effect.value, 100 * effect.low, 100 * effect.high)
    return f"{interval(points, '+')} points"


def p_words(p: float) -> str:
    """A p-value in two digits."""
    return f"{p:.2g}"


def holm_words(verdict: Verdict) -> str:
    """A claim's p-value after correction; a dash for one without, or that is contradicted."""
    if verdict.p_holm is None or verdict.word == "contradicted":
        return "–"
    return p_words(verdict.p_holm)
