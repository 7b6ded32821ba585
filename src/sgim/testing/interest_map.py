"""The suite for interest maps, the middle level."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from sgim.outcome.interest import EpisodeReport, InterestMap
from sgim.records import Goal
from sgim.spaces import Box, Space
from sgim.streams import Streams
from sgim.testing.promises import Packed, require, succeeds

_EPISODES = 120
_REPEATS = 300
_STRANGER = "a mode that the map was not made for"


def check_interest_map(
    make_map: Callable[[], InterestMap],
    goal_spaces: Mapping[str, Space],
    modes: Sequence[str],
    *,
    context_space: Space | None = None,
    seed: int = 0,
) -> None:
    """Check that an interest map keeps the promises of `sgim.outcome.interest.InterestMap`.

    Args:
        make_map: Makes a fresh map; called several times.
        goal_spaces: Kind → goal space, as the map was made for.
        modes: Names of the modes that the map was made for.
        context_space: The context space that the map was made for, or None.
        seed: Of the made-up episodes.

    Raises:
        AssertionError: If a promise is broken.
    """
    check = _Check(dict(goal_spaces), list(modes), context_space, Streams(seed))
    with succeeds("make_map makes a fresh map", "Pass a function without arguments"):
        twins = (make_map(), make_map())
    check.live(twins)
    for kind in check.spaces:
        check.repeat(make_map(), kind)
    if context_space is not None:
        check.strange_contexts(make_map())


class _Check:
    def __init__(
        self,
        spaces: dict[str, Space],
        modes: list[str],
        context_space: Space | None,
        streams: Streams,
    ) -> None:
        self.spaces = spaces
        self.modes = modes
        self.context_space = context_space
        self.streams = streams

    def live(self, twins: tuple[InterestMap, InterestMap]) -> None:
        """Two maps with the same history choose alike, whatever episodes come to."""
        for number in range(_EPISODES):
            rng = self.streams("testing/episode", number)
            context = self._context(rng)
            offered = self._offered(rng, number)
            goal, mode = self._choose(twins[0], number, offered, context)
            self._choose_again(twins, number, offered, context, goal, mode)
            report = self._report(rng, number, goal, mode, context)
            for twin in twins:
                self._update(twin, report)

    def repeat(self, one: InterestMap, kind: str) -> None:
        """Hundreds of episodes for one and the same goal do not break a map."""
        rng = self.streams("testing/repeat")
        context, point = self._context(rng), self.spaces[kind].sample(rng)
        for number in range(_REPEATS):
            # A copy each time, as a journal's reader would give.
            goal = Goal(kind, self.spaces[kind].unpack(self.spaces[kind].pack(point)))
            mode = self.modes[number % 2 % len(self.modes)]
            after = -0.5 + 0.4 * float(rng.random())
            report = EpisodeReport(number, mode, goal, goal, context, -0.5, after, 5)
            self._update(one, report)
            if number % 50 == 0:
                self._choose(one, number, self.modes, context)

    def strange_contexts(self, one: InterestMap) -> None:
        """Measured contexts may lie at the border, or a little outside."""
        space = self.context_space
        if not isinstance(space, Box):
            return
        far = 0.1 * space.range
        contexts = [space.low, space.high, space.low - far, space.high + far]
        for number, context in enumerate(contexts * 20):
            goal, mode = self._choose(one, number, self.modes, context)
            self._update(one, EpisodeReport(number, mode, goal, goal, context, -1.0, -0.5, 1))

    def _context(self, rng: np.random.Generator) -> Any:
        return None if self.context_space is None else self.context_space.sample(rng)

    def _offered(self, rng: np.random.Generator, number: int) -> list[str]:
        """All modes, or every other time only some: teachers come and go."""
        if number % 2 == 0:
            return list(self.modes)
        kept = [mode for mode in self.modes if rng.random() < 0.5]
        return kept or [self.modes[int(rng.integers(len(self.modes)))]]

    def _choose(
        self, one: InterestMap, number: int, offered: list[str], context: Any
    ) -> tuple[Goal, str]:
        given = list(offered)
        with succeeds(
            f"choose gives a goal and one of the modes {offered}",
            "It must work at any time, also when only some modes are offered",
        ):
            goal, mode = one.choose(self.streams("testing/choice", number), given, context)
        require(
            isinstance(goal, Goal) and goal.kind in self.spaces,
            f"choose gives a Goal of one of the kinds {', '.join(self.spaces)}",
            f"{goal!r:.80} came",
            "Return Goal(kind, point)",
        )
        require(
            self.spaces[goal.kind].contains(goal.point),
            f"a goal lies within its goal space, {self.spaces[goal.kind]!r:.80}",
            f"{goal!r:.80} came",
            "Clip the goal to the bounds of its space",
        )
        require(
            mode in offered and given == offered,
            f"choose gives one of the modes offered, {offered}, and leaves the list as it is",
            f"{mode!r} came, and the list is {given}",
            "Choose among the modes passed: the teachers of others are away",
        )
        return goal, mode

    def _choose_again(
        self,
        twins: tuple[InterestMap, InterestMap],
        number: int,
        offered: list[str],
        context: Any,
        goal: Goal,
        mode: str,
    ) -> None:
        first = self._packed(goal, mode)
        again = self._packed(*self._choose(twins[0], number, offered, context))
        require(
            first == again,
            "choosing changes nothing: equal generators choose alike",
            f"{first} came first, then {again}",
            "Take random numbers from the generator given only; learn in update, not in choose",
        )
        other = self._packed(*self._choose(twins[1], number, offered, context))
        require(
            first == other,
            "two maps that got the same reports choose alike from equal generators",
            f"one chose {first}, the other {other}",
            "Let choices depend on reports and on the generator only, not on time, hashes of "
            "objects, or generators of the map's own without a fixed seed",
        )

    def _packed(self, goal: Goal, mode: str) -> Packed:
        return goal.kind, self.spaces[goal.kind].pack(goal.point), mode

    def _report(
        self, rng: np.random.Generator, number: int, goal: Goal, mode: str, context: Any
    ) -> EpisodeReport:
        pursued = goal
        if number % 3 == 0:  # As in emulation.
            kind = list(self.spaces)[int(rng.integers(len(self.spaces)))]
            pursued = Goal(kind, self._aim(rng, kind, outside=number % 2 == 0))
        before = -float(rng.random())
        after = before if number % 4 == 0 else before * float(rng.random())
        movements = int(rng.integers(1, 20))
        name = _STRANGER if number % 11 == 10 else mode
        return EpisodeReport(number, name, goal, pursued, context, before, after, movements)

    def _aim(self, rng: np.random.Generator, kind: str, *, outside: bool) -> Any:
        space = self.spaces[kind]
        point = space.sample(rng)
        return point + space.range if outside and isinstance(space, Box) else point

    def _update(self, one: InterestMap, report: EpisodeReport) -> None:
        with succeeds(
            f"update takes every report, also {report!r:.200}",
            "Ignore reports of unknown modes and of goals outside their space; progress may be "
            "zero, and hundreds of goals may be the same",
        ):
            one.update(report)
