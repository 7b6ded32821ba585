"""The three teachers of the throwing world (section 4.3.3.2 of the thesis)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.environments.tables import read_table
from sgim.environments.throwing import ThrowingArm
from sgim.errors import TeacherError
from sgim.records import Demonstration, Outcome
from sgim.spaces import FloatArray
from sgim.teachers import CorrespondenceError, DemonstrationSet, Teacher

PLACING_PROFILE = (1.0, 1.0, 1.0, 0.0, -1.0, -1.0, -1.0)
PLACING_DURATION = 0.5
THROWING_TABLE = "throwing_teacher.csv"
_CELLS = (16, 12)


def throwing_teachers(demonstrations: int = 10) -> dict[str, Teacher]:
    """Make the three teachers.

    T1 throws, after 30 demonstrations. T2 places. T3 is T2 as seen through a correspondence
    error: its outcomes are right, but copying what the learner perceives does not place.

    Args:
        demonstrations: How many T2 and T3 know. This number decides comparisons: from 30
            upward, merely copying T2 beats every learner.
    """
    task = ThrowingArm().task
    placing = DemonstrationSet(placing_demonstrations(demonstrations), task)
    return {
        "T1": DemonstrationSet(throwing_demonstrations(), task),
        "T2": placing,
        "T3": CorrespondenceError(placing, misread),
    }


def crowded_teachers(useless: int = 7) -> dict[str, Teacher]:
    """The three teachers, and as many more who are of no use.

    Each of these shows ten throws that random movements make, so nothing that is hard to find,
    and is misread: the learner perceives every acceleration with the opposite sign.
    """
    arm = ThrowingArm()
    box = arm.task.outcome_spaces["throw"]
    teachers = throwing_teachers()
    for number in range(1, useless + 1):
        rng = np.random.default_rng([number])
        policies = np.array([arm.task.policy_space.sample(rng) for _ in range(60)])
        shown = [
            demonstration
            for demonstration in _demonstrations(policies, arm.execute_batch(policies))
            if "throw" in demonstration.outcome and box.contains(demonstration.outcome["throw"])
        ]
        teachers[f"U{number}"] = CorrespondenceError(DemonstrationSet(shown[:10], arm.task), mirror)
    return teachers


def partial_teachers() -> dict[str, Teacher]:
    """The three teachers, each knowing but a part: throws forwards, angles on one side."""
    task = ThrowingArm().task
    throws = [d for d in throwing_demonstrations() if d.outcome["throw"][0] > 0]
    angles = [d for d in placing_demonstrations() if d.outcome["place"][0] > 0]
    placing = DemonstrationSet(angles, task)
    return {
        "T1": DemonstrationSet(throws, task),
        "T2": placing,
        "T3": CorrespondenceError(placing, misread),
    }


def mirror(policy: FloatArray) -> FloatArray:
    """The policy with the signs of all its accelerations flipped."""
    perceived = np.array(policy, dtype=np.float64)
    perceived[::2] *= -1
    return perceived


def placing_demonstrations(count: int = 10) -> list[Demonstration]:
    """Movements that come to rest at ``count`` angles spread evenly over the circle.

    Accelerations are c · (1, 1, 1, 0, -1, -1, -1), every duration 0.5 s: the arm stops at the
    angle 3c. Angles are -π + (k + ½) · 2π / count.

    Raises:
        TeacherError: If ``count`` is not positive.
    """
    if count < 1:
        raise TeacherError(f"count is {count}, expected 1 or more demonstrations")
    arm = ThrowingArm()
    policies = np.full((count, 14), PLACING_DURATION)
    angles = -np.pi + (np.arange(count) + 0.5) * 2 * np.pi / count
    policies[:, ::2] = np.outer(angles / 3, PLACING_PROFILE)
    outcomes = arm.execute_batch(policies)
    return _demonstrations(policies, outcomes)


def misread(policy: FloatArray) -> FloatArray:
    """The policy with the signs of its sixth and seventh accelerations flipped."""
    perceived = np.array(policy, dtype=np.float64)
    perceived[[10, 12]] *= -1
    return perceived


def throwing_demonstrations() -> list[Demonstration]:
    """The 30 throws of T1; policies come with the package, outcomes are simulated again."""
    policies = read_table(THROWING_TABLE)
    return _demonstrations(policies, ThrowingArm().execute_batch(policies))


def select_throws(
    policies: Sequence[Any] | FloatArray,
    outcomes: Sequence[Outcome],
    rng: np.random.Generator,
    count: int = 30,
) -> FloatArray:
    """Choose a thrower's demonstrations among what a learner has tried.

    One trial in each cell reached of a 16 x 12 grid over the throwing outcomes, then ``count``
    of those cells, all at random.

    Args:
        policies: What was tried, shape ``(n, 14)``.
        outcomes: What it produced, ``n`` outcomes; what is not a throw within the box is left out.
        rng: Chooses.
        count: How many to choose.

    Returns:
        The policies chosen, shape ``(count, 14)``, in the order of their cells.

    Raises:
        TeacherError: If fewer than ``count`` cells were reached.
    """
    box = ThrowingArm().task.outcome_spaces["throw"]
    chosen: dict[tuple[int, int], int] = {}
    for i in rng.permutation(len(outcomes)).tolist():
        throw = outcomes[i].get("throw")
        if throw is not None and box.contains(throw):
            column, row = np.minimum(box.encode(throw) * _CELLS, np.subtract(_CELLS, 1)).astype(int)
            chosen.setdefault((int(column), int(row)), i)
    if len(chosen) < count:
        raise TeacherError(
            f"{count} throws are to be chosen, one a cell, but only {len(chosen)} cells were "
            "reached: pass more trials"
        )
    cells = sorted(chosen)
    kept = np.sort(rng.choice(len(cells), size=count, replace=False))
    return np.array([policies[chosen[cells[k]]] for k in kept.tolist()], dtype=np.float64)


def _demonstrations(policies: FloatArray, outcomes: Sequence[Outcome]) -> list[Demonstration]:
    pairs = zip(policies, outcomes, strict=True)
    return [Demonstration(outcome=outcome, policy=policy) for policy, outcome in pairs]
