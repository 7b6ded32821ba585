"""Figures of runs, one function each; they return a Matplotlib figure and need no display."""

from __future__ import annotations

from sgim.figures.choices import choices
from sgim.figures.choices_by_kind import choices_by_kind
from sgim.figures.error_curves import error_curves
from sgim.figures.explored import explored
from sgim.figures.fishing import fishing_movement
from sgim.figures.hockey_shots import hockey_shots
from sgim.figures.profiles import performance_profiles
from sgim.figures.vocal_classes import vocal_classes, vocal_stages
from sgim.figures.vocal_densities import vocal_densities
from sgim.figures.vocal_sounds import vocal_sounds
from sgim.figures.vocal_tract import draw_tract, vocal_articulators
from sgim.figures.vocalisation import vocalisation

__all__ = [
    "choices",
    "choices_by_kind",
    "draw_tract",
    "error_curves",
    "explored",
    "fishing_movement",
    "hockey_shots",
    "performance_profiles",
    "vocal_articulators",
    "vocal_classes",
    "vocal_densities",
    "vocal_sounds",
    "vocal_stages",
    "vocalisation",
]
