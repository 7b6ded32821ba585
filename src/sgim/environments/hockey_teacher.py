"""The teacher of the air hockey world (section 4.2.2.1, II): it knows the right half's far end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.environments.hockey import AirHockey
from sgim.environments.tables import read_table
from sgim.errors import TeacherError
from sgim.records import Demonstration, Outcome
from sgim.spaces import FloatArray
from sgim.teachers import DemonstrationSet, Teacher

HOCKEY_TABLE = "hockey_teacher.csv"
DEMONSTRATIONS = 500
SHOWN = (0.5, 1.0)
"""Where on the top border the teacher's pucks end, in m."""


def hockey_teachers() -> dict[str, Teacher]:
    """Make the teacher: 500 demonstrations that end evenly spread over [0.5, 1]."""
    return {"expert": DemonstrationSet(hockey_demonstrations(), AirHockey().task)}


def hockey_demonstrations() -> list[Demonstration]:
    """What the teacher shows; policies come with the package, outcomes are simulated again."""
    policies = read_table(HOCKEY_TABLE)
    pairs = zip(policies, AirHockey().execute_batch(policies), strict=True)
    return [Demonstration(outcome=outcome, policy=policy) for policy, outcome in pairs]


def select_hits(
    policies: Sequence[Any] | FloatArray,
    outcomes: Sequence[Outcome],
    rng: np.random.Generator,
    count: int = DEMONSTRATIONS,
) -> FloatArray:
    """Choose demonstrations that spread evenly over [0.5, 1].

    The range is cut into ``count`` equal slots. Each slot that was reached gives one trial, at
    random; each other one then takes, from left to right, the trial nearest to its middle that
    nobody has taken. No two end at the same place.

    Args:
        policies: What was tried, shape ``(n, 14)``.
        outcomes: What it produced, ``n`` outcomes.
        rng: Chooses.
        count: How many to choose.

    Returns:
        The policies chosen, shape ``(count, 14)``, in the order of their outcomes.

    Raises:
        TeacherError: If trials ended at fewer than ``count`` different places there.
    """
    low, high = SHOWN
    hits = np.array([outcome["hit"][0] if "hit" in outcome else np.nan for outcome in outcomes])
    order = rng.permutation(np.flatnonzero((hits >= low) & (hits <= high)))
    # Learners repeat themselves: of those that end at the same place, the first.
    _, different = np.unique(hits[order], return_index=True)
    order = order[np.sort(different)]
    if len(order) < count:
        raise TeacherError(
            f"{count} hits in [{low}, {high}] are to be chosen, but trials ended at only "
            f"{len(order)} different places there: pass more trials"
        )
    width = (high - low) / count
    slots = np.minimum((hits[order] - low) / width, count - 1).astype(np.int64)
    reached, first = np.unique(slots, return_index=True)
    chosen = order[first]
    free = np.delete(order, first)
    for slot in np.setdiff1d(np.arange(count), reached):
        nearest = np.abs(hits[free] - (low + (slot + 0.5) * width)).argmin()
        chosen = np.append(chosen, free[nearest])
        free = np.delete(free, nearest)
    chosen = chosen[np.argsort(hits[chosen])]
    return np.array([policies[i] for i in chosen.tolist()], dtype=np.float64)
