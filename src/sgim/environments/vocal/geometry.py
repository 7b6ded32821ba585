"""Where tongue, lips and walls are for a position of the articulators, and the tube they form.

27 lines cross the tract from the larynx to the teeth: 8 horizontal ones in the pharynx, 9 rays
around the velum, 10 vertical ones in the mouth. On each, wall and tongue are at a distance from
the line's origin; their difference is a signed gap, below 0 where the tongue would be past the
wall. All arrays have the lines, or sections, first, and positions last.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.environments.vocal.anatomy import ARTICULATORS, Anatomy

Reals = NDArray[np.floating[Any]]
"""Double or single precision: what is computed has the precision of the positions."""

PHARYNX, RAYS, MOUTH = 8, 9, 10
LINES = PHARYNX + RAYS + MOUTH
SECTIONS = LINES + 3
"""Two of the larynx, one between any two lines, two of the lips."""

_LEAST_GAP = 1e-3  # cm, so that a closed tract has an area function
_LEAST_LIP_AREA = 1e-4
_LEAST_LIP_WIDTH = 0.4
_LEAST_LIP_LENGTH = 0.1
_TEETH_APART = 0.25  # the lower incisors stay so far below the upper ones
_FADE = 1.0  # the tip's rise fades out so far behind the blade
_DOME_END, _RIDGE = 0.35, 0.8  # as shares of the way to the teeth
_FACTORS_AT = (8, 12.5, 17, 23, 25)  # of the 26 sections between lines
_EXPONENTS_AT = (8, 12.5)


@dataclass(frozen=True)
class Contours:
    """Walls and tongue on every line.

    Attributes:
        origins: Origins of the lines in cm, shape ``(2, 27, n)``.
        directions: Their directions, of length 1, shape ``(2, 27, 1)``.
        wall: Distance of the wall, shape ``(27, n)``.
        tongue: Distance of the tongue.
        lips: Signed height of the lips' opening, shape ``(n,)``; below 0 where they are pressed.
    """

    origins: Reals
    directions: Reals
    wall: Reals
    tongue: Reals
    lips: Reals

    @property
    def gaps(self) -> Reals:
        """Signed distances from tongue to wall, shape ``(27, n)``."""
        gaps: Reals = self.wall - self.tongue
        return gaps

    @property
    def opening(self) -> Reals:
        """The least of all gaps and the lips' opening, shape ``(n,)``: closed where not above 0."""
        opening: Reals = np.minimum(self.gaps.min(axis=0), self.lips)
        return opening

    def points(self, distances: Reals) -> Reals:
        """Points at these distances from the origins, shape ``(2, 27, n)``."""
        points: Reals = self.origins + distances * self.directions
        return points


@dataclass(frozen=True)
class Tube:
    """A row of cylinders from the glottis to the lips.

    Attributes:
        areas: In cm², above 0 also where the tract is closed, shape ``(30, n)``.
        lengths: In cm, shape ``(30, n)``.
    """

    areas: Reals
    lengths: Reals


@dataclass(frozen=True)
class _Fixed:
    """What does not move: polar and front lines and their walls, and the area function."""

    levels: Reals  # of the lines in the pharynx, as shares of the larynx's depth, (8, 1)
    ray_walls: Reals  # (9, 1)
    places: Reals  # x of the lines in the mouth, (10, 1)
    mouth_walls: Reals  # (10, 1)
    factors: Reals  # (26, 1)
    exponents: Reals  # (26, 1)
    rays: Reals  # (2, 9, 1)
    directions: Reals  # (2, 27, 1)


