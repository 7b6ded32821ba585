"""Why a learner asks: what it lacks, what it expects of an answer, and what it would do instead."""

from __future__ import annotations

from typing import Any

from sgim.learner import Learner
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.region_tree import RegionTree
from sgim.policy.competence import NoAnswerError
from sgim.records import Goal, Plan
from sgim.runs.letters import plain
from sgim.spaces import FloatArray


def reasons(learner: Learner, plan: Plan) -> dict[str, Any]:
    """The reasons for a request, JSON-compatible.

    Returns:
        ``mode``; ``goal``: kind and point, or None if the teacher is to choose; ``episode``;
        ``error``: what the goal is missed by now, as a share of its space; ``gain``: what is
        expected of a movement after an answer, and ``alone``: of one made by itself instead,
        both None where the learner has no opinion; ``replaces``: the name of what it would do
        instead; ``movements``: how many movements it makes of an answer.
    """
    strategy = learner.strategy
    mode = strategy.modes[plan.mode]
    goal = plan.request.goal if plan.request is not None else None
    facts: dict[str, Any] = {
        "mode": mode.name,
        "goal": None if goal is None else {"kind": goal.kind, "point": plain(goal.point)},
        "episode": plan.episode,
        "error": None if goal is None else error_at(learner, goal, plan.context),
        "gain": None,
        "alone": None,
        "replaces": strategy.alone.name,
        "movements": mode.budget,
    }
    interest = getattr(strategy, "interest", None)
    if goal is not None and isinstance(interest, ExpectedGain | RegionTree):
        place = interest.place_of(goal, plan.context)
        if place is not None:
            row = expectations(interest)[interest.region_of(goal.kind, place).leaf]
            for fact, name in (("gain", mode.name), ("alone", strategy.alone.name)):
                if name in interest.modes:
                    facts[fact] = float(row[interest.modes[name]])
    return facts


def error_at(learner: Learner, goal: Goal, context: Any = None) -> float | None:
    """What a goal is missed by now, as a share of its space; None if nothing is known."""
    try:
        return -float(learner.model.competence(goal, context))
    except NoAnswerError:
        return None


def expectations(interest: ExpectedGain | RegionTree) -> FloatArray:
    """What every region and mode promises, shape ``(leaves, modes)``."""
    return interest.gains() if isinstance(interest, ExpectedGain) else interest.interests()
