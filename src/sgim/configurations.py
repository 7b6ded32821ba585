"""The constants of the learners: `thesis`, as the thesis has them, and `modern`, the default."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from sgim.errors import unknown
from sgim.outcome.progress import InterestMeasure, MeanProgress
from sgim.task import Task


@dataclass(frozen=True, slots=True)
class Configuration:
    """Every constant of a learner; nothing in it names a world.

    Attributes:
        name: ``"thesis"``, ``"modern"``, or a name of one's own.
        search: The goal-directed explorer, ``"nelder-mead"`` or ``"local"``.
        search_movements: Movements of an autonomous or emulation episode.
        mimicry_movements: Movements of a mimicry episode (nIm of algorithm 3.2.1).
        mimicry_radius: ε of algorithm 3.2.1, in the policy's own units.
        mimicry_exact_first: Whether the first repetition is without variation.
        social_cost: κ of the modes that ask a teacher; autonomous exploration has 1.
        progress_scale: α_p of eq. 4.2.
        progress_window: δ of eq. 4.3.
        region_capacity: g_max of algorithm 4.3.2.
        split_candidates: m of section 4.3.2.4.
        goal_rules: Probabilities of the rules uniform, interesting, worst_point.
        prior: Interest of untried pairs, before division by the cost.
        staleness: Interest that a pair regains with age, before division by the cost.
        credit: Whether progress counts where the goal was ``chosen``, or at what was ``pursued``.
        sized: Whether progress is divided by the sizes |A_i| of eq. 4.2, which the task states.
        news: Whether requests are given up for exploring alone unless they are expected to bring
            a demonstration not seen before.
        reached_share: Local search ends an episode when its goal is within the task's tolerance
            and its cost at most this share of what it was before.
    """

    name: str
    search: Literal["nelder-mead", "local"]
    search_movements: int = 20
    mimicry_movements: int = 10
    mimicry_radius: float = 0.05
    mimicry_exact_first: bool = False
    social_cost: float = 2.0
    progress_scale: float = 1000.0
    progress_window: int = 10
    region_capacity: int = 10
    split_candidates: int = 20
    goal_rules: tuple[float, float, float] = (0.05, 0.7, 0.25)
    prior: float = 0.3
    staleness: float = 0.0
    credit: Literal["chosen", "pursued"] = "pursued"
    sized: bool = True
    news: bool = False
    reached_share: float = 0.5

    def measure(self, task: Task) -> InterestMeasure:
        """How progress and interest are measured (eq. 4.2 and 4.3)."""
        sizes = task.sizes if self.sized else dict.fromkeys(task.sizes, 1.0)
        return MeanProgress(sizes, scale=self.progress_scale, window=self.progress_window)

    def describe(self) -> dict[str, Any]:
        """The constants, JSON-compatible."""
        return {**asdict(self), "goal_rules": list(self.goal_rules)}


THESIS = Configuration("thesis", "nelder-mead")
MODERN = Configuration(
    "modern",
    "local",
    mimicry_movements=3,
    mimicry_exact_first=True,
    goal_rules=(0.3, 0.5, 0.2),
    credit="chosen",
    sized=False,
    region_capacity=20,
    split_candidates=10,
    news=True,
    search_movements=5,
)
CONFIGURATIONS = {c.name: c for c in (THESIS, MODERN)}


def configuration_of(given: str | Configuration | Mapping[str, Any]) -> Configuration:
    """A configuration by name, as it is, or from what its ``describe`` gave."""
    if isinstance(given, Configuration):
        return given
    if isinstance(given, str):
        if given not in CONFIGURATIONS:
            raise unknown("configuration", given, CONFIGURATIONS)
        return CONFIGURATIONS[given]
    known = Configuration.__dataclass_fields__
    for key in given:
        if key not in known:
            raise unknown("setting of a configuration", key, known)
    return Configuration(**{**given, "goal_rules": tuple(given["goal_rules"])})


__all__ = ["CONFIGURATIONS", "Configuration", "configuration_of"]
