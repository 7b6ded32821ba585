"""The suite for competence models and inverse models."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from sgim.policy.competence import CompetenceModel, InverseModel, NoAnswerError
from sgim.records import Goal
from sgim.spaces import Box
from sgim.streams import Streams
from sgim.task import Task
from sgim.testing.inverse_model import check_answers
from sgim.testing.made_up import MadeUpWorld
from sgim.testing.promises import require, succeeds

_TRIALS = 60
_GOALS = 6


def check_model(make_model: Callable[[], CompetenceModel], task: Task, *, seed: int = 0) -> None:
    """Check that a model keeps the promises of `sgim.policy.model`.

    The model learns from trials of a deterministic world that is made up for the task. If it
    answers with policies, its answers are checked too: for an outcome that it remembers it must
    give a policy that reproduces it, within the task's tolerance.

    Args:
        make_model: Makes a fresh model; called several times.
        task: The task.
        seed: Of the made-up world, the trials and the goals.

    Raises:
        AssertionError: If a promise is broken.
    """
    world = MadeUpWorld(task, Streams(seed))
    trials = [world.trial(number) for number in range(_TRIALS)]
    with succeeds("make_model makes a fresh model", "Pass a function without arguments"):
        model, twin = make_model(), make_model()
    goals = _goals(world)
    for goal, context in goals:
        _check_competence(model, goal, context, "before any trial")
        if isinstance(model, InverseModel) and goal.kind in task.outcome_spaces:
            _check_ignorance(model, goal, context)
    for number, trial in enumerate(trials):
        for one in (model, twin):
            with succeeds("update learns from any trial", "Also from one that produced nothing"):
                one.update(trial)
        goal, context = goals[number % len(goals)]
        with succeeds("shown_by takes any trial and goal", "Return None if it cannot tell"):
            shown = model.shown_by(trial, goal, context)
        require(
            shown is None or np.isfinite(shown),
            "the competence that one trial shows is a finite number, or None",
            f"{shown!r} came for {goal!r:.80}",
            "Give the least competence for trials that do not produce the goal's kind",
        )
    for goal, context in goals:
        competence = _check_competence(model, goal, context, f"after {_TRIALS} trials")
        require(
            competence == _check_competence(twin, goal, context, f"after {_TRIALS} trials"),
            "two models that learned the same trials are equally competent, to the last bit",
            f"they differ for {goal!r:.80}",
            "Let the model depend on its trials only: a journal restores it from them",
        )
    if isinstance(model, InverseModel) and isinstance(twin, InverseModel):
        check_answers(model, twin, world, trials, goals)


def _goals(world: MadeUpWorld) -> list[tuple[Goal, Any]]:
    """Goals of every kind: within the space, and outside it, as a demonstration may be."""
    goals = []
    for kind, space in world.task.goal_spaces.items():
        for number in range(_GOALS):
            rng = world.streams(f"testing/goal/{kind}", number)
            point = space.sample(rng)
            if number == 0 and isinstance(space, Box):
                point = space.high + 0.1 * space.range
            goals.append((Goal(kind, point), world.context(rng)))
    return goals


def _check_competence(model: CompetenceModel, goal: Goal, context: Any, when: str) -> float:
    with succeeds(
        f"competence is known for any goal {when}", "Give the least competence if nothing is known"
    ):
        values = [model.competence(goal, context) for _ in range(2)]
    require(
        bool(np.isfinite(values).all()) and values[0] == values[1],
        f"competence {when} is a finite number, the same if asked twice",
        f"{values} came for {goal!r:.80}",
        "Give the least competence if nothing is known, and learn in update only",
    )
    return values[0]


def _check_ignorance(model: InverseModel, goal: Goal, context: Any) -> None:
    came = "an answer"
    try:
        came = f"{model.best_policy(goal, context)!r:.80}"
    except NoAnswerError:
        came = ""
    except Exception as error:
        came = f"{type(error).__name__}: {error}"
    require(
        not came,
        "best_policy raises NoAnswerError before anything was learned",
        f"{came} came",
        "Raise sgim.policy.model.NoAnswerError",
    )
    with succeeds("best_policies works before anything was learned", "Return None for each goal"):
        answers = list(model.best_policies([goal], [context]))
    require(
        len(answers) == 1 and answers[0] is None,
        "best_policies gives None where nothing is known",
        f"{answers!r:.80} came",
        "Return a list with None for each goal",
    )
