"""Bookkeeping of a learner: which episodes are open, and which plans are out."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from typing import Any

from sgim.errors import PlanError
from sgim.policy.explorer import Episode
from sgim.records import Goal, Outcome, Plan, Request
from sgim.strategy.modes import Mode

OUT, TOLD, ANSWERED, FAILED, REFUSED, EXPIRED, LOST = range(1, 8)
_SAID = {
    TOLD: "was already told",
    ANSWERED: "was already answered",
    FAILED: "has failed",
    REFUSED: "was refused",
    EXPIRED: "has expired",
    LOST: "was given up as lost",
}


class Running:
    """An open episode.

    Attributes:
        mode: Its sampling mode.
        chosen: The goal chosen for it, or None.
        context: The context it was chosen in, or None.
        episode: Its place in the explorer's world.
        limit: Most movements in it, if fewer than its mode usually has.
        live: Whether its explorer has been prepared; false where decisions are only folded.
    """

    __slots__ = ("chosen", "context", "episode", "limit", "live", "mode")

    def __init__(
        self,
        mode: Mode,
        chosen: Goal | None,
        context: Any,
        episode: Episode,
        live: bool,
        limit: int | None = None,
    ) -> None:
        self.mode = mode
        self.chosen = chosen
        self.context = context
        self.episode = episode
        self.live = live
        self.limit = limit

    @property
    def budget(self) -> int:
        """Most movements in it."""
        usual = self.mode.budget
        return usual if self.limit is None else min(self.limit, usual)

    @property
    def watched(self) -> Outcome | None:
        """What was shown, if that is to be remembered without a movement."""
        shown = self.episode.demonstration
        return shown.outcome if shown is not None and self.mode.uses == "both" else None

    @property
    def must_ask(self) -> bool:
        """Whether it needs a demonstration that it does not have."""
        return self.mode.teacher is not None and self.episode.demonstration is None


class Ledger:
    """Open episodes, plans that are out, and the numbers of the next ones."""

    def __init__(self) -> None:
        self.owner = object()
        self.running: dict[int, Running] = {}
        self.plans: dict[int, tuple[Plan, Running]] = {}
        self.next_plan = 0
        self.next_episode = 0
        self.next_request = 0
        self._idle: list[int] = []
        self._status = bytearray()

    def oldest_idle(self) -> Running | None:
        """Take the oldest open episode that waits for nothing; None if there is none."""
        return self.running[heapq.heappop(self._idle)] if self._idle else None

    def waits(self, running: Running) -> bool:
        """Whether the episode is neither idle nor has a plan out, so that a plan is due."""
        out = any(entry is running for _, entry in self.plans.values())
        return not out and running.episode.id not in self._idle

    def take(self, running: Running) -> None:
        """Note that the episode, idle or not, is about to have a plan out."""
        if running.episode.id in self._idle:
            self._idle.remove(running.episode.id)
            heapq.heapify(self._idle)

    def make_idle(self, running: Running) -> None:
        """Note that the episode waits for nothing."""
        heapq.heappush(self._idle, running.episode.id)

    def give_out(self, running: Running, policy: Any, teacher: str | None) -> Plan:
        """Make the next plan of an episode: a policy, or a request to ``teacher``."""
        episode, number = running.episode, self.next_plan
        request = None
        if teacher is not None:
            request = Request(teacher, running.chosen, self.next_request)
            self.next_request += 1
        plan = Plan(
            number,
            episode.id,
            running.mode.name,
            episode.goal,
            policy,
            request,
            episode.context,
            self.owner,
            running.watched,
        )
        self.next_plan = number + 1
        self._status.append(OUT)
        self.plans[number] = (plan, running)
        return plan

    def out(self, plan: Plan, *, request: bool | None = None) -> Running:
        """The episode of a plan that is out.

        Args:
            plan: The plan.
            request: Whether it must hold a request, or must not; None for either.

        Raises:
            PlanError: If it is not a plan of this learner, is not out, or is of the other sort.
        """
        if not isinstance(plan, Plan):
            raise PlanError(f"expected a Plan that this learner gave, got {type(plan).__name__}")
        if plan.owner is not self.owner:
            raise PlanError(f"plan {plan.id} is of another learner")
        entry = self.plans.get(plan.id)
        if entry is None:
            raise PlanError(f"plan {plan.id} {_SAID[self._status[plan.id]]}")
        if request is not None and request != (plan.request is not None):
            raise PlanError(
                f"plan {plan.id} is a request to {plan.request.teacher!r}: use answer(plan, "
                "demonstration), or answer(plan, None) if there is none"
                if plan.request is not None
                else f"plan {plan.id} holds a policy, not a request: use tell(plan, outcome)"
            )
        return entry[1]

    def all_out(
        self, plans: Sequence[Plan], told: Sequence[Any], *, request: bool
    ) -> list[Running]:
        """The episodes of different plans that are all out.

        Args:
            plans: The plans.
            told: What came of each.
            request: Whether they must hold requests, or must not.

        Raises:
            PlanError: As `out`, and if a plan comes twice.
            ValueError: If there is not one of ``told`` for each plan.
        """
        if len(told) != len(plans):
            raise ValueError(f"{len(plans)} plans came with {len(told)} answers or outcomes")
        some = [self.out(plan, request=request) for plan in plans]
        if len(plans) > 1 and len({plan.id for plan in plans}) < len(plans):
            raise PlanError("a plan comes twice in one batch; each is told once")
        return some

    def resolve(self, plan: Plan, status: int) -> None:
        """Note that a plan is no longer out, and why."""
        del self.plans[plan.id]
        self._status[plan.id] = status
