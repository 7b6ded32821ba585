"""Episodic memory and exact incremental nearest neighbours."""

from sgim.memory.memory import KindMemory, Memory
from sgim.memory.neighbours import NearestNeighbours

__all__ = ["KindMemory", "Memory", "NearestNeighbours"]
