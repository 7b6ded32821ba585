"""Steps the MuJoCo model of the rod through one movement at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from sgim.environments.fishing.model import Variant, rod_model
from sgim.environments.fishing.movement import HOME
from sgim.environments.mujoco import mujoco
from sgim.errors import SgimError
from sgim.spaces import FloatArray

_SETTLING_TIME = 40.0
# The wildest of some thousand movements whipped the line at 88 rad/s and the float at 15 m/s.
_FASTEST_HINGE = 300.0
_FASTEST_FLOAT = 25.0


class Simulator:
    """The rod, simulated.

    Every movement starts from the same state: at home, with the line hanging at rest. After a
    Runge-Kutta step MuJoCo's positions are those of its last stage, until they are computed
    again; the model's sensor tells where the float was as the step began.

    Args:
        variant: How finely it is simulated.

    Attributes:
        step: Time step in s.
        rest: Where the float hangs at the start, in m, shape ``(3,)``.

    Raises:
        SgimError: If MuJoCo is not installed.
    """

    def __init__(self, variant: Variant) -> None:
        self._mujoco = mujoco("the fishing rod is simulated")
        self._model, self._start = prepared(variant)
        self._data = self._mujoco.MjData(self._model)
        self._float = int(self._model.body("float").id)
        self.step = variant.step
        self._begin()
        self.rest: FloatArray = self._data.xpos[self._float].copy()

    def land(self, set_points: FloatArray) -> FloatArray | None:
        """Where the float first meets the water.

        Args:
            set_points: Of the joints in rad, one row a time step, shape ``(t, 6)``.

        Returns:
            Position (x, y) in m, shape ``(2,)``, interpolated between two steps; None if the
            float never meets the water.

        Raises:
            SgimError: If the simulation becomes unstable.
        """
        step, kinematics = self._mujoco.mj_step, self._mujoco.mj_kinematics
        model, data = self._model, self._data
        position, before, control = data.xpos[self._float], data.sensordata, data.ctrl
        farthest = _FASTEST_FLOAT * self.step
        with _Silence(self._mujoco):
            self._begin()
            for row in set_points:
                control[:] = row
                step(model, data)
                # From so high only an unstable float falls into the water in one step; if it
                # does, the next one begins under water.
                if before[2] > farthest:
                    continue
                kinematics(model, data)
                if not (position[2] > 0.0 and before[2] > 0.0):
                    break
            kinematics(model, data)
            self._require_stable(before, above=0.0)
        height = float(position[2])
        if height > 0.0:
            return None
        share = float(before[2]) / (float(before[2]) - height)
        landing: FloatArray = before[:2] + share * (position[:2] - before[:2])
        return landing

    def end(self, set_points: FloatArray) -> tuple[FloatArray, float]:
        """Where the float is after a movement, and how fast it still moves.

        Args:
            set_points: As in `land`.

        Returns:
            Position in m, shape ``(3,)``, and speed in m/s over the last step.

        Raises:
            SgimError: If the simulation becomes unstable.
        """
        model, data = self._model, self._data
        position, before, control = data.xpos[self._float], data.sensordata, data.ctrl
        with _Silence(self._mujoco):
            self._begin()
            for row in set_points:
                control[:] = row
                self._mujoco.mj_step(model, data)
            self._mujoco.mj_kinematics(model, data)
            self._require_stable(before)
        return position.copy(), float(np.linalg.norm(position - before)) / self.step

    def positions(self, set_points: FloatArray) -> tuple[tuple[str, ...], FloatArray]:
        """Where all bodies are during a movement, which goes on under water.

        Args:
            set_points: As in `land`.

        Returns:
            The bodies' names, from the arm's base to the float; and the positions of their
            origins in m, at the start and after each step, shape ``(t + 1, bodies, 3)``.

        Raises:
            SgimError: If the simulation becomes unstable.
        """
        model, data = self._model, self._data
        names = tuple(str(model.body(i).name) for i in range(1, model.nbody))
        path = np.empty((len(set_points) + 1, len(names), 3))
        with _Silence(self._mujoco):
            self._begin()
            path[0] = data.xpos[1:]
            for i, row in enumerate(set_points):
                data.ctrl[:] = row
                self._mujoco.mj_step(model, data)
                self._mujoco.mj_kinematics(model, data)
                path[i + 1] = data.xpos[1:]
            self._require_stable(path[-2, -1])
        return names, path

    def _begin(self) -> None:
        self._mujoco.mj_resetData(self._model, self._data)
        self._data.qpos[:] = self._start
        self._data.act[:] = HOME
        self._mujoco.mj_kinematics(self._model, self._data)

    def _require_stable(self, before: FloatArray, above: float = -math.inf) -> None:
        """Refuse the last state if any step went wrong.

        Args:
            before: Where the float was before the last step, in m.
            above: The height in m that it must have been above.
        """
        data = self._data
        speed = float(np.linalg.norm(data.xpos[self._float] - before)) / self.step
        # A state that has just exploded is not counted by MuJoCo before the next step.
        calm = speed < _FASTEST_FLOAT and float(np.abs(data.qvel).max()) < _FASTEST_HINGE
        if data.warning.number.any() or not (calm and before[2] > above):
            raise SgimError(
                f"the simulated line became unstable within {data.time:.3f} s: what this movement "
                "produces is not known; count it as failed"
            )


@cache
def prepared(variant: Variant) -> tuple[Any, FloatArray]:
    """The MuJoCo model, and its joint angles at home with the line hanging at rest."""
    engine = mujoco("the fishing rod is simulated")
    settling = engine.MjModel.from_xml_string(rod_model(variant, settling=True))
    data = engine.MjData(settling)
    data.qpos[: len(HOME)] = data.act[:] = data.ctrl[:] = HOME
    engine.mj_step(settling, data, round(_SETTLING_TIME / settling.opt.timestep))
    return engine.MjModel.from_xml_string(rod_model(variant)), np.array(data.qpos)


class _Silence:
    """Keeps MuJoCo from writing its warnings to a file in the working directory."""

    def __init__(self, engine: Any) -> None:
        self._engine = engine

    def __enter__(self) -> None:
        self._before = self._engine.get_mju_user_warning()
        self._engine.set_mju_user_warning(_ignore)

    def __exit__(self, *exception: Sequence[object]) -> None:
        self._engine.set_mju_user_warning(self._before)


def _ignore(message: str) -> None:
    pass
