"""When a puck meets a wall, a block or a moving mallet: collisions in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from sgim.errors import SpaceError
from sgim.spaces import FloatArray

Contact = tuple[float, float, float]
"""Seconds until the contact (infinite if there is none), and the unit normal there, (x, y)."""

NEVER: Contact = (math.inf, 0.0, 0.0)
# A puck that has just met something may be inside of it by rounding: it can be met again at once.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Block:
    """An upright box that reflects the puck; its corners are met on a circle about them.

    Attributes:
        left: Least x.
        bottom: Least y.
        right: Greatest x.
        top: Greatest y.

    Raises:
        SpaceError: If the box is empty.
    """

    left: float
    bottom: float
    right: float
    top: float

    def __post_init__(self) -> None:
        if not (self.left < self.right and self.bottom < self.top):
            raise SpaceError(f"{self} is empty, expected left < right and bottom < top")

    def contact(self, x: float, y: float, vx: float, vy: float, radius: float) -> Contact:
        """When a disc of this radius, centred at (x, y) with velocity (vx, vy), meets the block."""
        best = NEVER
        if vx != 0:
            face, normal = (self.left - radius, -1.0) if vx > 0 else (self.right + radius, 1.0)
            delay = (face - x) / vx
            if -_ROUNDING < delay < best[0] and self.bottom <= y + vy * delay <= self.top:
                best = (delay, normal, 0.0)
        if vy != 0:
            face, normal = (self.bottom - radius, -1.0) if vy > 0 else (self.top + radius, 1.0)
            delay = (face - y) / vy
            if -_ROUNDING < delay < best[0] and self.left <= x + vx * delay <= self.right:
                best = (delay, 0.0, normal)
        for corner_x in (self.left, self.right):
            for corner_y in (self.bottom, self.top):
                delay = _entry(x - corner_x, y - corner_y, vx, vy, radius)
                if -_ROUNDING < delay < best[0]:
                    nx = (x + vx * delay - corner_x) / radius
                    ny = (y + vy * delay - corner_y) / radius
                    best = (delay, nx, ny)
        return (max(best[0], 0.0), best[1], best[2])


def border_contact(x: float, y: float, vx: float, vy: float) -> Contact:
    """When a point within the square [-1, 1]² meets its border; the normal points inwards."""
    along_x = ((1.0 if vx > 0 else -1.0) - x) / vx if vx != 0 else math.inf
    along_y = ((1.0 if vy > 0 else -1.0) - y) / vy if vy != 0 else math.inf
    if along_y <= along_x:
        return NEVER if vy == 0 else (max(along_y, 0.0), 0.0, -1.0 if vy > 0 else 1.0)
    return (max(along_x, 0.0), -1.0 if vx > 0 else 1.0, 0.0)


def reflected(
    velocity: tuple[float, float], normal: tuple[float, float], wall: tuple[float, float]
) -> tuple[float, float]:
    """The velocity after an elastic, frictionless collision with a wall too heavy to be moved.

    Args:
        velocity: Before the collision.
        normal: Unit normal of the wall.
        wall: Velocity of the wall.
    """
    nx, ny = normal
    along = (velocity[0] - wall[0]) * nx + (velocity[1] - wall[1]) * ny
    return (velocity[0] - 2 * along * nx, velocity[1] - 2 * along * ny)


def mallet_contacts(
    pucks: FloatArray,
    since: FloatArray,
    times: FloatArray,
    mallets: FloatArray,
    radius: float,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """When pucks that fly straight meet mallets that move straight from sample to sample.

    A puck that begins beneath a mallet cannot meet it before they have been apart.

    Args:
        pucks: Positions and velocities (x, y, vx, vy) at the times ``since``, shape ``(4, n)``.
        since: When each flight begins, in s, from ``times[0]`` to before ``times[-1]``; shape
            ``(n,)``.
        times: The samples' times in s, increasing, shape ``(m,)``.
        mallets: The mallets' positions at these times, shape ``(2, n, m)``.
        radius: Distance of the centres at contact.

    Returns:
        Times of contact, infinite where there is none, shape ``(n,)``; vectors from mallet to
        puck at contact, shape ``(2, n)``; the mallets' velocities there, shape ``(2, n)``. Where
        there is none, the vectors mean nothing.
    """
    begun = np.searchsorted(times, since, side="right") - 1
    passed = int(begun.min())  # what lies before all flights is left out
    now, times, mallets = begun - passed, times[passed:], mallets[:, :, passed:]
    rows = np.arange(len(since))
    places, velocities = pucks[:2], pucks[2:]
    # The mallet seen from the puck, at the samples and, in place of the one before it, now.
    seen = places[:, :, None] + velocities[:, :, None] * (times - since[:, None]) - mallets
    part = (since - times[now]) / (times[now + 1] - times[now])
    here = mallets[:, rows, now]
    seen[:, rows, now] = places - (here + part * (mallets[:, rows, now + 1] - here))
    moved = seen[:, :, 1:] - seen[:, :, :-1]
    gaps = _dot(seen, seen) - radius * radius
    closing = _dot(seen[:, :, :-1], moved)
    squares = _dot(moved, moved)
    under_root = closing * closing - squares * gaps[:, :-1]
    meets = under_root >= 0
    meets &= closing < 0
    meets &= gaps[:, :-1] >= -_ROUNDING
    meets &= (-closing <= squares) | (gaps[:, 1:] <= 0)
    if now.any():
        meets &= np.arange(len(times) - 1) >= now[:, None]
    first = meets.argmax(axis=1)
    when, apart, mallet_velocities = np.full(len(rows), np.inf), places.copy(), 0.0 * places
    met = np.flatnonzero(meets[rows, first])
    if len(met):
        step = first[met]
        at = (met, step)
        share = np.maximum((-closing[at] - np.sqrt(under_root[at])) / squares[at], 0.0)
        begin = np.where(step == now[met], since[met], times[step])
        when[met] = begin + share * (times[step + 1] - begin)
        apart[:, met] = seen[:, met, step] + share * moved[:, met, step]
        strides = mallets[:, met, step + 1] - mallets[:, met, step]
        mallet_velocities[:, met] = strides / (times[step + 1] - times[step])
    return when, apart, mallet_velocities


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar products of vectors along the first axis, which has a length of 2."""
    products = a * b
    total: FloatArray = products[0] + products[1]
    return total


def _entry(dx: float, dy: float, vx: float, vy: float, radius: float) -> float:
    """Seconds until a point at (dx, dy) from the middle of a circle enters it."""
    closing = dx * vx + dy * vy
    square = vx * vx + vy * vy
    under_root = closing * closing - square * (dx * dx + dy * dy - radius * radius)
    if closing >= 0 or under_root < 0:
        return math.inf
    return (-closing - math.sqrt(under_root)) / square
