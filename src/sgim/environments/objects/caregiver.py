"""The caregivers, who put a toy down when asked: turned over anyhow, or always the same side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sgim.environments.objects.table import ToyTable
from sgim.records import Demonstration, Goal
from sgim.teachers import Teacher

CAREGIVERS = {
    "unbiased": "puts the toy down turned over anyhow",
    "biased": "always puts the toy down with its front to the camera",
}
"""Caregiver's name → one line that says what he shows."""

_SWAY = 0.15


@dataclass(frozen=True)
class Caregiver:
    """Shows the toy that is asked for; any if none is.

    Attributes:
        table: Where.
        bias: ``unbiased``, or ``biased``: the same side, within 0.15 rad either way.
        side: By how much the side that a biased caregiver shows is turned from the front, in rad.
    """

    table: ToyTable
    bias: Literal["unbiased", "biased"] = "unbiased"
    side: float = 0.0

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration:
        """Put a toy down, and let the learner watch."""
        table = self.table
        toy = table.toys.sample(rng) if goal is None else table.toys.check(goal.point, "toy")
        if self.bias == "biased":
            pose = table.presented(toy, self.side + rng.uniform(-_SWAY, _SWAY))
        else:
            pose = table.moved(toy, "watch", rng)
        return Demonstration(table.seen(toy, pose, rng), f"watch {toy}")


def caregivers(table: ToyTable) -> Mapping[str, Teacher]:
    """The caregivers at a table, by name."""
    return {"unbiased": Caregiver(table), "biased": Caregiver(table, "biased")}
