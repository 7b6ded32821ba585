"""The lower level: which policy to try for a goal, and what the learner knows."""

from sgim.policy.explorer import Episode, Explorer
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import CompetenceModel, InverseModel, NearestModel, NoAnswerError
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.simple import Mimicry, NoisyNearest, PolicyOfLabel, RandomPolicies

__all__ = [
    "CompetenceModel",
    "Episode",
    "Explorer",
    "InverseModel",
    "LocalSearch",
    "Mimicry",
    "NearestModel",
    "NelderMeadSearch",
    "NoAnswerError",
    "NoisyNearest",
    "PolicyOfLabel",
    "RandomPolicies",
]
