"""Sounds to measure vocal repertoires by."""

from __future__ import annotations

from sgim.environments.tables import read_table
from sgim.environments.vocal.world import KIND
from sgim.records import Goal

GOALS_TABLE = "vocal_goals.csv"


def vocal_goals() -> list[Goal]:
    """Sounds spread over what can be said: silence, and as many of each other type."""
    return [Goal(KIND, sound) for sound in read_table(GOALS_TABLE)]
