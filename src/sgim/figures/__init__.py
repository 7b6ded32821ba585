"""Figures of runs, one function each; they return a Matplotlib figure and need no display."""

from __future__ import annotations

from sgim.figures.choices import choices
from sgim.figures.error_curves import error_curves
from sgim.figures.explored import explored
from sgim.figures.fishing import fishing_movement

__all__ = ["choices", "error_curves", "explored", "fishing_movement"]
