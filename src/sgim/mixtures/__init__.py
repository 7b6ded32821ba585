"""Gaussian mixtures: fitted at once or little by little, conditioned, and drawn from."""

from sgim.mixtures.conditional import Conditional
from sgim.mixtures.expectation import fit
from sgim.mixtures.incremental import split_starved, updated
from sgim.mixtures.mixture import GaussianMixture
from sgim.mixtures.selection import fit_by_criterion

__all__ = [
    "Conditional",
    "GaussianMixture",
    "fit",
    "fit_by_criterion",
    "split_starved",
    "updated",
]
