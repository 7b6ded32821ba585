"""The world of the thesis's section 4.2.2: a mallet hits a puck past an obstacle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from sgim.environments.base import Environment, Generators
from sgim.environments.hockey_collisions import (
    NEVER,
    Block,
    border_contact,
    mallet_contacts,
    reflected,
)
from sgim.errors import SpaceError
from sgim.primitives import Intervals, ViaPoints
from sgim.primitives.recordings import positions_of
from sgim.records import Outcome, Trajectory
from sgim.spaces import Box, FloatArray
from sgim.task import Task

PUCK_START = (0.05, 0.0)
PUCK_VELOCITY = (0.0, -0.5)
PUCK_RADIUS = 0.05
MALLET_RADIUS = 0.10
OBSTACLE = Block(left=0.35, bottom=0.25, right=1.0, top=0.40)
MALLET_STEP = 0.005
TIME_LIMIT = 6.0
MOST_COLLISIONS = 50

# Movements whose mallets are followed at once: more would not fit in a processor's cache.
_CHUNK = 64

Ending = Literal["top border", "side border", "bottom border", "time limit", "too many collisions"]


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """What happened on the table during a movement.

    Attributes:
        mallet: Where the mallet's centre was every 5 ms, until it stood still; shape ``(m, 2)``.
        puck: Where the puck's centre was at the start, at each collision and at the end; it went
            straight in between. Shape ``(k, 2)``.
        times: When that was, in s, shape ``(k,)``.
        touches: How often the mallet hit the puck.
        ending: What ended the movement.
    """

    mallet: FloatArray
    puck: FloatArray
    times: FloatArray
    touches: int
    ending: Ending


class AirHockey(Environment):
    """A square table on which a mallet can hit a puck that comes towards it.

    A policy is five key points of the mallet, in m, and the four intervals between them, in s:
    ``(x_1, y_1, …, x_5, y_5, interval_1, …, interval_4)``; the mallet follows their weighted mean
    with σ = 16 s⁻² (eq. 4.1, `ViaPoints`), then stands still where it is.

    The puck's centre moves in the square [-1, 1]² m: the borders are a puck's radius further out.
    It starts at (0.05, 0) with 0.5 m/s downwards, and there is no friction. Collisions are elastic
    and frictionless, so that the puck does not spin. The mallet is infinitely heavy: it keeps its
    course, and the puck's velocity relative to it is reflected. The mallet moves straight between
    samples taken every 5 ms, which is part of the world: impacts amplify small differences. It
    passes above borders and obstacle. The obstacle is at rest and reflects the puck's velocity. A
    mallet that starts above the puck cannot hit it before they have been apart.

    - ``hit``: (x in m where the puck meets the top border).

    A puck that meets another border, is on its way for 6 s, or collides 50 times (squeezed
    between mallet and obstacle) gives no outcome.

    Args:
        obstacle: The block that hides a part of the top border; None for a free table.
        puck_start: Where the puck's centre starts, in m.

    Attributes:
        task: 14 policy parameters; the outcome ``hit``.
        deterministic: True.
        obstacle: As given.
        puck_start: As given.
    """

    def __init__(
        self,
        obstacle: Block | None = OBSTACLE,
        puck_start: tuple[float, float] = PUCK_START,
    ) -> None:
        self.obstacle = obstacle
        self.puck_start = puck_start
        positions = Box([-1, -1], [1, 1], names=("x", "y"), unit="m")
        timing = Intervals(points=5, shortest=0.05, longest=0.5, sharpness=16.0)
        self._primitive = ViaPoints(positions, timing)
        samples = round(timing.longest * (timing.points - 1) / MALLET_STEP) + 1
        # From the last sample to the time limit, every mallet stands still.
        self._times = np.append(MALLET_STEP * np.arange(samples), TIME_LIMIT)
        self.deterministic = True
        self.task = Task(
            self._primitive.policy_space,
            {"hit": Box([-1], [1], names=("x",), unit="m")},
            primitive=self._primitive,
        )

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy, shape ``(14,)``; bounds are not checked.

        Raises:
            SpaceError: If the policy has another shape.
        """
        array = np.asarray(policy, dtype=np.float64)
        if array.shape != (14,):
            self.task.policy_space.check(policy, "policy")
        return self.execute_batch(array[None])[0]

    def execute_batch(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
        rngs: Generators | None = None,
    ) -> list[Outcome]:
        """Execute several policies, shape ``(n, 14)``; bounds are not checked.

        Raises:
            SpaceError: If the policies have another shape.
        """
        pucks = (puck for chunk in _chunks(policies) for puck in self._played(self._mallets(chunk)))
        return [
            {"hit": np.array([puck.x])} if puck.ending == "top border" else {} for puck in pucks
        ]

    def shots(self, policies: Sequence[Any] | FloatArray) -> list[Shot]:
        """What happens on the table in the movements of several policies, shape ``(n, 14)``.

        Raises:
            SpaceError: If the policies have another shape.
        """
        shots = []
        for chunk in _chunks(policies):
            mallets = self._mallets(chunk)
            moving = self._primitive.durations(chunk)
            for i, puck in enumerate(self._played(mallets)):
                samples = int(np.searchsorted(self._times, moving[i])) + 1
                shots.append(_shot(mallets[:, i, :samples], puck))
        return shots

    def follow(self, trajectory: Trajectory) -> tuple[Outcome, Shot]:
        """Lead the mallet along recorded positions, then hold it still.

        Returns:
            The outcome, and what happened on the table.

        Raises:
            SpaceError: If the trajectory is of other joints or in another unit.
        """
        recorded = positions_of(trajectory, self._primitive.joints, self._primitive.unit)
        since = trajectory.times - trajectory.times[0]
        samples = int(np.ceil(since[-1] / MALLET_STEP)) + 1
        times = np.append(MALLET_STEP * np.arange(samples), max(TIME_LIMIT, since[-1] + 1))
        mallets = np.stack([np.interp(times, since, column) for column in recorded.T])[:, None]
        (puck,) = self._played(mallets, times)
        outcome = {"hit": np.array([puck.x])} if puck.ending == "top border" else {}
        return outcome, _shot(mallets[:, 0, :samples], puck)

    def _mallets(self, policies: FloatArray) -> FloatArray:
        """Where mallets are at each of the times, shape ``(2, n, m)``."""
        return np.moveaxis(self._primitive.positions(policies, self._times), -1, 0)

    def _played(self, mallets: FloatArray, times: FloatArray | None = None) -> list[_Puck]:
        """The pucks of mallets that are there at these times, at the end of their movements."""
        times = self._times if times is None else times
        pucks = [_Puck(*self.puck_start, *PUCK_VELOCITY) for _ in range(mallets.shape[1])]
        going = list(range(len(pucks)))
        while going:
            states = np.array([pucks[i].state() for i in going]).T
            followed = mallets if len(going) == len(pucks) else mallets[:, going]
            contacts = mallet_contacts(
                states[:4], states[4], times, followed, PUCK_RADIUS + MALLET_RADIUS
            )
            when, apart, velocities = (values.T.tolist() for values in contacts)
            for i, *contact in zip(going, when, apart, velocities, strict=True):
                pucks[i].advance(self.obstacle, *contact)
            going = [i for i in going if pucks[i].ending is None]
        return pucks


