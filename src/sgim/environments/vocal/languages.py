"""Ambient languages: what is spoken around the learner, two sounds each (section 5.3.2).

Sounds are spoken by an adult of the same tract: the learner needs no correspondence, but it hears
outcomes only, since it cannot see how a sound is made.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

import numpy as np

from sgim.environments.vocal.articulations import articulations
from sgim.environments.vocal.motor import NEUTRAL, weights
from sgim.environments.vocal.perception import WINDOWS
from sgim.environments.vocal.world import KIND, VocalTract
from sgim.records import Demonstration, Goal
from sgim.spaces import Box, FloatArray

LANGUAGES = MappingProxyType(
    {
        "1": (("labial", "a"), ("labial", "i")),
        "2": (("a", "hid"), ("i", "hid")),
        "3": (("u", "i"), ("u", "hid")),
    }
)
"""Name → two sounds, each the articulations at the middle of the two windows.

The syllables of the first differ in F1(2); the vowels of the second in F1(1); those of the third
all have F1(1) < 0 and F2(2) > 0.
"""

DESCRIPTIONS = MappingProxyType(
    {
        "1": "says two syllables of a closure and a vowel, /ba/ and /bi/",
        "2": "says two pairs of vowels that differ in the first, /aɪ/ and /iɪ/",
        "3": "says two pairs of vowels that differ little, /ui/ and /uɪ/",
    }
)

_VOICE = 1.0  # pressure and voicing


@dataclass(frozen=True)
class AmbientLanguage:
    """A teacher who says one of a few sounds at random, whatever it is asked for.

    Attributes:
        sounds: The sounds, shape ``(n, 6)``.
    """

    sounds: FloatArray

    def demonstrate(self, goal: Goal | None, rng: np.random.Generator) -> Demonstration:
        """One of the sounds: an outcome without the policy that made it."""
        return Demonstration({KIND: self.sounds[int(rng.integers(len(self.sounds)))]})


def spoken(first: str, second: str) -> FloatArray:
    """The policy of a voiced vocalisation that is in two articulations when one listens.

    The motors are to be there at the middle of each window; commands beyond the bounds of the
    policy space, which the delay may ask for, are clipped.

    Args:
        first: Name of an articulation.
        second: That of another.

    Returns:
        Shape ``(18,)``.
    """
    table = articulations()
    wanted = np.array([[*table[name], _VOICE, _VOICE] for name in (first, second)])
    neutral, *commands = weights(np.array([sum(window) / 2 for window in WINDOWS]))
    policy = np.linalg.solve(np.array(commands).T, wanted - np.outer(neutral, NEUTRAL))
    space = VocalTract().task.policy_space
    assert isinstance(space, Box)
    return space.clip(policy.ravel())


@cache
def ambient_language(name: str) -> AmbientLanguage:
    """The language of this name, one of `LANGUAGES`."""
    policies = [spoken(*phones) for phones in LANGUAGES[name]]
    sounds = VocalTract(noise=0.0).sounds(policies)
    sounds.flags.writeable = False
    return AmbientLanguage(sounds)
