"""Goals to measure fishing by, and how well they could be reached at best."""

from __future__ import annotations

import numpy as np

from sgim.environments.fishing.rod import FishingRod
from sgim.environments.tables import read_table
from sgim.errors import SgimError
from sgim.records import Goal
from sgim.spaces import FloatArray

GOALS_TABLE = "fishing_goals.csv"


def fishing_goals() -> list[Goal]:
    """Goals spread over what can be reached: one in each tile of the box that learners reached."""
    return [Goal("float", point) for point in read_table(GOALS_TABLE)]


def floor_goals() -> list[Goal]:
    """100 goals spread evenly over what the camera sees; see `FishingFloor`."""
    middles = (np.arange(10) + 0.5) / 10
    return [Goal("ball", np.array([x, y])) for x in middles for y in middles]


def noise_floor(
    world: FishingRod,
    goals: FloatArray,
    policies: FloatArray,
    landings: FloatArray,
    rng: np.random.Generator,
    *,
    neighbours: int = 10,
    repetitions: int = 5,
) -> FloatArray:
    """How far from each goal a movement ends, although much is remembered near it.

    The policies whose remembered landings are nearest to a goal are executed several times. The
    one that comes closest in the mean is chosen, and measured by executing it as often again.

    Args:
        world: Where policies are executed.
        goals: In m, shape ``(goals, 2)``.
        policies: The memory: what was tried, shape ``(n, 25)``.
        landings: Where each landed when it was tried, in m, shape ``(n, 2)``.
        rng: For the world's noise.
        neighbours: How many policies are compared; 1 for the nearest as it is.
        repetitions: How often each is executed to choose, and the chosen one to measure.

    Returns:
        Mean distances in m, a movement that fails or does not land counting 1, shape ``(goals,)``.
    """

    def misses(policy: FloatArray, goal: FloatArray) -> float:
        return float(np.mean([_miss(world, policy, goal, rng) for _ in range(repetitions)]))

    errors = np.empty(len(goals))
    for number, goal in enumerate(goals):
        near = np.linalg.norm(landings - goal, axis=1).argsort()[:neighbours]
        best = min(near.tolist(), key=lambda i: misses(policies[i], goal))
        errors[number] = misses(policies[best], goal)
    return errors


def _miss(
    world: FishingRod, policy: FloatArray, goal: FloatArray, rng: np.random.Generator
) -> float:
    try:
        outcome = world.execute(policy, None, rng)
    except SgimError:
        return 1.0
    return float(np.linalg.norm(outcome["float"] - goal)) if "float" in outcome else 1.0
