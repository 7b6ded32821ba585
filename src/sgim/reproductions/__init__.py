"""Chapters of the thesis made again: what to run, what to draw, what to decide, and the report."""

from sgim.reproductions.declaration import Drawing, Quick, Reproduction
from sgim.reproductions.registry import REPRODUCTIONS, reproduction

__all__ = ["REPRODUCTIONS", "Drawing", "Quick", "Reproduction", "reproduction"]
