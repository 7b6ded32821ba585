"""Worlds to learn in: each a task and what its policies produce."""

from sgim.environments.acrobot import Acrobot
from sgim.environments.arm import PlanarArm
from sgim.environments.arms import ARMS, drawn_arm
from sgim.environments.base import Environment, MinimalEnvironment, draw_context, execute_all
from sgim.environments.benchmark_goals import hockey_goals, reachable_goals, throwing_goals
from sgim.environments.fishing import (
    FishingFloor,
    FishingRod,
    fishing_demonstrations,
    fishing_goals,
    fishing_teacher,
)
from sgim.environments.gymnasium import GymnasiumWorld, Rollout
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import hockey_teachers
from sgim.environments.obstacle_arm import ObstacleArm
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import (
    crowded_teachers,
    partial_teachers,
    throwing_teachers,
)
from sgim.environments.vocal import VocalTract, ambient_language, vocal_goals

__all__ = [
    "ARMS",
    "Acrobot",
    "AirHockey",
    "Environment",
    "FishingFloor",
    "FishingRod",
    "GymnasiumWorld",
    "MinimalEnvironment",
    "ObstacleArm",
    "PlanarArm",
    "Rollout",
    "ThrowingArm",
    "VocalTract",
    "ambient_language",
    "draw_context",
    "drawn_arm",
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
