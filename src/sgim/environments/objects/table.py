"""The table on which toys are manipulated, and the camera over it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sgim.environments.base import Environment
from sgim.environments.mujoco import mujoco
from sgim.environments.objects.camera import Camera
from sgim.environments.objects.nuisances import Nuisances
from sgim.environments.objects.toys import TOYS, toy_model
from sgim.recognition.features import FEATURES, Eye
from sgim.recognition.picture import Picture
from sgim.records import Outcome
from sgim.spaces import Choices, FloatArray
from sgim.task import Task

ACTIONS = ("push", "lift", "watch")
"""What can be done with a toy: the robot's own two, and to watch a caregiver."""

_TIME_STEP = 0.004  # s
_SETTLING_TIME = 1.0  # s
_DROP = 0.12  # m
_HELD = 0.06  # m
_PUSH = (0.3, 0.9)  # m/s
_TIP = 12.0  # rad/s for each m/s
_SPIN = 12.0  # rad/s


class ToyTable(Environment):
    """Toys that are pushed, dropped or shown, one at a time, and then looked at.

    A policy is an action and a toy, such as ``push car``. The robot pushes a toy that a caregiver
    has stood before it turned anyhow, or lifts and drops it turned over anyhow; ``watch`` is to
    have it put down by a caregiver. When it has come to rest, a picture is taken. The outcome is
    the ``view``, which is the features of the picture, and the ``toy``, which is its label.

    Args:
        nuisances: What spoils the pictures.
        width: Of pictures in pixels.
        height: Of pictures in pixels.

    Attributes:
        task: Its spaces.
        deterministic: False.
        nuisances: As given.
        eye: Finds the features of pictures.
        toys: Their names.

    Raises:
        SgimError: If MuJoCo is not installed.
    """

    deterministic = False

    def __init__(
        self, nuisances: Nuisances | None = None, *, width: int = 320, height: int = 240
    ) -> None:
        self.nuisances = nuisances or Nuisances()
        self.eye = Eye()
        self.toys = toys = Choices(list(TOYS))
        policies = Choices([f"{action} {toy}" for action in ACTIONS for toy in TOYS])
        self.task = Task(policies, {"view": FEATURES, "toy": toys}, goal_spaces={"toy": toys})
        self._mujoco = mujoco("the toys are simulated")
        self._camera = Camera(self._mujoco, width, height)
        self._models: dict[str, Any] = {}
        self._standing: dict[str, FloatArray] = {}

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Manipulate a toy and look at it.

        Args:
            policy: Action and toy.
            context: There is none.
            rng: The trial's generator.
        """
        assert rng is not None
        action, _, toy = self.task.check_policy(policy).partition(" ")
        return self.seen(toy, self.moved(toy, action, rng), rng)

    def seen(self, toy: str, pose: FloatArray, rng: np.random.Generator) -> Outcome:
        """The outcome of looking at a toy."""
        return {"view": self.eye.look(self.picture(toy, pose, rng)).arrays, "toy": toy}

    def moved(self, toy: str, action: str, rng: np.random.Generator) -> FloatArray:
        """Where a toy comes to rest after an action: place in m and quaternion, shape ``(7,)``."""
        if action == "push":
            standing = self.presented(toy, rng.uniform(0, 2 * np.pi))
            angle, speed = rng.uniform(0, 2 * np.pi), rng.uniform(*_PUSH)
            push = speed * np.array([np.cos(angle), np.sin(angle)])
            tip = rng.uniform(0, _TIP) * np.array([-push[1], push[0]])
            spin = rng.uniform(-_SPIN, _SPIN)
            return self.settled(toy, standing, (*push, 0.0, *tip, spin))
        turn = rng.standard_normal(4)
        height = _DROP if action == "lift" else _HELD
        return self.settled(toy, (0.0, 0.0, height, *(turn / np.linalg.norm(turn))))

    def presented(self, toy: str, angle: float) -> FloatArray:
        """How a toy stands, or lies if it would not stand, with its front turned by an angle."""
        if toy not in self._standing:
            upright = (np.sqrt(0.5), -np.sqrt(0.5), 0, 0) if TOYS[toy].lies else (1, 0, 0, 0)
            self._standing[toy] = self.settled(toy, (0, 0, _HELD, *upright))
        pose, turned = self._standing[toy].copy(), np.empty(4)
        about = np.array([np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)])
        self._mujoco.mju_mulQuat(turned, about, pose[3:])
        pose[3:] = turned
        return pose

    def settled(self, toy: str, start: ArrayLike, velocity: ArrayLike = (0.0,) * 6) -> FloatArray:
        """Let a toy go, and wait until it lies.

        Args:
            toy: Its name.
            start: Place in m and quaternion, 7 numbers.
            velocity: In m/s and rad/s, 6 numbers.

        Returns:
            Place and quaternion, shape ``(7,)``; ``x`` and ``y`` are from where it started.
        """
        model, data = self._model(toy)
        self._mujoco.mj_resetData(model, data)
        data.qpos[:] = start
        data.qvel[:] = velocity
        for _ in range(round(_SETTLING_TIME / _TIME_STEP)):
            self._mujoco.mj_step(model, data)
        pose: FloatArray = data.qpos.copy()
        return pose

    def picture(self, toy: str, pose: FloatArray, rng: np.random.Generator) -> Picture:
        """Look at a toy as it lies, near the middle of the table, wherever it has come to rest."""
        model, data = self._model(toy)
        nuisances = self.nuisances
        zoom, shift = nuisances.draw_zoom(rng), rng.uniform(-1, 1, 2) * nuisances.shift
        data.qpos[:] = pose
        data.qpos[:2] = shift
        self._mujoco.mj_kinematics(model, data)
        return nuisances.spoil(self._camera.shoot(model, data, zoom), rng)

    def _model(self, toy: str) -> tuple[Any, Any]:
        if toy not in self._models:
            model = self._mujoco.MjModel.from_xml_string(toy_model(TOYS[toy]))
            self._models[toy] = (model, self._mujoco.MjData(model))
        found: tuple[Any, Any] = self._models[toy]
        return found
