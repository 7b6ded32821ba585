"""Telling a learner at once what came of its plans."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile
from typing import cast

from sgim.errors import JournalError, SgimError
from sgim.learner import Learner
from sgim.records import Outcome, Plan
from sgim.runs.world import Executed, World


def tell_together(learner: Learner, executed: Sequence[tuple[Plan, Executed]]) -> list[Outcome]:
    """Tell a learner what came of plans, all those before the first that failed.

    Returns:
        The outcomes that it was told of: none if there are fewer than two, or if one is
        malformed; which one, telling them one by one shows.
    """
    good = takewhile(lambda pair: not isinstance(pair[1], Exception), executed)
    told = [(plan, cast(Outcome, outcome)) for plan, outcome in good]
    outcomes = [outcome for _, outcome in told]
    if len(told) < 2:
        return []
    try:
        learner.tell_batch([plan for plan, _ in told], outcomes)
    except JournalError:
        raise
    except SgimError:
        if told[0][0].id not in learner.ledger.plans:  # it is no outcome that was refused
            raise
        return []
    return outcomes


def answer_together(learner: Learner, plans: Sequence[Plan], world: World) -> bool:
    """Let the teachers answer requests, and give the learner their answers at once.

    Returns:
        Whether that went well. If not, nothing was answered: to ask one by one shows who failed.
    """
    try:
        shown = [world.demonstration(plan) for plan in plans]
        learner.answer_batch(plans, shown)
    except JournalError:
        raise
    except Exception:
        if plans[0].id not in learner.ledger.plans:
            raise
        return False
    return True
