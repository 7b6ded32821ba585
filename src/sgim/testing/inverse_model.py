"""The part of the suite for models that is about answers: policies for goals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sgim.policy.competence import InverseModel
from sgim.records import Goal, Solution, Trial
from sgim.spaces import Space
from sgim.task import Task
from sgim.testing.made_up import MadeUpWorld
from sgim.testing.promises import require, succeeds

_ROUNDING = 1e-9


def check_answers(
    model: InverseModel,
    twin: InverseModel,
    world: MadeUpWorld,
    trials: Sequence[Trial],
    goals: Sequence[tuple[Goal, Any]],
) -> None:
    """Check the answers of two models that learned the same trials of a made-up world.

    Args:
        model: The model.
        twin: Another, which learned the same.
        world: The world.
        trials: What they learned.
        goals: Goals of every kind, each with a context.

    Raises:
        AssertionError: If a promise is broken.
    """
    task = world.task
    for kind, space in task.outcome_spaces.items():
        if kind not in task.goal_spaces:
            continue
        remembered = [t for t in trials if kind in t.outcome]
        asked = [(g, c) for g, c in goals if g.kind == kind]
        asked += [(Goal(kind, t.outcome[kind]), t.context) for t in remembered[:10]]
        policies = [_best_policy(model, task, g, c) for g, c in asked]
        for (goal, context), policy in zip(asked, policies, strict=True):
            same = _pack(task, _best_policy(twin, task, goal, context)) == _pack(task, policy)
            require(
                same,
                "two models that learned the same trials give the same policy, to the last bit",
                f"they differ for {goal!r:.80}",
                "Let the answer depend on the trials and the goal only",
            )
            _check_solution(model, task, goal, context, policy)
        _check_batch(model, task, asked, policies)
        for trial in remembered[:10] if space.dimension is not None else []:
            _check_reproduction(model, world, kind, trial)


def _pack(task: Task, policy: Any) -> bytes:
    return task.policy_space.pack(policy)


def _best_policy(model: InverseModel, task: Task, goal: Goal, context: Any) -> Any:
    with succeeds(
        f"best_policy answers for {goal!r:.80} within the policy space",
        "Once the goal's kind was produced, give a policy, clipped to the bounds",
    ):
        policy = model.best_policy(goal, context)
        task.check_policy(policy)
    return policy


def _check_batch(
    model: InverseModel, task: Task, asked: Sequence[tuple[Goal, Any]], policies: Sequence[Any]
) -> None:
    with succeeds("best_policies answers for many goals at once", "Compare it with best_policy"):
        many = list(model.best_policies([g for g, _ in asked], [c for _, c in asked]))
    require(
        len(many) == len(policies),
        "best_policies gives one policy a goal",
        f"{len(many)} came for {len(policies)} goals",
        "Return a list as long as the goals",
    )
    for (goal, _), one, other in zip(asked, policies, many, strict=True):
        require(
            other is not None and _pack(task, one) == _pack(task, other),
            "best_policies gives what best_policy gives, to the last bit",
            f"for {goal!r:.80} it gave {other!r:.80} instead of {one!r:.80}",
            "Use operations whose rounding does not depend on the number of goals",
        )


def _check_solution(model: InverseModel, task: Task, goal: Goal, context: Any, policy: Any) -> None:
    space = task.outcome_spaces[goal.kind]
    with succeeds(f"solve answers for {goal!r:.80}", "Answer wherever best_policy does"):
        solution = model.solve(goal, context)
        space.check(solution.expected, "the expected outcome")
    require(
        isinstance(solution, Solution) and _pack(task, solution.policy) == _pack(task, policy),
        "solve gives the policy that best_policy gives",
        f"{solution!r:.120} came instead of {policy!r:.80}",
        "Call best_policy in solve",
    )
    require(
        0.0 <= solution.cost <= 1.0,
        "the cost of a solution lies in [0, 1]",
        f"it is {solution.cost!r}",
        "Clip the scaled distance at 1",
    )
    if space.dimension is None:
        return
    distance = min(1.0, _distance(space, solution.expected, goal.point))
    # The memory of another context costs more than its outcome's distance.
    exact = task.context_space is None
    gap = solution.cost - distance
    require(
        abs(gap) <= _ROUNDING if exact else gap >= -_ROUNDING,
        "the cost of a solution is the scaled distance from its expected outcome to the goal, "
        "to which a difference of contexts may add",
        f"the cost is {solution.cost:g} and the distance {distance:g}",
        "Compute the cost from the expected outcome, in the unit box",
    )
    spread = np.asarray(solution.spread)
    require(
        spread.shape == (space.dimension,) and np.isfinite(spread).all() and (spread >= 0).all(),
        f"the spread is {space.dimension} finite numbers, none negative",
        f"{spread!r:.80} came",
        "Give a standard deviation for each coordinate of the outcome",
    )


def _check_reproduction(model: InverseModel, world: MadeUpWorld, kind: str, trial: Trial) -> None:
    space, wanted = world.task.outcome_spaces[kind], trial.outcome[kind]
    policy = _best_policy(model, world.task, Goal(kind, wanted), trial.context)
    came = world.execute(world.task.check_policy(policy), trial.context)[kind]
    distance, tolerance = _distance(space, came, wanted), world.task.tolerances[kind]
    require(
        distance <= tolerance,
        "in a deterministic world, the best policy for a remembered outcome reproduces it "
        f"within the tolerance {tolerance:g}",
        f"{wanted!r:.80} was remembered and {came!r:.80} came, {distance:g} away",
        "Answer no worse than the nearest remembered trial",
    )


def _distance(space: Space, one: Any, other: Any) -> float:
    return float(np.linalg.norm(space.encode(one) - space.encode(other)))
