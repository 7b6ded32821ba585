"""The upper level: which sampling mode, which teacher, when."""

from sgim.strategy.modes import Mode
from sgim.strategy.news import News
from sgim.strategy.schedules import DemonstrationsFirst, RoundRobin
from sgim.strategy.strategy import Aimless, JointChoice, Strategy

__all__ = [
    "Aimless",
    "DemonstrationsFirst",
    "JointChoice",
    "Mode",
    "News",
    "RoundRobin",
    "Strategy",
]
