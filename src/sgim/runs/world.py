"""The world of a run: environment and teachers, each trial and request with its own stream."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from sgim.environments.base import MinimalEnvironment, draw_context, execute_all
from sgim.errors import SgimError
from sgim.events import Told
from sgim.records import Demonstration, Outcome, Plan
from sgim.runs.journal import Journal
from sgim.streams import Streams
from sgim.teachers import Teacher, let_observe

Executed = Outcome | Exception
"""What a trial produced, or how the world broke."""


class World:
    """Carries out plans.

    Args:
        environment: Where policies are executed.
        teachers: Name → teacher.
        streams: Random streams ``context``, ``environment`` and ``teacher/NAME``, by the numbers
            of plans and requests.
        real: Whether a movement, once made, must not be made again.
    """

    def __init__(
        self,
        environment: MinimalEnvironment,
        teachers: Mapping[str, Teacher],
        streams: Streams,
        *,
        real: bool = False,
    ) -> None:
        self.environment = environment
        self.teachers = dict(teachers)
        self.watching = [t for t in teachers.values() if hasattr(t, "observe")]
        self.streams = streams
        self.real = real

    def contexts(self, first: int, n: int) -> list[Any]:
        """The contexts in which n plans will be made, the first of them number ``first``."""
        if self.environment.task.context_space is None:
            return [None] * n
        return [
            draw_context(self.environment, self.streams("context", first + i)) for i in range(n)
        ]

    def demonstration(self, plan: Plan) -> Demonstration | None:
        """What the teacher asked by this plan shows."""
        request = plan.request
        assert request is not None
        rng = self.streams(f"teacher/{request.teacher}", request.index)
        return self.teachers[request.teacher].demonstrate(request.goal, rng)

    def observed(self, outcomes: Iterable[Outcome]) -> None:
        """Let the teachers who watch see what movements produced."""
        if self.watching:
            for outcome in outcomes:
                for teacher in self.watching:
                    let_observe(teacher, outcome)

    def show_recorded(self, journal: Journal) -> None:
        """Let the teachers who watch see all that was recorded, as they did when it happened."""
        if self.watching:
            told = (event for event in journal.events(only=("told",)) if isinstance(event, Told))
            self.observed(event.outcome for event in told)

    def execute(self, plan: Plan) -> Executed:
        """Execute one plan's policy; what was only watched is not executed."""
        if plan.watched is not None:
            return plan.watched
        environment = self.environment
        rng = None if environment.deterministic else self.streams("environment", plan.id)
        try:
            return environment.execute(plan.policy, plan.context, rng)
        except Exception as error:
            return error

    def execute_all(self, plans: Sequence[Plan]) -> Sequence[Executed]:
        """Execute several plans' policies at once, if the world can.

        If that breaks, a simulated world is asked for them one by one; in a real one, nobody
        knows which movements were made, and all of them have failed.
        """
        environment = self.environment
        watching = any(plan.watched is not None for plan in plans)
        if len(plans) == 1 or watching or not hasattr(environment, "execute_batch"):
            return [self.execute(plan) for plan in plans]
        rngs = None
        if not environment.deterministic:
            rngs = [self.streams("environment", plan.id) for plan in plans]
        contexts = [p.context for p in plans] if environment.task.context_space else None
        try:
            outcomes = execute_all(environment, [p.policy for p in plans], contexts, rngs)
            if len(outcomes) != len(plans):
                raise SgimError(f"{len(plans)} policies gave {len(outcomes)} outcomes")
        except Exception as error:
            if self.real:
                return [error] * len(plans)
            return [self.execute(plan) for plan in plans]
        return outcomes
