"""Any Gymnasium environment as a world of trials (``pip install 'sgim[gymnasium]'``)."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from sgim.environments.base import Environment
from sgim.errors import SgimError
from sgim.records import Outcome
from sgim.spaces import Space
from sgim.task import Task


def gymnasium() -> Any:
    """The module ``gymnasium``.

    Raises:
        SgimError: If it is not installed.
    """
    try:
        return importlib.import_module("gymnasium")
    except ImportError as error:
        raise SgimError(
            "this world needs Gymnasium; install it with: pip install 'sgim[gymnasium]'"
        ) from error


Controller = Callable[[Any], Any]
"""What one movement does: observation before a step → action, or None to end the movement."""


class Movement(Protocol):
    """A movement primitive: makes policies into actions, with or without feedback.

    Attributes:
        policy_space: The space of policies.
    """

    policy_space: Space

    def begin(self, policy: Any) -> Controller:
        """The controller of one movement.

        Args:
            policy: A point of the policy space.
        """
        ...


@dataclass(frozen=True)
class Rollout:
    """What happened in one movement.

    Attributes:
        observations: The first one, then one a step: ``n + 1`` of them.
        actions: The ``n`` actions.
        rewards: The ``n`` rewards.
        terminated: Whether the environment reached an end of its own.
        info: What the environment said at the last step (or at its reset).
    """

    observations: Sequence[Any]
    actions: Sequence[Any]
    rewards: Sequence[float]
    terminated: bool
    info: Mapping[str, Any]


class GymnasiumWorld(Environment):
    """A world that executes policies as episodes of a Gymnasium environment.

    A movement ends when the primitive ends it, or the environment terminates or truncates it. Each
    trial resets the environment with a seed drawn from the trial's generator, so a trial that is
    repeated on resume comes out as it did.

    Args:
        make: A name that Gymnasium knows, such as ``"Acrobot-v1"``, or a function without
            arguments that makes an environment.
        movement: The movement primitive.
        outcome_spaces: Kind → space of outcomes.
        outcomes: What a rollout produced: kind → point; a kind that it lacks was not produced.
        options: Passed to each reset.
        deterministic: Whether the environment draws nothing at random; it is then reset with
            seed 0 and no generator is used.

    Attributes:
        task: Spaces of the primitive's policies and of the outcomes.

    Raises:
        SgimError: If Gymnasium is not installed and ``make`` is a name, or it knows no such name.
    """

    def __init__(
        self,
        make: str | Callable[[], Any],
        movement: Movement,
        outcome_spaces: Mapping[str, Space],
        outcomes: Callable[[Rollout], Outcome],
        *,
        options: Mapping[str, Any] | None = None,
        deterministic: bool = False,
    ) -> None:
        self._gym = _made(make) if isinstance(make, str) else make()
        self._movement = movement
        self._outcomes = outcomes
        self._options = None if options is None else dict(options)
        self.deterministic = deterministic
        self.task = Task(movement.policy_space, outcome_spaces)

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """Execute one policy as an episode.

        Raises:
            SgimError: If the environment is not deterministic and no generator came.
        """
        return self._outcomes(self.rollout(policy, rng))

    def rollout(self, policy: Any, rng: np.random.Generator | None = None) -> Rollout:
        """The episode that a policy makes; arguments and errors as in `execute`."""
        if rng is None and not self.deterministic:
            raise SgimError("this environment draws at random: pass the trial's generator")
        seed = 0 if self.deterministic or rng is None else int(rng.integers(2**31))
        observation, info = self._gym.reset(seed=seed, options=self._options)
        controller = self._movement.begin(policy)
        observations, actions, rewards = [_copied(observation)], list[Any](), list[float]()
        terminated = truncated = False
        while not (terminated or truncated):
            action = controller(observation)
            if action is None:
                break
            observation, reward, terminated, truncated, info = self._gym.step(action)
            observations.append(_copied(observation))
            actions.append(action)
            rewards.append(float(reward))
        return Rollout(observations, actions, rewards, bool(terminated), info)


def _made(name: str) -> Any:
    module = gymnasium()
    try:
        return module.make(name)
    except module.error.Error as error:
        raise SgimError(f"Gymnasium makes no environment {name!r}: {error}") from error


def _copied(observation: Any) -> Any:
    """Environments may write into the same array at each step."""
    return observation.copy() if isinstance(observation, np.ndarray) else observation
