"""The arm led by a hand that holds the rod's tip or turns single joints, simulated as it goes."""

from __future__ import annotations

import numpy as np

from sgim.environments.fishing.model import FAST, JOINTS, Variant
from sgim.environments.fishing.movement import AMPLITUDES, HOME
from sgim.environments.fishing.simulator import prepared
from sgim.environments.mujoco import mujoco
from sgim.spaces import FloatArray

LOW: FloatArray = HOME - AMPLITUDES
HIGH: FloatArray = HOME + AMPLITUDES

_ROUNDS = 12
_CLOSE = 1e-4
_DAMPING = 0.03
_LONGEST_STRIDE = 0.12
_HOMING = 0.02


class LedArm:
    """The simulated rod, whose joints follow a hand in real time.

    Args:
        variant: How finely it is simulated.

    Attributes:
        names: The bodies whose positions `positions` gives, from the base to the float.

    Raises:
        SgimError: If MuJoCo is not installed.
    """

    def __init__(self, variant: Variant = FAST) -> None:
        self._engine = mujoco("the arm that is led is simulated")
        self._model, self._start = prepared(variant)
        self._data = self._engine.MjData(self._model)
        self._stiff = self._engine.MjData(self._model)  # the arm with a straight rod
        self._tip = int(self._model.body("line0").id)
        self._jacobian = np.zeros((3, self._model.nv))
        self._step = variant.step
        self._owed = 0.0
        self.names = tuple(str(self._model.body(i).name) for i in range(1, self._model.nbody))
        self.reset()

    def reset(self) -> None:
        """Back home, with the line hanging at rest."""
        self._engine.mj_resetData(self._model, self._data)
        self._data.qpos[:] = self._start
        self._data.act[:] = self._data.ctrl[:] = HOME
        self._owed = 0.0
        self._engine.mj_kinematics(self._model, self._data)

    def positions(self) -> FloatArray:
        """Where the bodies are now, in m, shape ``(bodies, 3)``."""
        return np.array(self._data.xpos[1:])

    def advance(self, joints: FloatArray, seconds: float) -> None:
        """Let the arm follow set-points of its joints for a while.

        Args:
            joints: In rad, shape ``(6,)``; brought within the limits.
            seconds: How long; what is less than a step of the simulation is made up for later.
        """
        self._data.ctrl[:] = np.clip(joints, LOW, HIGH)
        self._owed += seconds
        steps = int(self._owed / self._step)
        if steps:
            self._owed -= steps * self._step
            self._engine.mj_step(self._model, self._data, steps)
            self._engine.mj_kinematics(self._model, self._data)
            if self._data.warning.number.any():
                self.reset()

    def tip(self, joints: FloatArray) -> FloatArray:
        """Where the tip of the rod would be, did it not bend, in m, shape ``(3,)``."""
        self._pose(joints)
        return np.array(self._stiff.xpos[self._tip])

    def reach(self, target: FloatArray, joints: FloatArray) -> FloatArray:
        """The angles near given ones, within the limits, that bring the rod's tip to a place.

        Damped least squares (Nakamura and Hanafusa 1986); a joint at its limit is left out while
        it would go beyond, and what is free in the posture drifts home. Where the place is out
        of reach, the tip comes near it.

        Args:
            target: In m, shape ``(3,)``.
            joints: Where to start, in rad, shape ``(6,)``.

        Returns:
            Angles in rad, shape ``(6,)``.
        """
        angles = np.clip(joints, LOW, HIGH)
        best, least = angles, np.inf
        for _ in range(_ROUNDS):
            gap = target - self.tip(angles)
            distance = float(np.sqrt(gap @ gap))
            if distance < least:
                best, least = angles, distance
            if distance < _CLOSE:
                break
            if distance > _LONGEST_STRIDE:
                gap *= _LONGEST_STRIDE / distance
            angles = np.clip(angles + self._stride(angles, gap), LOW, HIGH)
        return best

    def _stride(self, angles: FloatArray, gap: FloatArray) -> FloatArray:
        self._engine.mj_comPos(self._model, self._stiff)
        self._engine.mj_jac(
            self._model, self._stiff, self._jacobian, None, self._stiff.xpos[self._tip], self._tip
        )
        jacobian = self._jacobian[:, : len(JOINTS)].copy()
        stride = np.zeros(len(JOINTS))
        for _ in range(2):
            weighed = np.linalg.inv(jacobian @ jacobian.T + _DAMPING**2 * np.eye(3))
            inverse = jacobian.T @ weighed
            home = _HOMING * (HOME - angles)
            stride = inverse @ gap + home - inverse @ (jacobian @ home)
            stuck = ((angles >= HIGH) & (stride > 0)) | ((angles <= LOW) & (stride < 0))
            if not stuck.any():
                break
            jacobian[:, stuck] = 0.0
        return stride

    def _pose(self, joints: FloatArray) -> None:
        self._stiff.qpos[: len(JOINTS)] = joints
        self._engine.mj_kinematics(self._model, self._stiff)