def _chunks(policies: Sequence[Any] | FloatArray) -> list[FloatArray]:
    values = np.asarray(policies, dtype=np.float64)
    if len(values) and values.shape[1:] != (14,):
        raise SpaceError(f"policies have shape {values.shape}, expected (n, 14)")
    return [values[k : k + _CHUNK] for k in range(0, len(values), _CHUNK)]


def _shot(mallet: FloatArray, puck: _Puck) -> Shot:
    path = np.array(puck.path)
    ending = puck.ending or "time limit"
    return Shot(mallet.T.copy(), path[:, 1:], path[:, 0], puck.touches, ending)


class _Puck:
    """A puck on its way. Plain floats: arrays of one number would cost several times as much."""

    def __init__(self, x: float, y: float, vx: float, vy: float) -> None:
        self.x, self.y, self.vx, self.vy = x, y, vx, vy
        self.time = 0.0
        self.touches = self.collisions = 0
        self.ending: Ending | None = None
        self.path = [(0.0, x, y)]

    def state(self) -> tuple[float, float, float, float, float]:
        return self.x, self.y, self.vx, self.vy, self.time

    def advance(
        self,
        obstacle: Block | None,
        touched: float,
        apart: tuple[float, float],
        mallet_velocity: tuple[float, float],
    ) -> None:
        """Fly to the next collision or to the end.

        Args:
            obstacle: The obstacle, if there is one.
            touched: When the mallet would be met, in s, possibly infinite.
            apart: From the mallet's centre to the puck's at that time.
            mallet_velocity: The mallet's velocity at that time.
        """
        x, y, vx, vy = self.state()[:4]
        border, _, inwards = border_contact(x, y, vx, vy)
        block, *normal = NEVER if obstacle is None else obstacle.contact(x, y, vx, vy, PUCK_RADIUS)
        end = min(self.time + border, TIME_LIMIT)
        bounced = self.time + block
        now = min(touched, bounced, end)
        self.x += vx * (now - self.time)
        self.y += vy * (now - self.time)
        self.time = now
        self.path.append((now, self.x, self.y))
        if now == touched:
            distance = math.hypot(*apart)
            towards = (apart[0] / distance, apart[1] / distance)
            self.vx, self.vy = reflected((vx, vy), towards, mallet_velocity)
            self.touches += 1
        elif now == bounced:
            self.vx, self.vy = reflected((vx, vy), (normal[0], normal[1]), (0.0, 0.0))
        elif now == TIME_LIMIT:
            self.ending = "time limit"
        elif inwards == 0:
            self.ending = "side border"
        else:
            self.ending = "top border" if inwards < 0 else "bottom border"
        self.collisions += 1
        if self.ending is None and self.collisions >= MOST_COLLISIONS:
            self.ending = "too many collisions"
