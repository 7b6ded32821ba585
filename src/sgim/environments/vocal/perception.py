"""What is heard of a vocalisation: two windows of time, three numbers each (section 5.2.1)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sgim.spaces import FloatArray

Sounds = NDArray[np.floating[Any]]
"""Sounds, shape ``(n, 6)``, in double or single precision."""

WINDOWS = ((0.25, 0.40), (0.65, 0.80))
"""When one listens, in s."""

FRAMES = 15
"""In each window."""

SOUND = ("I(1)", "I(2)", "F1(1)", "F1(2)", "F2(1)", "F2(2)")
"""Coordinates of a sound: intensity, first and second formant, in the first and second window."""

MIDDLES = (500.0, 1500.0)
"""Of the formants, in Hz: (F - middle) / middle lies between about -1 and 1."""


def frame_times() -> FloatArray:
    """The middles of all frames, in s, shape ``(30,)``."""
    shares = (np.arange(FRAMES) + 0.5) / FRAMES
    return np.concatenate([start + (end - start) * shares for start, end in WINDOWS])


def perceived(heard: FloatArray, formants: FloatArray) -> FloatArray:
    """The sounds of vocalisations; silent frames count as 0.

    Args:
        heard: Intensity of each frame, 0 or 1, shape ``(30, n)``.
        formants: In Hz, anything where nothing is heard, shape ``(2, 30, n)``.

    Returns:
        Coordinates as in `SOUND`, shape ``(n, 6)``.
    """
    scaled = np.where(heard > 0, formants / np.array(MIDDLES)[:, None, None] - 1.0, 0.0)
    values = np.concatenate([heard[None], scaled])
    windows = values.reshape(len(SOUND), FRAMES, -1)
    total = np.zeros(windows[:, 0].shape)
    for frame in range(FRAMES):  # one by one: NumPy's own sum depends on how many there are
        total += windows[:, frame]
    return np.ascontiguousarray(total.T) / FRAMES


def in_hertz(sound: FloatArray) -> FloatArray:
    """Formants of a sound that is heard throughout both windows.

    Args:
        sound: Shape ``(..., 6)``.

    Returns:
        In Hz, formant by window, shape ``(..., 2, 2)``.
    """
    scaled = sound[..., 2:].reshape(*sound.shape[:-1], 2, 2)
    hertz: FloatArray = (scaled + 1.0) * np.array(MIDDLES)[:, None]
    return hertz
