"""A deterministic world made up for a task, for parts that must be checked without a real one."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from sgim.records import Outcome, Trial
from sgim.spaces import Box, FloatArray, Space
from sgim.streams import Streams
from sgim.task import Task


class MadeUpWorld:
    """Any policy, in any context, produces an outcome of every kind.

    Where policies and outcomes are boxes, outcomes depend smoothly on policies and contexts;
    elsewhere they are arbitrary, and the same for the same policy and context.

    Args:
        task: The task to make up a world for.
        streams: Random streams, of which the world and the trials are made.
    """

    def __init__(self, task: Task, streams: Streams) -> None:
        self.task = task
        self.streams = streams
        self.deterministic = True
        inputs = sum(_box_dimension(s) for s in (task.policy_space, task.context_space))
        rng = streams("testing/made up")
        self._maps = {
            kind: rng.standard_normal((space.dimension, inputs + 1))
            for kind, space in task.outcome_spaces.items()
            if isinstance(space, Box) and isinstance(task.policy_space, Box)
        }

    def execute(
        self, policy: Any, context: Any = None, rng: np.random.Generator | None = None
    ) -> Outcome:
        """What a policy produces in a context; the generator is not used."""
        outcome = {}
        for kind, space in self.task.outcome_spaces.items():
            if isinstance(space, Box) and kind in self._maps:
                angles = self._maps[kind] @ self._inputs(policy, context)
                outcome[kind] = space.decode(0.5 + 0.5 * np.sin(angles))
            else:
                outcome[kind] = space.sample(self._generator(policy, context))
        return outcome

    def trial(self, number: int) -> Trial:
        """One random trial; it produced some of the kinds, and sometimes none."""
        rng = self.streams("testing/trial", number)
        policy = self.task.policy_space.sample(rng)
        context = self.context(rng)
        outcome = self.execute(policy, context)
        produced = {k: v for i, (k, v) in enumerate(outcome.items()) if (number + i) % 3 != 2}
        return Trial(policy, produced, context)

    def context(self, rng: np.random.Generator) -> Any:
        """Draw a context; None where the task has none."""
        space = self.task.context_space
        return None if space is None else space.sample(rng)

    def _inputs(self, policy: Any, context: Any) -> FloatArray:
        parts = [np.ones(1), self.task.policy_space.encode(policy)]
        if isinstance(self.task.context_space, Box):
            parts.append(self.task.context_space.encode(context))
        return np.concatenate(parts)

    def _generator(self, policy: Any, context: Any) -> np.random.Generator:
        data = self.task.policy_space.pack(policy)
        if self.task.context_space is not None:
            data += self.task.context_space.pack(context)
        name = hashlib.blake2b(data, digest_size=16).hexdigest()
        return self.streams(f"testing/outcome/{name}")


def _box_dimension(space: Space | None) -> int:
    return space.dimension if isinstance(space, Box) else 0