def contours(anatomy: Anatomy, positions: Reals) -> Contours:
    """Walls and tongue for positions of the seven articulators.

    Args:
        anatomy: Whose tract.
        positions: Of `ARTICULATORS`, shape ``(7, n)``, neutral 0; any number is possible, those
            in [-3, 3] are meant.
    """
    jaw, body, height, tip, lip_height, _, larynx = positions
    a, fixed = anatomy, _fixed(anatomy, positions.dtype)
    shape = (LINES, positions.shape[1])
    by = (a.tongue_by_jaw, a.tongue_by_body, a.tongue_by_height)
    x, y = (a.tongue_rest[i] + by[0][i] * jaw + by[1][i] * body + by[2][i] * height for i in (0, 1))
    depth = a.larynx_depth + a.larynx_by_larynx * larynx
    levels = depth * fixed.levels
    places = fixed.places
    origins = np.zeros((2, *shape), dtype=positions.dtype)
    origins[1, :PHARYNX] = levels
    origins[0, PHARYNX + RAYS :] = places
    wall = np.empty(shape, dtype=positions.dtype)
    wall[:PHARYNX] = a.pharynx_wall
    wall[PHARYNX : PHARYNX + RAYS] = fixed.ray_walls
    wall[PHARYNX + RAYS :] = fixed.mouth_walls
    tongue = np.empty(shape, dtype=positions.dtype)
    tongue[:PHARYNX] = _root(a, x, y, depth, levels)
    tongue[PHARYNX : PHARYNX + RAYS] = _body(a, x, y, fixed.rays)
    tongue[PHARYNX + RAYS :] = _blade(a, x, y, jaw, places) + _tip(a, x, tip, places)
    lips = a.lip_opening + a.lip_by_height * lip_height - a.lip_by_jaw * jaw
    return Contours(origins, fixed.directions, wall, tongue, lips)


def tube(anatomy: Anatomy, positions: Reals, shape: Contours) -> Tube:
    """The tube that contours form: A = factor · distance^exponent on the mean of adjacent gaps.

    Args:
        anatomy: Whose tract.
        positions: As for `contours`.
        shape: Their contours.
    """
    a, fixed = anatomy, _fixed(anatomy, positions.dtype)
    areas = np.empty((SECTIONS, positions.shape[1]), dtype=positions.dtype)
    lengths = np.empty_like(areas)
    areas[0], areas[1] = 0.6 * a.larynx_area, a.larynx_area
    lengths[:2] = a.larynx_length / 2
    gaps = shape.gaps
    apart = np.maximum((gaps[1:] + gaps[:-1]) / 2, _LEAST_GAP)
    areas[2:-2] = fixed.factors * np.exp(fixed.exponents * np.log(apart))
    across, up = np.diff(shape.points((shape.wall + shape.tongue) / 2), axis=1)
    lengths[2:-2] = np.sqrt(across * across + up * up)
    protrusion = positions[ARTICULATORS.index("lip protrusion")]
    width = a.lip_width + a.lip_width_by_opening * np.maximum(shape.lips, 0.0)
    width = np.maximum(width - a.lip_width_by_protrusion * protrusion, _LEAST_LIP_WIDTH)
    areas[-2:] = np.maximum(math.pi / 4 * shape.lips * width, _LEAST_LIP_AREA)
    length = a.lip_length + a.lip_length_by_protrusion * protrusion
    lengths[-2:] = np.maximum(length, _LEAST_LIP_LENGTH) / 2
    return Tube(areas, lengths)


def _root(a: Anatomy, x: Reals, y: Reals, depth: Reals, levels: Reals) -> Reals:
    """How far behind the origin the tongue is in the pharynx: its root, or the circle above it."""
    behind = a.tongue_radius - x
    down = np.clip((y - levels) / (y - depth), 0.0, 1.0)
    above = np.maximum(levels - y, 0.0)
    root = behind + (a.root_depth - behind) * (down * down)
    circle = np.sqrt(np.maximum(a.tongue_radius**2 - above * above, 0.0)) - x
    return np.where(levels > y, circle, root)


