"""A two-link pendulum that swings its tip where asked, simulated by Gymnasium's Acrobot."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.environments.gymnasium import Controller, GymnasiumWorld, Rollout, gymnasium
from sgim.records import Outcome
from sgim.spaces import Box, Space

_STEPS = 75
_PIECES = 15
_START = 0.02


class _Torques:
    """Torques constant for a second each, on a motor that knows only −1, 0 and 1 N m.

    The sum of the torques follows the sum of what is commanded. Steps are of 0.2 s.
    """

    def __init__(self) -> None:
        names = [f"torque_{i + 1}" for i in range(_PIECES)]
        self.policy_space: Space = Box(-1.0, 1.0, names=names, unit="N m")

    def begin(self, policy: Any) -> Controller:
        """Torques by step, without feedback."""
        commands = np.repeat(np.asarray(policy, dtype=np.float64), _STEPS // _PIECES)
        # The sum of all commands so far is rounded, rather than each, so that no error adds up.
        torques = np.diff(np.rint(np.cumsum(commands)), prepend=0.0).clip(-1, 1)
        actions = iter((torques + 1).astype(int).tolist())
        return lambda observation: next(actions, None)


class Acrobot(GymnasiumWorld):
    """Acrobot: a double pendulum with a motor between its links, each of 1 m and 1 kg.

    It starts hanging, up to 0.02 rad (and rad/s) off, which makes it noisy: swings amplify it. A
    policy is fifteen torques of a second each, in N m; the outcome ``tip`` is where the tip is
    after 15 s, or when it first is 1 m above the pivot; x to the right and y up from the pivot, in
    m. The motor is too weak to lift the links at once: to get high, swing. (Sutton 1996;
    Gymnasium's ``Acrobot-v1``.)
    """

    def __init__(self) -> None:
        spaces = {"tip": Box(-2.0, 2.0, names=("x", "y"), unit="m")}
        options = {"low": -_START, "high": _START}
        super().__init__(_acrobot, _Torques(), spaces, _tip, options=options)


def _acrobot() -> Any:
    return gymnasium().make("Acrobot-v1").unwrapped


def _tip(rollout: Rollout) -> Outcome:
    cos_1, sin_1, cos_2, sin_2 = np.asarray(rollout.observations[-1], dtype=np.float64)[:4]
    # The second angle is relative to the first.
    x = sin_1 + sin_1 * cos_2 + cos_1 * sin_2
    y = -cos_1 - (cos_1 * cos_2 - sin_1 * sin_2)
    return {"tip": np.array([x, y])}
