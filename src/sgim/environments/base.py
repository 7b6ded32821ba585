"""What a world must offer: execute a policy, say what it produced."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from sgim.records import Outcome
from sgim.spaces import FloatArray
from sgim.task import Task

Generators = Sequence[np.random.Generator]


class MinimalEnvironment(Protocol):
    """The least that a world needs; `execute_all` and `draw_context` make up for the rest.

    Attributes:
        task: The spaces of the world.
        deterministic: Whether outcomes depend on policy and context alone, so that no generator
            is used and None may be passed.
    """

    task: Task
    deterministic: bool

    def execute(self, policy: Any, context: Any, rng: np.random.Generator | None) -> Outcome:
        """Execute one policy.

        Args:
            policy: A point of the task's policy space.
            context: A point of the task's context space; None where it has none.
            rng: This trial's own generator; may be None in a deterministic world.

        Returns:
            Kind → point, for the kinds that were produced.
        """
        ...


class Environment(MinimalEnvironment, Protocol):
    """A complete world. A class that derives from it need only define `MinimalEnvironment`."""

    def execute_batch(
        self,
        policies: Sequence[Any],
        contexts: Sequence[Any] | None = None,
        rngs: Generators | None = None,
    ) -> list[Outcome]:
        """Execute several policies; bit for bit the outcomes that `execute` gives for each.

        Args:
            policies: The ``n`` policies.
            contexts: Their ``n`` contexts; None where the task has none.
            rngs: Their ``n`` generators; may be None in a deterministic world.
        """
        return _one_by_one(self, policies, contexts, rngs)

    def sample_context(self, rng: np.random.Generator) -> Any:
        """Draw the context of a trial; None where the task has none."""
        space = self.task.context_space
        return None if space is None else space.sample(rng)


def execute_all(
    environment: MinimalEnvironment,
    policies: Sequence[Any] | FloatArray,
    contexts: Sequence[Any] | FloatArray | None = None,
    rngs: Generators | None = None,
) -> list[Outcome]:
    """`Environment.execute_batch`, or `execute` one by one in a world that lacks it."""
    batch = getattr(environment, "execute_batch", None)
    if batch is None:
        return _one_by_one(environment, policies, contexts, rngs)
    outcomes: list[Outcome] = batch(policies, contexts, rngs)
    return outcomes


def draw_context(environment: MinimalEnvironment, rng: np.random.Generator) -> Any:
    """`Environment.sample_context`, or a point of the context space in a world that lacks it."""
    sample = getattr(environment, "sample_context", None)
    if sample is not None:
        return sample(rng)
    space = environment.task.context_space
    return None if space is None else space.sample(rng)


def _one_by_one(
    environment: MinimalEnvironment,
    policies: Sequence[Any] | FloatArray,
    contexts: Sequence[Any] | FloatArray | None,
    rngs: Generators | None,
) -> list[Outcome]:
    n = len(policies)
    each_context = [None] * n if contexts is None else contexts
    each_rng = [None] * n if rngs is None else rngs
    trials = zip(policies, each_context, each_rng, strict=True)
    return [environment.execute(policy, context, rng) for policy, context, rng in trials]
