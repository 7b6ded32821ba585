"""Planar arms of many joints: the classic world of goal babbling (SAGG-RIAC and since)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sgim.environments.base import Environment, Generators
from sgim.errors import SpaceError
from sgim.records import Outcome
from sgim.spaces import Box, FloatArray
from sgim.task import Task


class PlanarArm(Environment):
    """An arm of total length 1 m in the plane; a policy is the posture it takes.

    The base is at the origin and the arm, with all angles 0, lies along the x axis. The outcome
    ``hand`` is the position (x, y) of the tip in m, with Gaussian noise.

    Args:
        joints: Number of joints, 1 or more; their angles are each relative to the link before.
        length_ratio: Length of each link over that of the link before it; below 1, links get
            shorter toward the tip.
        limit: Joint limit in rad, the same either way for all joints.
        low: Lower corner of the goal box in m; what is reached may lie outside the box.
        high: Upper corner of the goal box in m.
        noise: Standard deviation in m of the noise on each coordinate; 0 for none.
        vary_start: Whether the base stands turned by an angle in [-0.5, 0.5] rad that differs
            from trial to trial: the context ``base``.

    Attributes:
        goal_box: The space of ``hand``.
        task: One policy parameter a joint, the outcome ``hand``, and the context ``base``, if any.
        deterministic: Whether there is no noise.
        lengths: Lengths of the links in m, shape ``(joints,)``.

    Raises:
        SpaceError: If a number is out of its range.
    """

    def __init__(
        self,
        joints: int = 7,
        *,
        length_ratio: float = 1.0,
        limit: float = math.radians(60),
        low: ArrayLike = (-0.5, -1.0),
        high: ArrayLike = (1.0, 1.0),
        noise: float = 0.02,
        vary_start: bool = False,
    ) -> None:
        if joints < 1:
            raise SpaceError(f"joints is {joints}, expected 1 or more")
        if not 0 < length_ratio < math.inf:
            raise SpaceError(f"length_ratio is {length_ratio}, expected a positive number")
        if not 0 <= noise < math.inf:
            raise SpaceError(f"noise is {noise}, expected 0 or more, in m")
        lengths = length_ratio ** np.arange(joints, dtype=np.float64)
        self.joints = joints
        self.length_ratio = length_ratio
        self.limit = limit
        self.noise = noise
        self.deterministic = noise == 0
        self.vary_start = vary_start
        self.lengths = lengths / lengths.sum()
        self.goal_box = Box(low, high, names=("x", "y"), unit="m")
        self.task = Task(
            Box(-limit, limit, names=[f"joint_{i + 1}" for i in range(joints)], unit="rad"),
            {"hand": self.goal_box},
            context_space=Box(-0.5, 0.5, names=("base",), unit="rad") if vary_start else None,
        )

    def without_noise(self) -> PlanarArm:
        """The same arm without noise: what evaluations measure by."""
        return PlanarArm(
            self.joints,
            length_ratio=self.length_ratio,
            limit=self.limit,
            low=self.goal_box.low,
            high=self.goal_box.high,
            noise=0.0,
            vary_start=self.vary_start,
        )

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Take one posture; limits are not checked.

        Args:
            policy: Relative angles in rad, shape ``(joints,)``.
            context: Angle of the base in rad, shape ``(1,)``, if the arm has contexts.
            rng: The trial's generator; unused without noise.

        Raises:
            SpaceError: If a shape is wrong, a context is missing, or noise has no generator.
        """
        contexts = None if context is None else [context]
        return self.execute_batch([policy], contexts, None if rng is None else [rng])[0]

    def execute_batch(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
        rngs: Generators | None = None,
    ) -> list[Outcome]:
        """Take several postures, shape ``(n, joints)``; see `execute`."""
        if len(policies) == 0:
            return []
        hands = self.hands(policies, contexts)
        if self.noise:
            if rngs is None or len(rngs) != len(hands):
                raise SpaceError(
                    f"an arm with noise needs a generator for each of {len(hands)} trials, "
                    f"got {0 if rngs is None else len(rngs)}"
                )
            for hand, rng in zip(hands, rngs, strict=True):
                hand += self.noise * rng.standard_normal(2)
        return [{"hand": hand} for hand in hands]

    def hands(
        self,
        policies: Sequence[Any] | FloatArray,
        contexts: Sequence[Any] | FloatArray | None = None,
    ) -> FloatArray:
        """Positions of the tip without noise, in m, shape ``(n, 2)``."""
        angles = np.array(policies, dtype=np.float64)
        if angles.ndim != 2 or angles.shape[1] != self.joints:
            raise SpaceError(f"policies have shape {angles.shape}, expected (n, {self.joints})")
        if self.vary_start != (contexts is not None):
            raise SpaceError(
                "this arm has contexts: pass the angle of the base for each trial"
                if self.vary_start
                else "this arm has no contexts, but some came"
            )
        if contexts is not None:
            bases = np.asarray(contexts, dtype=np.float64)
            if bases.shape != (len(angles), 1):
                raise SpaceError(f"contexts have shape {bases.shape}, expected ({len(angles)}, 1)")
            angles[:, 0] += bases[:, 0]
        np.cumsum(angles, axis=1, out=angles)
        hands = np.empty((len(angles), 2))
        # Sums along rows, not a matrix product: its rounding depends on the number of rows.
        hands[:, 0] = (self.lengths * np.cos(angles)).sum(axis=1)
        hands[:, 1] = (self.lengths * np.sin(angles)).sum(axis=1)
        return hands
