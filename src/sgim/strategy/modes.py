"""Sampling modes: the ways to collect data among which a strategy chooses (the thesis's χ)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from sgim.policy.explorer import Explorer


@dataclass(frozen=True, slots=True, eq=False)
class Mode:
    """One way to learn.

    Attributes:
        name: Its name, such as ``"autonomous"`` or ``"mimic T1"``.
        explorer: Proposes the policies of its episodes.
        budget: Most movements in an episode.
        cost: κ, by which its progress is divided.
        teacher: Whom it asks for a demonstration; None for modes without a teacher.
        pursues: Whether it aims at the goal ``chosen``, at the outcome ``demonstrated``, or at
            ``nothing`` (random policies).
        uses: What it needs of a demonstration: its ``outcome`` only; the ``policy``, to try it;
            or ``both``, to remember them as if tried, without a movement. None stands for the
            outcome if that is pursued, else for the policy.
    """

    name: str
    explorer: Explorer
    budget: int
    cost: float = 1.0
    teacher: str | None = None
    pursues: Literal["chosen", "demonstrated", "nothing"] = "chosen"
    uses: Literal["outcome", "policy", "both"] | None = None

    def __post_init__(self) -> None:
        if self.budget < 1:
            raise ValueError(f"mode {self.name!r} has a budget of {self.budget}, expected ≥ 1")
        if not self.cost > 0:
            raise ValueError(f"mode {self.name!r} has cost {self.cost}, expected > 0")
        if self.pursues == "demonstrated" and self.teacher is None:
            raise ValueError(f"mode {self.name!r} pursues demonstrations but has no teacher")

    @property
    def needs_policy(self) -> bool:
        """Whether it can do nothing with a demonstration that has only an outcome."""
        return (self.uses or ("outcome" if self.pursues == "demonstrated" else "policy")) != (
            "outcome"
        )
