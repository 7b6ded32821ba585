"""The fishing rod of chapter 3, simulated by MuJoCo (``pip install 'sgim[mujoco]'``)."""

from sgim.environments.fishing.demonstrators import fishing_demonstrations, fishing_teacher
from sgim.environments.fishing.floor import FishingFloor
from sgim.environments.fishing.goals import fishing_goals, floor_goals, noise_floor
from sgim.environments.fishing.rod import FishingRod

__all__ = [
    "FishingFloor",
    "FishingRod",
    "fishing_demonstrations",
    "fishing_goals",
    "fishing_teacher",
    "floor_goals",
    "noise_floor",
]
