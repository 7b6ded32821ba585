"""The controls: every mode in turn, and all demonstrations first."""

from typing import Any

import numpy as np
from tests.helpers import report
from tests.strategy.test_strategy import ALONE, MODES, Scripted

from sgim.strategy.schedules import DemonstrationsFirst, RoundRobin
from sgim.strategy.situation import Situation

RNG = np.random.default_rng(0)
ASKING = [m for m in MODES if m.teacher]


def choices(strategy: Any, episodes: range, absent: tuple[str, ...] = ()) -> list[str]:
    return [strategy.choose(Situation(i, absent), RNG).mode.name for i in episodes]


def test_every_mode_has_its_turn_with_a_goal_for_it() -> None:
    interest = Scripted("alone")
    strategy = RoundRobin(MODES, interest, ALONE)
    assert choices(strategy, range(8)) == [m.name for m in MODES] * 2
    assert interest.offered == [[m.name] for m in MODES] * 2


def test_the_turn_of_an_absent_teacher_is_spent_alone() -> None:
    strategy = RoundRobin(MODES, Scripted("alone"), ALONE)
    assert choices(strategy, range(4), ("ann",)) == ["alone", "alone", "alone", "mimic bob"]


def test_demonstrations_come_first_one_teacher_after_the_other() -> None:
    first, then = Scripted("alone"), Scripted("alone")
    strategy = DemonstrationsFirst(ASKING, 5, first, ALONE, then)
    names = [m.name for m in ASKING]
    assert choices(strategy, range(8)) == [*names, *names[:2], "alone", "alone", "alone"]
    assert (len(first.offered), len(then.offered)) == (5, 3)


def test_no_demonstration_is_asked_of_who_is_away() -> None:
    strategy = DemonstrationsFirst(ASKING, 3, Scripted("alone"), ALONE, Scripted("alone"))
    assert choices(strategy, range(3), ("ann", "bob")) == ["alone"] * 3


def test_a_schedule_does_not_depend_on_what_came_before() -> None:
    strategy = DemonstrationsFirst(ASKING, 5, Scripted("alone"), ALONE, Scripted("alone"))
    assert choices(strategy, range(3, 7)) == choices(strategy, range(3, 7))


def test_only_what_was_explored_alone_teaches_the_map_of_what_follows() -> None:
    first, then = Scripted("alone"), Scripted("alone")
    strategy = DemonstrationsFirst(ASKING, 5, first, ALONE, then)
    strategy.update(report([3.0], "mimic bob"))
    strategy.update(report([3.0], "alone"))
    assert [r.mode for r in then.reports] == ["alone"]
    assert not first.reports
