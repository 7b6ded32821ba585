"""Classes of vocalisations, for analysis only: no learner knows them (section 5.2.1.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sgim.environments.vocal.perception import SOUND, Sounds

PHONES = ("N", "C", "V")
"""None, heard less than a tenth of a window; consonant; vowel, heard more than nine tenths."""

TYPES = ("NN", "CN", "NC", "VN", "NV", "VV", "CV", "VC", "CC")
"""Types of vocalisations: the phones of their two windows, in the order of table 5.3.2."""

CLASSES = ("no phonation", "unarticulated", "articulated")
"""No phone at all; one that is none; two phones."""

_BOUNDS = (0.1, 0.9)


def phones(sounds: Sounds) -> NDArray[np.int64]:
    """The phones of sounds, as places in `PHONES`.

    Args:
        sounds: Shape ``(n, 6)``.

    Returns:
        Shape ``(n, 2)``.
    """
    intensities = sounds[:, [SOUND.index("I(1)"), SOUND.index("I(2)")]]
    found: NDArray[np.int64] = (intensities >= _BOUNDS[0]).astype(np.int64)
    found += intensities > _BOUNDS[1]
    return found


def types(sounds: Sounds) -> NDArray[np.int64]:
    """The types of sounds, as places in `TYPES`, shape ``(n,)``."""
    number = {name: i for i, name in enumerate(TYPES)}
    table = np.array([[number[first + second] for second in PHONES] for first in PHONES])
    first, second = phones(sounds).T
    found: NDArray[np.int64] = table[first, second]
    return found


def classes(sounds: Sounds) -> NDArray[np.int64]:
    """The classes of sounds, as places in `CLASSES`, shape ``(n,)``."""
    heard: NDArray[np.int64] = (phones(sounds) > 0).sum(axis=1)
    return heard
