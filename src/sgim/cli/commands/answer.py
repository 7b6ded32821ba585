"""``sgim answer``: the policy for a goal."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any, Literal

from tyro.conf import Positional, arg

from sgim.cli.text import coordinates, example_goal, table
from sgim.errors import SgimError, unknown
from sgim.records import Solution
from sgim.runs.repertoire import open_repertoire
from sgim.spaces import Box, Space
from sgim.task import Task


def command(
    path: Annotated[Positional[Path], arg(metavar="PATH")],
    goal: Annotated[str, arg(metavar="KIND=POINT")],
    context: Annotated[
        str | None, arg(metavar="NUMBERS", help_behavior_hint="(default: none)")
    ] = None,
    by: Annotated[
        Literal["nearest", "reliable", "kernel", "local"] | None,
        arg(help_behavior_hint="(default: as the run's configuration says)"),
    ] = None,
    within: Annotated[
        float | None, arg(metavar="RADIUS", help_behavior_hint="(default: as near as was tried)")
    ] = None,
    as_json: Annotated[bool, arg(name="json")] = False,
) -> None:
    """Ask a run what it has learned: the policy for a goal, and what that should produce.

    Examples:
      sgim answer runs/throwing-sgim-acts-0.sgim --goal throw=6.5,2.0
      sgim answer runs/throwing-sgim-acts-0.sgim --goal place=-1.2 --json

    Args:
        path: The journal of the run, which may be going on.
        goal: A kind of outcome, and the point to reach: numbers with commas between, or a label.
        context: The context it is for, in worlds that have contexts.
        by: The way of answering: the nearest outcome remembered, the most reliable, the best by a
            kernel mean over like policies, or by a local model of them.
        within: How near counts as reached, as a share of the outcome space.
        as_json: Print JSON: kind, goal, policy, expected, spread, cost, reachable, radius,
            probability, and the names and units of coordinates.
    """
    learner = open_repertoire(path)
    task = learner.task
    kind, point = _parsed_goal(goal, task)
    repertoire = learner if by is None else learner.by(by)
    solution = repertoire.solve(kind, point, _parsed_context(context, task), radius=within)
    checked = task.check_goal(kind, point).point
    if as_json:
        facts = _as_json(task, kind, checked, solution)
        print(json.dumps(facts, indent=2, ensure_ascii=False, default=repr))
        return
    aimed, produced = task.goal_spaces[kind], task.outcome_spaces.get(kind)
    print(f"goal: {kind}\n{table(coordinates(aimed, checked))}\n")
    print(f"policy\n{table(coordinates(task.policy_space, solution.policy))}\n")
    if produced is not None:
        shown = coordinates(produced, solution.expected, solution.spread.tolist())
        print(f"should produce, ± its spread\n{table(shown)}\n")
    near = "seems within reach" if solution.reachable else "seems out of reach, or unexplored"
    print(f"The goal {near}: it is missed by {solution.cost:.3g} of the outcome space.")
    if solution.probability is not None:
        print(
            f"Within {solution.radius:.3g} of it: with a probability of {solution.probability:.2f}."
        )


def _as_json(task: Task, kind: str, point: Any, solution: Solution) -> dict[str, Any]:
    points = {
        "goal": (task.goal_spaces[kind], point),
        "policy": (task.policy_space, solution.policy),
        "expected": (task.outcome_spaces.get(kind), solution.expected),
    }
    boxes = {name: space for name, (space, _) in points.items() if isinstance(space, Box)}
    return {
        "kind": kind,
        **{name: value.tolist() if name in boxes else value for name, (_, value) in points.items()},
        "spread": solution.spread.tolist(),
        "cost": solution.cost,
        "reachable": bool(solution.reachable),
        "radius": solution.radius,
        "probability": solution.probability,
        "names": {name: list(box.names) for name, box in boxes.items()},
        "units": {name: list(box.units) for name, box in boxes.items()},
    }


def _parsed_goal(text: str, task: Task) -> tuple[str, Any]:
    kind, equals, point = text.partition("=")
    if not equals:
        raise SgimError(
            f"--goal {text!r} has no '='; write KIND=POINT, as in {example_goal(task.goal_spaces)}"
        )
    if kind not in task.goal_spaces:
        raise unknown("goal kind", kind, task.goal_spaces)
    return kind, _point(point, task.goal_spaces[kind], f"--goal {text}")


def _parsed_context(text: str | None, task: Task) -> Any:
    if text is None or task.context_space is None:
        return text
    return _point(text, task.context_space, f"--context {text}")


def _point(text: str, space: Space, what: str) -> Any:
    if not isinstance(space, Box):
        return text
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        names = ", ".join(
            f"{name} in {unit}" if unit else name
            for name, unit in zip(space.names, space.units, strict=True)
        )
        raise SgimError(f"{what}: expected numbers with commas between: {names}") from None
