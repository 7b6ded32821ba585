"""What makes pictures of the same toy differ: light, colour cast, noise, blur, a bar in front."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sgim.environments.objects.camera import Pixels, Shot
from sgim.recognition.picture import Picture

_ZOOMS = 9
_BAR = np.array([0.36, 0.29, 0.25], np.float32)


@dataclass(frozen=True)
class Nuisances:
    """How strong each is; 0 for none.

    Attributes:
        gain: The light varies by so much up or down, as a share.
        white_balance: As does each colour against the others.
        noise: Standard deviation of a colour in grey levels of 255.
        blur: Standard deviation of the blur in pixels.
        bar: Most of the toy that a bar in front hides, as a share.
        bar_probability: How often there is a bar.
        zoom: The toy's size in the picture varies by so much up or down, as a share.
        shift: The toy is so far from the middle of the table at most, each way, in m.
        depth_noise: Standard deviation of the depth in m.
    """

    gain: float = 0.3
    white_balance: float = 0.1
    noise: float = 8.0
    blur: float = 0.6
    bar: float = 0.85
    bar_probability: float = 0.8
    zoom: float = 0.15
    shift: float = 0.03
    depth_noise: float = 0.001

    def draw_zoom(self, rng: np.random.Generator) -> float:
        """One of nine zooms: the camera keeps the empty table of each."""
        step = int(rng.integers(_ZOOMS)) - _ZOOMS // 2
        return 1.0 + self.zoom * step / (_ZOOMS // 2)

    def spoil(self, shot: Shot, rng: np.random.Generator) -> Picture:
        """What a real camera would have seen instead of a perfect one."""
        colours, depth = shot.colours.copy(), shot.depth.copy()
        depth += rng.standard_normal(depth.shape, np.float32) * np.float32(self.depth_noise)
        if rng.random() < self.bar_probability and shot.toy.any():
            hidden = _bar(shot, self.bar * rng.random(), rng)
            colours[hidden] = _BAR
            depth[hidden] = 0.0  # too near for the camera to tell
        if self.blur > 0 and shot.toy.any():
            _blur(colours, shot.toy, self.blur)
        gain = 1 + self.gain * rng.uniform(-1, 1)
        cast = 1 + self.white_balance * rng.uniform(-1, 1, 3)
        colours *= (255 * gain * cast).astype(np.float32)
        colours += rng.standard_normal(colours.shape, np.float32) * np.float32(self.noise)
        np.clip(np.rint(colours, out=colours), 0, 255, out=colours)
        return Picture(colours.astype(np.uint8), np.maximum(depth, 0))


STILL = Nuisances(0, 0, 0, 0, 0, 0, 0, 0, 0)
"""No nuisances: what a perfect camera sees of a toy in the middle of the table."""


def _bar(shot: Shot, share: float, rng: np.random.Generator) -> NDArray[np.bool_]:
    """The pixels of a straight bar that hides a share of the toy."""
    angle, start = rng.uniform(0, np.pi), rng.uniform(0, 1 - share)
    height, width = shot.toy.shape
    along = np.cos(angle) * np.arange(width) + np.sin(angle) * np.arange(height)[:, None]
    low, high = np.quantile(along[shot.toy], [start, start + share])
    return np.asarray((along >= low) & (along < high))


def _blur(colours: Pixels, toy: NDArray[np.bool_], sigma: float) -> None:
    """Blur the toy and its surroundings by a Gaussian of standard deviation ``sigma`` in pixels."""
    reach = int(np.ceil(3 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights = (weights / weights.sum()).astype(np.float32)
    window = []
    for axis in (1, 0):
        inside = np.flatnonzero(toy.any(axis=axis))
        window.append(slice(max(0, inside[0] - 2 * reach), inside[-1] + 2 * reach + 1))
    blurred = colours[tuple(window)]
    for axis in (0, 1):
        n = blurred.shape[axis]
        wide = np.pad(blurred, [(reach,) * 2 if a == axis else (0, 0) for a in range(3)], "edge")
        blurred = np.zeros_like(blurred)
        for i, weight in enumerate(weights):
            blurred += weight * (wide[i : i + n] if axis == 0 else wide[:, i : i + n])
    colours[tuple(window)] = blurred
