"""Numbers and estimates in words."""

from __future__ import annotations

from sgim.statistics.bootstrap import Estimate


def number(value: float, sign: str = "") -> str:
    """A number in three digits; a dash for one that is not known."""
    return f"{value:{sign}.3g}" if value == value else "–"


def interval(estimate: Estimate, sign: str = "") -> str:
    """A value with its interval in brackets, if it has one."""
    value, low, high = (float(x) for x in (estimate.value, estimate.low, estimate.high))
    if low != low:
        return number(value, sign)
    return f"{number(value, sign)} [{number(low)}, {number(high)}]"
