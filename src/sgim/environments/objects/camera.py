"""A camera with depth, by casting rays with MuJoCo: no OpenGL and no display.

Only rays through the toy's bounding spheres are cast; the table behind is computed once a zoom.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.environments.objects.texture import texture
from sgim.spaces import FloatArray

Pixels = NDArray[np.float32]

_LIGHT = np.array([-0.36, -0.47, 0.81]) / np.linalg.norm([-0.36, -0.47, 0.81])
_AMBIENT = 0.45
_CONTRAST = 0.85  # of the toys' texture; the table's is fainter
_TABLE = np.array([0.72, 0.68, 0.62])
_FARTHEST = 10.0


@dataclass(frozen=True)
class Shot:
    """What a perfect camera sees.

    Attributes:
        colours: Red, green and blue from 0 to 1, shape ``(height, width, 3)``.
        depth: Distance along the optical axis in m, shape ``(height, width)``.
        toy: Where the toy is, shape ``(height, width)``.
    """

    colours: Pixels
    depth: Pixels
    toy: NDArray[np.bool_]


class Camera:
    """Looks down on the middle of the table at an angle of 45°.

    Args:
        mujoco: The module.
        width: Of pictures in pixels.
        height: Of pictures in pixels.
        distance: From the middle of the table in m.
        view: Horizontal angle of view in degrees.
    """

    def __init__(
        self,
        mujoco: Any,
        width: int = 320,
        height: int = 240,
        distance: float = 0.45,
        view: float = 40.0,
    ) -> None:
        self._mujoco = mujoco
        self.width, self.height = width, height
        self.place = distance * np.array([0.0, -np.sqrt(0.5), np.sqrt(0.5)])
        self._forward = -self.place / distance
        self._right = np.array([1.0, 0.0, 0.0])
        self._down = np.cross(self._forward, self._right)
        self._focal = width / 2 / np.tan(np.radians(view) / 2)
        self._table = lru_cache(maxsize=16)(self._empty_table)

    def _rays(self, zoom: float) -> FloatArray:
        """Unit vectors through the pixels, shape ``(height, width, 3)``."""
        focal = self._focal * zoom
        u = (np.arange(self.width) + 0.5 - self.width / 2)[None, :, None] / focal
        v = (np.arange(self.height) + 0.5 - self.height / 2)[:, None, None] / focal
        rays = self._forward + u * self._right + v * self._down
        unit: FloatArray = rays / np.linalg.norm(rays, axis=2, keepdims=True)
        return unit

    def _empty_table(self, zoom: float) -> tuple[FloatArray, Pixels, Pixels]:
        """Rays, colours and depth of the table without a toy."""
        rays = self._rays(zoom)
        far = -self.place[2] / rays[:, :, 2]
        ground = (self.place + rays * far[:, :, None]).reshape(-1, 3).T
        grain = texture(ground, np.zeros((3, 1))).reshape(self.height, self.width, 1)
        shade = _AMBIENT + (1 - _AMBIENT) * _LIGHT[2]
        colours = (_TABLE * shade * (1 + 0.15 * grain)).astype(np.float32)
        return rays, colours, (far * (rays @ self._forward)).astype(np.float32)

    def shoot(self, model: Any, data: Any, zoom: float = 1.0) -> Shot:
        """Take a picture of the toy of a model.

        Args:
            model: The MuJoCo model; geoms of group 0 are the toy.
            data: Its state, with kinematics computed.
            zoom: By which the focal length is multiplied. The table is kept for 16 zooms.
        """
        rays, colours, depth = self._table(zoom)
        colours, depth = colours.copy(), depth.copy()
        toy = np.zeros(depth.shape, bool)
        window = self._around(model, data, zoom)
        cast = rays[window]
        hit, distance, normal = self._cast(model, data, cast.reshape(-1, 3))
        shown = hit >= 0
        toy[window] = shown.reshape(cast.shape[:2])
        hit, distance, seen = hit[shown], distance[shown], cast.reshape(-1, 3)[shown]
        points = self.place + seen * distance[:, None] - data.geom_xpos[hit]
        turns = data.geom_xmat.reshape(-1, 3, 3)[hit]
        local = np.matmul(points[:, None, :], turns)[:, 0].T
        grain = texture(local, np.array([[0.037], [0.063], [0.085]]) * hit)
        light = _AMBIENT + (1 - _AMBIENT) * np.maximum(0, normal[shown] @ _LIGHT)
        paint = model.geom_rgba[hit, :3] * (light * (1 + _CONTRAST * grain))[:, None]
        colours[toy] = np.clip(paint, 0, 1)
        depth[toy] = distance * (seen @ self._forward)
        return Shot(colours, depth, toy)

    def _around(self, model: Any, data: Any, zoom: float) -> tuple[slice, slice]:
        """The pixels in which the toy can be, from the bounding spheres of its parts."""
        parts = np.flatnonzero(model.geom_group == 0)
        bound = model.geom_rbound[parts]
        offset = data.geom_xpos[parts] - self.place
        ahead = offset @ self._forward
        radius = bound * self._focal * zoom / (ahead - bound)

        def span(axis: FloatArray, size: int) -> slice:
            middle = offset @ axis / ahead * self._focal * zoom + size / 2
            low = int(np.clip((middle - radius).min(), 0, size - 1))
            return slice(low, int(np.clip((middle + radius).max() + 1, low + 1, size)))

        return span(self._down, self.height), span(self._right, self.width)

    def _cast(self, model: Any, data: Any, rays: FloatArray) -> tuple[Any, FloatArray, FloatArray]:
        """For each ray the geom it hits or −1, the distance, and the surface's normal."""
        n = len(rays)
        hit, distance, normal = np.empty(n, np.int32), np.empty(n), np.empty(3 * n)
        only_toy = np.array([1, 0, 0, 0, 0, 0], np.uint8)
        vectors = np.ascontiguousarray(rays).reshape(-1)
        self._mujoco.mj_multiRay(
            model,
            data,
            self.place,
            vectors,
            only_toy,
            True,
            -1,
            hit,
            distance,
            normal,
            n,
            _FARTHEST,
        )
        return hit, distance, normal.reshape(n, 3)
