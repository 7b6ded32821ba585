"""The lower level: which policy to try for a goal, and what the learner knows."""

from sgim.policy.answering import Answer, Answering, KernelMean, Nearest, Reliable
from sgim.policy.competence import CompetenceModel, InverseModel, NoAnswerError
from sgim.policy.explorer import Episode, Explorer
from sgim.policy.guided_search import GuidedSearch, guided_trials
from sgim.policy.local_model import LocalModel
from sgim.policy.local_search import LocalSearch
from sgim.policy.mixture_model import Learning, MixtureModel
from sgim.policy.mixture_search import AroundRest, MixtureSearch
from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.population import (
    CovarianceAdaptation,
    MakeDistribution,
    PathIntegral,
    PopulationSearch,
)
from sgim.policy.simple import Mimicry, NoisyNearest, PolicyOfLabel, RandomPolicies
from sgim.policy.ways import ANSWERING, answering_of

__all__ = [
    "ANSWERING",
    "Answer",
    "Answering",
    "AroundRest",
    "CompetenceModel",
    "CovarianceAdaptation",
    "Episode",
    "Explorer",
    "GuidedSearch",
    "InverseModel",
    "Learning",
    "KernelMean",
    "LocalModel",
    "LocalSearch",
    "MakeDistribution",
    "Mimicry",
    "MixtureModel",
    "MixtureSearch",
    "Nearest",
    "NearestModel",
    "NelderMeadSearch",
    "NoAnswerError",
    "NoisyNearest",
    "PolicyOfLabel",
    "PathIntegral",
    "PopulationSearch",
    "RandomPolicies",
    "Reliable",
    "answering_of",
    "guided_trials",
]
