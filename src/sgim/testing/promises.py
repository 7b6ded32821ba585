"""How the suites speak: a promise, what came instead, and what to do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from sgim.records import Demonstration
from sgim.spaces import Space
from sgim.task import Task

Packed = tuple[Any, ...]


def require(kept: object, promise: str, came: str, advice: str) -> None:
    """Raise unless a promise is kept.

    Args:
        kept: Whether it is, by its truth.
        promise: What was promised, as a sentence without a full stop.
        came: What came instead.
        advice: What to do.

    Raises:
        AssertionError: If it is not kept.
    """
    if not kept:
        raise AssertionError(f"{promise}, but {came}. {advice}.")


@contextmanager
def succeeds(promise: str, advice: str) -> Iterator[None]:
    """Turn any exception inside into the `AssertionError` of a promise that was broken."""
    try:
        yield
    except AssertionError:
        raise
    except Exception as error:
        came = f"it raised {type(error).__name__}: {error}"
        raise AssertionError(f"{promise}, but {came}. {advice}.") from error


def packed_point(space: Space | None, point: Any) -> bytes | None:
    """A point's bytes, to compare to the last bit; None for the absent context of a task."""
    return None if space is None or point is None else space.pack(point)


def packed_outcome(task: Task, outcome: Mapping[str, Any]) -> Packed:
    """A checked outcome's bytes, kind by kind."""
    return tuple((kind, task.outcome_spaces[kind].pack(outcome[kind])) for kind in sorted(outcome))


def packed_demonstration(task: Task, demonstration: Demonstration) -> Packed:
    """The bytes of all that a checked demonstration holds."""
    trajectory = demonstration.trajectory
    movement = None
    if trajectory is not None:
        movement = (trajectory.times.tobytes(), trajectory.positions.tobytes(), trajectory.joints)
    return (
        packed_outcome(task, demonstration.outcome),
        packed_point(task.policy_space, demonstration.policy),
        packed_point(task.context_space, demonstration.context),
        movement,
    )
