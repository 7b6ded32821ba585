"""Figures of runs, one function each; they return a Matplotlib figure and need no display."""

from __future__ import annotations

from sgim.figures.choices import choices
from sgim.figures.choices_by_kind import choices_by_kind
from sgim.figures.error_curves import error_curves
from sgim.figures.errors_by_world import errors_by_world
from sgim.figures.explored import explored
from sgim.figures.fishing import fishing_movement
from sgim.figures.hockey_shots import hockey_shots
from sgim.figures.mixtures import mixture_interest, mixture_learning
from sgim.figures.places import places
from sgim.figures.profiles import performance_profiles
from sgim.figures.progress import progress
from sgim.figures.recognition import f_measures, recognised
from sgim.figures.toys import contact_sheet, database
from sgim.figures.vocal_classes import vocal_classes, vocal_stages
from sgim.figures.vocal_densities import vocal_densities
from sgim.figures.vocal_sounds import vocal_sounds
from sgim.figures.vocal_strategies import vocal_strategies
from sgim.figures.vocal_tract import draw_tract, vocal_articulators
from sgim.figures.vocal_vowels import vocal_vowels
from sgim.figures.vocalisation import vocalisation

__all__ = [
    "choices",
    "choices_by_kind",
    "contact_sheet",
    "database",
    "draw_tract",
    "error_curves",
    "errors_by_world",
    "explored",
    "f_measures",
    "fishing_movement",
    "hockey_shots",
    "performance_profiles",
    "mixture_interest",
    "mixture_learning",
    "recognised",
    "vocal_articulators",
    "vocal_classes",
    "vocal_densities",
    "vocal_sounds",
    "vocal_stages",
    "vocal_vowels",
    "vocal_strategies",
    "vocalisation",
    "places",
    "progress",
]
