"""The lower level: which policy to try for a goal, and what the learner knows."""

from sgim.policy.answering import Answer, Answering, KernelMean, Nearest, Reliable
from sgim.policy.explorer import Episode, Explorer
from sgim.policy.local_model import LocalModel
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import CompetenceModel, InverseModel, NearestModel, NoAnswerError
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.simple import Mimicry, NoisyNearest, RandomPolicies
from sgim.policy.ways import ANSWERING, answering_of

__all__ = [
    "ANSWERING",
    "Answer",
    "Answering",
    "CompetenceModel",
    "Episode",
    "Explorer",
    "InverseModel",
    "KernelMean",
    "LocalModel",
    "LocalSearch",
    "Mimicry",
    "Nearest",
    "NearestModel",
    "NelderMeadSearch",
    "NoAnswerError",
    "NoisyNearest",
    "RandomPolicies",
    "Reliable",
    "answering_of",
]
