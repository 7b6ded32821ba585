"""The middle level: which goal to aim at, by competence, progress and interest."""

from sgim.outcome.absolute_progress import AbsoluteProgress
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.interest import EpisodeReport, Favourite, InterestMap, UniformGoals
from sgim.outcome.mixture_interest import MixtureInterest
from sgim.outcome.progress import CompetenceChange, InterestMeasure, MeanProgress, Record
from sgim.outcome.region_tree import RegionTree
from sgim.outcome.table import InterestTable
from sgim.outcome.within_reach import WithinReach

__all__ = [
    "AbsoluteProgress",
    "CompetenceChange",
    "EpisodeReport",
    "ExpectedGain",
    "Favourite",
    "InterestMap",
    "InterestMeasure",
    "InterestTable",
    "MeanProgress",
    "MixtureInterest",
    "Record",
    "RegionTree",
    "UniformGoals",
    "WithinReach",
]
