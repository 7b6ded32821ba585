"""Figures of runs, one function each; they return a Matplotlib figure and need no display."""

from __future__ import annotations

from sgim.figures.choices import choices
from sgim.figures.choices_by_kind import choices_by_kind
from sgim.figures.error_curves import error_curves
from sgim.figures.explored import explored
from sgim.figures.fishing import fishing_movement
from sgim.figures.hockey_shots import hockey_shots
from sgim.figures.profiles import performance_profiles

__all__ = [
    "choices",
    "choices_by_kind",
    "error_curves",
    "explored",
    "fishing_movement",
    "hockey_shots",
    "performance_profiles",
]
