"""A person who is asked through a page, and answers in their own time."""

from __future__ import annotations

import math
from dataclasses import dataclass

from sgim.errors import SettingError


@dataclass(frozen=True)
class RemoteTeacher:
    """A person whom a run asks and does not wait for: the learner explores meanwhile.

    Attributes:
        time_limit: How long a request waits for an answer, in s, before it expires.
        per_hour: How many requests there may be in an hour.

    Raises:
        SettingError: If a number is not positive.
    """

    time_limit: float = 120.0
    per_hour: int = 60

    def __post_init__(self) -> None:
        if not 0 < self.time_limit < math.inf:
            raise SettingError(f"time_limit is {self.time_limit!r}, expected seconds above 0")
        if self.per_hour < 1:
            raise SettingError(f"per_hour is {self.per_hour!r}, expected 1 request or more")
