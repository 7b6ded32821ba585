"""What records made by `frozen` promise."""

import copy
import inspect
import pickle
from dataclasses import FrozenInstanceError, replace

import pytest

from sgim.frozen import frozen
from sgim.records import Demonstration, Goal, Plan


@frozen
class Point:
    """A record of this test."""

    x: int
    y: int = 2


def test_fields_are_given_by_position_or_by_name_with_defaults() -> None:
    assert repr(Point(1)) == "Point(x=1, y=2)"
    assert repr(Point(y=3, x=4)) == "Point(x=4, y=3)"
    assert list(inspect.signature(Point).parameters) == ["x", "y"]
    with pytest.raises(TypeError, match="missing"):
        Point()  # type: ignore[call-arg]


def test_nothing_can_be_assigned_added_or_deleted() -> None:
    point = Point(1)
    for name in ("x", "z"):
        with pytest.raises((FrozenInstanceError, TypeError)):
            setattr(point, name, 5)
    with pytest.raises(FrozenInstanceError):
        del point.y
    assert point.x == 1
    assert type(point) is Point


def test_records_are_told_apart_by_identity() -> None:
    assert Point(1) != Point(1)
    assert len({Point(1), Point(1)}) == 2


def test_records_copy_pickle_match_and_are_replaced() -> None:
    goal = Goal("hand", [0.5])
    for same in (copy.copy(goal), pickle.loads(pickle.dumps(goal)), replace(goal)):
        assert (type(same), same.kind, same.point) == (Goal, "hand", [0.5])
    match goal:
        case Goal(kind, point):
            assert (kind, point) == ("hand", [0.5])


def test_a_field_left_out_of_the_representation_stays_out() -> None:
    plan = Plan(0, 0, "alone", None, [1.0], None, None, owner=object())
    assert "owner" not in repr(plan)


def test_nothing_derives_from_a_record() -> None:
    with pytest.raises(TypeError, match="let it hold one instead"):

        class Mine(Demonstration):
            pass
