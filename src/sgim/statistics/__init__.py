"""Statistics of runs: pure functions on arrays, which know nothing of journals or learners."""

from __future__ import annotations

from sgim.statistics.bootstrap import (
    Estimate,
    bootstrap_interval,
    contrast_estimates,
    interquartile_estimate,
    profile_estimate,
)
from sgim.statistics.change_points import stages
from sgim.statistics.effects import probability_lower, rank_biserial
from sgim.statistics.significance import (
    equivalence_p,
    holm,
    least_pairs,
    less_margin,
    mann_whitney_p,
    mean_vector_p,
    not_higher_p,
    signed_rank_p,
)
from sgim.statistics.summaries import area_under_curve, interquartile_mean, performance_profile

__all__ = [
    "Estimate",
    "area_under_curve",
    "bootstrap_interval",
    "contrast_estimates",
    "equivalence_p",
    "holm",
    "interquartile_estimate",
    "interquartile_mean",
    "least_pairs",
    "less_margin",
    "mann_whitney_p",
    "mean_vector_p",
    "not_higher_p",
    "performance_profile",
    "probability_lower",
    "profile_estimate",
    "rank_biserial",
    "signed_rank_p",
    "stages",
]
