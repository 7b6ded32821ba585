"""The experiments of the thesis, as declarations."""

from sgim.experiments.experiment import Experiment
from sgim.experiments.registry import EXPERIMENTS, experiment

__all__ = ["EXPERIMENTS", "Experiment", "experiment"]
