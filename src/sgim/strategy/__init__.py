"""The upper level: which sampling mode, which teacher, when."""

from sgim.strategy.imitation import FixedFrequency, ProgressRatio
from sgim.strategy.modes import Mode
from sgim.strategy.news import News
from sgim.strategy.presentation import Presentation
from sgim.strategy.schedules import DemonstrationsFirst, RestFirst, RoundRobin
from sgim.strategy.situation import Choice, Situation
from sgim.strategy.strategy import Aimless, JointChoice, Strategy

__all__ = [
    "Aimless",
    "Choice",
    "DemonstrationsFirst",
    "FixedFrequency",
    "JointChoice",
    "Mode",
    "News",
    "Presentation",
    "ProgressRatio",
    "RestFirst",
    "RoundRobin",
    "Situation",
    "Strategy",
]
