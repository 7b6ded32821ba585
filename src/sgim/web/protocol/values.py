"""What messages are made of, with its limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated


@dataclass(frozen=True)
class Most:
    """A limit: the longest text or list, or the largest magnitude of a number."""

    value: float


Name = Annotated[str, Most(60)]
Words = Annotated[str, Most(300)]
Key = Annotated[str, Most(40)]
Number = Annotated[float, Most(1e6)]
Point = Annotated[list[Number], Most(64)]
Samples = Annotated[list[Point], Most(6000)]


@dataclass(frozen=True)
class GoalPoint:
    """A goal."""

    kind: Name
    point: Point
