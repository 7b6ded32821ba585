"""Worlds to learn in: each a task and what its policies produce."""

from sgim.environments.arm import ARMS, PlanarArm
from sgim.environments.base import Environment, MinimalEnvironment, draw_context, execute_all
from sgim.environments.benchmark_goals import hockey_goals, reachable_goals, throwing_goals
from sgim.environments.fishing import (
    FishingFloor,
    FishingRod,
    fishing_demonstrations,
    fishing_goals,
    fishing_teacher,
)
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import (
    crowded_teachers,
    partial_teachers,
    throwing_teachers,
)
from sgim.environments.vocal import VocalTract, ambient_language, vocal_goals

__all__ = [
    "ARMS",
    "AirHockey",
    "Environment",
    "FishingFloor",
    "FishingRod",
    "MinimalEnvironment",
    "PlanarArm",
    "ThrowingArm",
    "VocalTract",
    "ambient_language",
    "draw_context",
    "execute_all",
    "fishing_demonstrations",
    "fishing_goals",
    "fishing_teacher",
    "hockey_goals",
    "crowded_teachers",
    "hockey_teachers",
    "partial_teachers",
    "reachable_goals",
    "throwing_goals",
    "throwing_teachers",
    "vocal_goals",
]
