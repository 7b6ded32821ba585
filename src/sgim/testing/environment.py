"""The suite for worlds."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.environments.base import MinimalEnvironment, draw_context
from sgim.records import Outcome
from sgim.streams import Streams
from sgim.task import Task
from sgim.testing.promises import Packed, packed_outcome, packed_point, require, succeeds
from sgim.testing.space import check_point


def check_environment(environment: MinimalEnvironment, *, trials: int = 20, seed: int = 0) -> None:
    """Check that a world keeps the promises of `sgim.environments.MinimalEnvironment`.

    Every policy is executed three times or more: choose few trials where they are dear.

    Args:
        environment: The world; ``execute_batch`` and ``sample_context`` are checked if it has
            them.
        trials: How many policies to draw.
        seed: Of policies, contexts and the trials' generators.

    Raises:
        AssertionError: If a promise is broken.
    """
    require(
        isinstance(getattr(environment, "task", None), Task),
        "an environment has a task, a sgim.Task",
        f"its task is {getattr(environment, 'task', None)!r:.80}",
        "Set self.task = Task(policy_space, {kind: outcome_space})",
    )
    require(
        isinstance(getattr(environment, "deterministic", None), bool),
        "an environment says whether it is deterministic",
        f"its attribute deterministic is {getattr(environment, 'deterministic', None)!r:.80}",
        "Set self.deterministic to True or False",
    )
    _Check(environment, trials, Streams(seed)).run()


class _Check:
    def __init__(self, environment: MinimalEnvironment, trials: int, streams: Streams) -> None:
        self.environment = environment
        self.task = environment.task
        self.streams = streams
        numbers = range(trials)
        self.policies = [
            self.task.policy_space.sample(streams("testing/policy", i)) for i in numbers
        ]
        self.contexts = [self._context(i) for i in numbers]

    def _context(self, number: int) -> Any:
        context = draw_context(self.environment, self.streams("testing/context", number))
        space = self.task.context_space
        if space is None:
            require(
                context is None,
                "sample_context gives None where the task has no context space",
                f"{context!r:.80} came",
                "Give the task context_space=…, or return None",
            )
            return None
        check_point(space, context, "a sampled context")
        require(
            space.contains(context),
            "sampled contexts lie within the task's context space",
            f"{context!r:.80} came",
            "Widen the context space, or sample within it",
        )
        return context

    def run(self) -> None:
        for policy in self.policies:
            check_point(self.task.policy_space, policy, "a sampled policy")
        numbers = range(len(self.policies))
        raw, first = [], []
        for i in numbers:
            raw.append(self._execute(i, seeded=not self.environment.deterministic))
            first.append(self._packed(raw[i]))
        for i in numbers:
            require(
                self._packed(raw[i]) == first[i],
                "an outcome stays as it was when it was returned",
                f"that of policy {self.policies[i]!r:.80} changed during later trials",
                "Return a copy, not a buffer that the next trial writes to",
            )
        # In another order, so that what a trial leaves behind for the next one shows.
        for i in self.streams("testing/order").permutation(len(numbers)).tolist():
            again = self._packed(self._execute(i, seeded=True))
            self._same(i, first[i], again, "executed once more")
        if hasattr(self.environment, "execute_batch"):
            self._check_batch(first)

    def _generator(self, number: int) -> np.random.Generator:
        return self.streams("testing/trial", number)

    def _execute(self, number: int, *, seeded: bool) -> Outcome:
        policy, context = self.policies[number], self.contexts[number]
        before = self._inputs(number)
        advice = "Make it accept every policy of the policy space, and every context"
        if not seeded:
            advice += "; a deterministic world must also accept rng=None"
        with succeeds(f"execute carries out a policy of its space, {policy!r:.80}", advice):
            outcome = self.environment.execute(
                policy, context, self._generator(number) if seeded else None
            )
        require(
            self._inputs(number) == before,
            "execute leaves the policy and the context given to it as they are",
            f"it changed {policy!r:.80} or {context!r:.80}",
            "Work on a copy: np.array(policy)",
        )
        return outcome

    def _inputs(self, number: int) -> Packed:
        task = self.task
        return (
            packed_point(task.policy_space, self.policies[number]),
            packed_point(task.context_space, self.contexts[number]),
        )

    def _packed(self, outcome: Any) -> Packed:
        with succeeds(
            "an outcome fits the task's outcome spaces",
            "Return {kind: point}, without the kinds that were not produced",
        ):
            checked = self.task.check_outcome(outcome)
        for kind, point in checked.items():
            check_point(self.task.outcome_spaces[kind], point, f"an outcome {kind!r}")
        return packed_outcome(self.task, checked)

    def _check_batch(self, first: list[Packed]) -> None:
        environment: Any = self.environment
        contexts = None if self.task.context_space is None else self.contexts
        rngs = [self._generator(i) for i in range(len(first))]
        before = [self._inputs(i) for i in range(len(first))]
        for given in [None, rngs] if environment.deterministic else [rngs]:
            with succeeds("execute_batch executes several policies", "Compare it with execute"):
                outcomes = list(environment.execute_batch(self.policies, contexts, given))
            require(
                len(outcomes) == len(first),
                f"execute_batch gives an outcome for each of {len(first)} policies",
                f"{len(outcomes)} came",
                "Return one outcome a policy, in order",
            )
            for i, outcome in enumerate(outcomes):
                self._same(i, first[i], self._packed(outcome), "executed in a batch")
        require(
            [self._inputs(i) for i in range(len(first))] == before,
            "execute_batch leaves policies and contexts as they are",
            "it changed one",
            "Work on copies",
        )

    def _same(self, number: int, first: Packed, again: Packed, how: str) -> None:
        if self.environment.deterministic:
            promise = "in a deterministic world a policy has the same outcome, to the last bit"
            advice = "Set deterministic = False if there is noise; else remove state between trials"
        else:
            promise = "the same generator gives the same outcome, to the last bit"
            advice = "Draw all noise from the trial's rng, and keep no state between trials"
        kinds = [
            f"{kind!r}: {self.task.outcome_spaces[kind].unpack(data)!r:.80}"
            for outcome in (first, again)
            for kind, data in outcome
        ]
        came = f"policy {self.policies[number]!r:.80} {how} gave another: {'; '.join(kinds)}"
        require(first == again, promise, came, advice)