def _body(a: Anatomy, x: Reals, y: Reals, rays: Reals) -> Reals:
    """Where rays leave the circle, or, below its rear point, the vertical through that."""
    across, up = rays
    along = x * across + y * up
    inside = a.tongue_radius**2 - x * x - y * y
    body = along + np.sqrt(np.maximum(along * along + inside, 0.0))
    vertical = (x - a.tongue_radius) / np.minimum(across, -1e-9)
    surface: Reals = np.where(body * up < y, np.maximum(body, vertical), body)
    return surface


def _blade(a: Anatomy, x: Reals, y: Reals, jaw: Reals, places: Reals) -> Reals:
    """Height of the tongue in the mouth: the circle, then a cubic to the lower incisors."""
    cosine, sine = math.cos(math.radians(a.blade_angle)), math.sin(math.radians(a.blade_angle))
    start, start_height = x + a.tongue_radius * cosine, y + a.tongue_radius * sine
    end = np.minimum(a.incisor_height + a.incisor_by_jaw * jaw, a.teeth_height - _TEETH_APART)
    length = a.teeth_place - start
    share = np.clip((places - start) / length, 0.0, 1.0)
    left = 1.0 - share
    from_start = left * left * (1.0 + 2.0 * share)
    slope = left * left * share * (-cosine / sine)
    blade = from_start * start_height + slope * length + (1.0 - from_start) * end
    off = places - x
    circle = y + np.sqrt(np.maximum(a.tongue_radius**2 - off * off, 0.0))
    return np.where(places < start, circle, blade)


def _tip(a: Anatomy, x: Reals, tip: Reals, places: Reals) -> Reals:
    """How much the tip raises the blade."""
    start = x + a.tongue_radius * math.cos(math.radians(a.blade_angle))
    top = a.tip_place * a.teeth_place + 0.5 * (x - a.tongue_rest[0])
    off = (places - top) / a.tip_width
    rise = np.exp(-off * off) * np.clip((places - start) / _FADE + 1.0, 0.0, 1.0)
    raised: Reals = a.tip_by_tip * tip * rise
    return raised


@cache
def _fixed(a: Anatomy, dtype: np.dtype[Any]) -> _Fixed:
    angles = np.linspace(180.0, 90.0, RAYS)
    radians = np.radians(angles)
    rays = np.array([np.cos(radians), np.sin(radians)])[:, :, None]
    through = np.polyfit([180.0, 135.0, 90.0], [a.pharynx_wall, a.velum_wall, a.palate_wall], 2)
    shares = np.arange(1, MOUTH + 1) / MOUTH
    directions = np.concatenate(
        [
            np.tile([[-1.0], [0.0]], PHARYNX)[:, :, None],
            rays,
            np.tile([[0.0], [1.0]], MOUTH)[:, :, None],
        ],
        axis=1,
    )
    sections = np.arange(LINES - 1)
    pharynx, velum, mouth, teeth = a.area_factors
    columns = (
        1.0 - np.arange(PHARYNX) / PHARYNX,
        np.polyval(through, angles),
        a.teeth_place * shares,
        np.array([_palate(a, share) for share in shares.tolist()]),
        np.interp(sections, _FACTORS_AT, [pharynx, velum, mouth, mouth, teeth]),
        np.interp(sections, _EXPONENTS_AT, a.area_exponents),
    )
    return _Fixed(
        *(column[:, None].astype(dtype) for column in columns),
        *(vectors.astype(dtype) for vectors in (rays, directions)),
    )


def _palate(a: Anatomy, share: float) -> float:
    """Height of the palate, a row of half cosines, at a share of the way to the teeth."""
    if share < _DOME_END:
        return _half_cosine(a.palate_wall, a.dome_height, share / _DOME_END)
    if share < _RIDGE:
        way = (share - _DOME_END) / (_RIDGE - _DOME_END)
        return _half_cosine(a.dome_height, a.ridge_height, way)
    return _half_cosine(a.ridge_height, a.teeth_height, (share - _RIDGE) / (1 - _RIDGE))


def _half_cosine(start: float, end: float, way: float) -> float:
    return float(start + (end - start) * (1.0 - math.cos(math.pi * way)) / 2.0)
