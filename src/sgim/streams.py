"""Random numbers from streams named after what they are for.

A stream is a function of the seed and its name alone, so adding a component shifts nobody's
numbers, and no generator has a state to save: ``streams("learner", 12)`` is the same generator
today, tomorrow, and after a resume.
"""

from __future__ import annotations

import hashlib
from functools import lru_cache

import numpy as np


@lru_cache(maxsize=1024)
def _digest(name: str) -> int:
    return int.from_bytes(hashlib.blake2b(name.encode(), digest_size=8).digest(), "little")


class Streams:
    """Named random streams of one run.

    Args:
        seed: The run's seed, a non-negative integer.

    Raises:
        ValueError: If the seed is not a non-negative integer.
    """

    __slots__ = ("seed",)

    def __init__(self, seed: int) -> None:
        if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
            raise ValueError(f"seed is {seed!r}, expected a non-negative integer")
        self.seed = int(seed)

    def __call__(self, name: str, index: int = 0) -> np.random.Generator:
        """Open the stream called ``name``, number ``index``, at its beginning."""
        entropy = (self.seed, _digest(name), index)
        return np.random.Generator(np.random.PCG64(np.random.SeedSequence(entropy)))
