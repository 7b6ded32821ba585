"""The world of chapter 5: a vocal tract, its motors, and the ear that hears it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.environments.base import Environment, Generators
from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS, Anatomy
from sgim.environments.vocal.formants import RANGES, formants
from sgim.environments.vocal.geometry import contours, tube
from sgim.environments.vocal.motor import DURATION, MOTORS, NEUTRAL, trajectories
from sgim.environments.vocal.perception import SOUND, frame_times, perceived
from sgim.errors import SgimError, SpaceError
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task

COMMANDS = 2 * len(MOTORS)

KIND = "sound"
"""The kind of outcome."""

_PRESSURE, _VOICING = MOTORS.index("pressure"), MOTORS.index("voicing")
_FRAMES_AT_ONCE = 6000  # so that a section of all of them stays in the cache
_THIRD = (1200.0, 5000.0)  # where the third formant is searched, in Hz


@dataclass(frozen=True)
class Vocalisation:
    """A vocalisation in full.

    Attributes:
        times: In s, shape ``(t,)``.
        positions: Of `MOTORS`, shape ``(9, t)``.
        heard: Intensity, 0 or 1, shape ``(t,)``.
        formants: The first three in Hz, NaN where nothing is heard, shape ``(3, t)``.
    """

    times: FloatArray
    positions: FloatArray
    heard: FloatArray
    formants: FloatArray


class VocalTract(Environment):
    """A vocal tract that speaks for 0.8 s.

    A policy is two commands of nine, each in [-3, 3]: of the first, which holds for 0.25 s, and
    then of the second, jaw, tongue body, tongue height, tongue tip, lip height, lip protrusion,
    larynx height, pressure and voicing. 0 is neutral for the articulators; pressure and voicing
    rest at -0.25, and there is a voice where both exceed 0 and the tract is open.

    - ``sound``: intensity, and first and second formant scaled to about [-1, 1], each as heard
      from 250 to 400 and from 650 to 800 ms: (I(1), I(2), F1(1), F1(2), F2(1), F2(2)).

    Args:
        noise: Standard deviation of what is added to each coordinate of a sound.
        anatomy: Whose tract.

    Attributes:
        task: 18 policy parameters; the outcome ``sound``.
        deterministic: Whether there is no noise.
    """

    def __init__(self, noise: float = 0.01, anatomy: Anatomy = ADULT) -> None:
        self.noise = noise
        self.anatomy = anatomy
        self.deterministic = noise == 0.0
        names = [f"{motor} {command}" for command in (1, 2) for motor in MOTORS]
        self.task = Task(
            Box(-3.0, 3.0, names=names),
            {KIND: Box([0, 0, -1, -1, -1, -1], 1.0, names=SOUND)},
            tolerances={KIND: 0.03},
            rest=np.tile(NEUTRAL, 2),
        )

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy, shape ``(18,)``; bounds are not checked.

        Raises:
            SpaceError: If the policy has another shape.
        """
        return self.execute_batch([policy], None, None if rng is None else [rng])[0]

    def execute_batch(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
        rngs: Generators | None = None,
    ) -> list[Outcome]:
        """Execute several policies, shape ``(n, 18)``; bounds are not checked.

        Raises:
            SpaceError: If the policies have another shape.
        """
        if len(policies) == 0:
            return []
        sounds = self.sounds(policies)
        if not self.deterministic:
            if rngs is None:
                raise SgimError("a vocal tract with noise needs a generator for each vocalisation")
            sounds += [self.noise * rng.standard_normal(len(SOUND)) for rng in rngs]
        return [{KIND: sound} for sound in sounds]

    def sounds(self, policies: Sequence[Any] | FloatArray) -> FloatArray:
        """What each of several policies sounds like without noise, shape ``(n, 6)``.

        Raises:
            SpaceError: If the policies do not have shape ``(n, 18)``.
        """
        values = np.asarray(policies, dtype=np.float64)
        if values.ndim != 2 or values.shape[1] != COMMANDS:
            raise SpaceError(f"policies have shape {values.shape}, expected (n, {COMMANDS})")
        positions = trajectories(values, frame_times())
        motors, *frames = positions.shape
        heard, found = self._voice(positions.reshape(motors, -1), RANGES)
        return perceived(heard.reshape(frames), found.reshape(len(RANGES), *frames))

    def vocalise(self, policy: Any, step: float = 0.005) -> Vocalisation:
        """One policy's vocalisation in full, without noise.

        Args:
            policy: Shape ``(18,)``.
            step: Time step in s.
        """
        times: FloatArray = np.linspace(0.0, DURATION, round(DURATION / step) + 1)
        checked = self.task.policy_space.check(policy, "policy")
        positions = trajectories(checked[None], times)[:, :, 0]
        heard, found = self._voice(positions, (*RANGES, _THIRD))
        return Vocalisation(times, positions, heard, np.where(heard > 0, found, np.nan))

    def _voice(
        self, positions: FloatArray, ranges: Sequence[tuple[float, float]]
    ) -> tuple[FloatArray, FloatArray]:
        """Intensity at positions, shape ``(n,)``, and formants, which are 0 where it is 0."""
        heard, found = np.zeros(positions.shape[1]), np.zeros((len(ranges), positions.shape[1]))
        voiced = np.flatnonzero((positions[_PRESSURE] > 0) & (positions[_VOICING] > 0))
        articulators = positions[: len(ARTICULATORS)].astype(np.float32)
        for start in range(0, len(voiced), _FRAMES_AT_ONCE):
            chosen = voiced[start : start + _FRAMES_AT_ONCE]
            their = articulators[:, chosen]
            shape = contours(self.anatomy, their)
            opened = shape.opening > 0
            heard[chosen] = opened
            found[:, chosen] = np.where(
                opened, formants(tube(self.anatomy, their, shape), ranges), 0
            )
        return heard, found
