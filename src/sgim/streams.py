"""Random numbers from streams named after what they are for.

A stream is a function of the seed and its name alone, so adding a component shifts nobody's
numbers, and no generator has a state to save: ``streams("learner", 12)`` is the same generator
today, tomorrow, and after a resume.
"""

from __future__ import annotations

import hashlib
from functools import lru_cache
from typing import Any, cast

import numpy as np
from numpy.random.bit_generator import ISeedSequence

_LITTLE_ENDIAN = np.dtype("<u8")


class _Words(ISeedSequence):
    """Hands a generator the words it starts from; NumPy's own way takes three times as long."""

    def __init__(self, words: np.ndarray[Any, np.dtype[np.uint64]]) -> None:
        self.words = words

    def generate_state(self, n_words: int, dtype: Any = np.uint32) -> Any:
        """The words: a PCG64 asks for four of 64 bits."""
        return self.words


@lru_cache(maxsize=1024)
def _hash(seed: int, name: str) -> hashlib.blake2b:
    return hashlib.blake2b(f"{seed}/{name}".encode(), digest_size=32)


class Streams:
    """Named random streams of one run.

    A stream starts from a BLAKE2 hash of seed, name and number, so that any two are independent.

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
        digest = _hash(self.seed, name).copy()
        digest.update(int(index).to_bytes(8, "little", signed=True))
        words = np.frombuffer(digest.digest(), _LITTLE_ENDIAN).astype(np.uint64, copy=False)
        return np.random.Generator(np.random.PCG64(cast(Any, _Words(words))))
