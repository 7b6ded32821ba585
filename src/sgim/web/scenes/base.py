"""What a page needs to know of a world: how it looks, how it moves, and how a person can lead it.

A scene is described by points that move and shapes that hang on them, so that the page can draw
any world without knowing it. Coordinates are metres, z up; flat scenes leave z at 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from sgim.records import Outcome, Trajectory
from sgim.spaces import FloatArray
from sgim.task import Task

FRAMES_A_SECOND = 40.0
"""How densely movements are drawn."""

Shape = dict[str, Any]
"""A thing to draw, as the page reads it; see `tube`, `ball`, `sheet` and `block`."""


@dataclass(frozen=True, eq=False)
class Movement:
    """A movement to be drawn.

    Attributes:
        times: In s, shape ``(n,)``.
        frames: Where the scene's points are then, shape ``(n, points, 3)``.
        outcome: What it produced.
    """

    times: FloatArray
    frames: FloatArray
    outcome: Outcome

    def plain(self) -> dict[str, Any]:
        """As JSON has it, to a tenth of a millimetre."""
        return {
            "times": np.round(self.times, 4).tolist(),
            "frames": np.round(self.frames, 4).tolist(),
            "outcome": {kind: np.asarray(point).tolist() for kind, point in self.outcome.items()},
        }


class Scene(Protocol):
    """A world that can be drawn, and led by a person.

    Attributes:
        task: Its task.
        joints: Names of what a person moves, in the order of trajectories.
        unit: Unit of their positions.
        low: Least position of each joint.
        high: Greatest position.
        home: Where they are at the start.
        shortest: Of a movement, in s.
        longest: Of a movement, in s.
    """

    task: Task
    joints: tuple[str, ...]
    unit: str
    low: FloatArray
    high: FloatArray
    home: FloatArray
    shortest: float
    longest: float

    def describe(self) -> dict[str, Any]:
        """What the page draws: view, points, shapes, handle, planes to drag in."""
        ...

    def goal(self, kind: str, point: FloatArray) -> list[Shape]:
        """Shapes that show a goal."""
        ...

    def movement(self, policy: Any) -> Movement:
        """What a policy does."""
        ...

    def fit(self, trajectory: Trajectory) -> tuple[Any, float]:
        """The policy that comes nearest to a person's movement, and by how much it differs."""
        ...

    def led(self, trajectory: Trajectory, policy: Any) -> Movement:
        """What a person's movement does; ``policy`` is the nearest that the learner can do."""
        ...

    def reset(self, joints: FloatArray) -> None:
        """Begin anew with the joints at these positions, and at home what can only be there."""
        ...

    def held(self, joints: FloatArray) -> FloatArray:
        """Where joints that are at these positions are to bring the handle, shape ``(3,)``.

        The handle itself lags behind, or hangs below: who grasps it leads on from here.
        """
        ...

    def reach(self, target: FloatArray, joints: FloatArray) -> FloatArray:
        """Positions of the joints, near given ones, that bring the handle near a place."""
        ...

    def advance(self, joints: FloatArray, seconds: float) -> None:
        """Let the joints go there, and time pass."""
        ...

    def points(self) -> FloatArray:
        """Where the points are now, shape ``(points, 3)``."""
        ...


def tube(points: Sequence[int], radius: float, colour: str) -> Shape:
    """A line through some of the points."""
    return {"shape": "tube", "points": list(points), "radius": radius, "colour": colour}


def ball(point: int, radius: float, colour: str, height: float = 0.0) -> Shape:
    """A ball, or a disc of this height, at a point."""
    return {
        "shape": "disc" if height else "ball",
        "points": [point],
        "radius": radius,
        "height": height,
        "colour": colour,
    }


def fixed(shape: str, places: Sequence[Sequence[float]], colour: str, radius: float = 0.0) -> Shape:
    """What does not move: a ``line``, ``ring``, ``spot``, ``block`` or ``sheet`` at places."""
    return {
        "shape": shape,
        "places": [[float(x) for x in place] for place in places],
        "colour": colour,
        "radius": radius,
    }


def thinned(times: FloatArray, frames: FloatArray) -> tuple[FloatArray, FloatArray]:
    """As many of these frames as are drawn, the last one included."""
    wanted = np.arange(times[0], times[-1], 1 / FRAMES_A_SECOND)
    rows = np.unique(np.append(np.searchsorted(times, wanted), len(times) - 1))
    return times[rows], frames[rows]


def between(when: FloatArray, times: FloatArray, places: FloatArray) -> FloatArray:
    """Places on a path at given times, shape ``(n, coordinates)``."""
    return np.stack([np.interp(when, times, column) for column in places.T], axis=1)
