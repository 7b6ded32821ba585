"""The fishing rod of chapter 3, simulated by MuJoCo (``pip install 'sgim[mujoco]'``)."""

from sgim.environments.fishing.rod import FishingRod

__all__ = ["FishingRod"]
