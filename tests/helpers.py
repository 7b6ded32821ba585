"""Tiny worlds and records that tests share."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from sgim.memory import Memory
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.progress import Record
from sgim.policy.explorer import Episode
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.spaces import Box, FloatArray
from sgim.task import Task

World = Callable[[FloatArray], Mapping[str, Any]]

PLANE = Task(Box(0, 1, names=["a", "b"]), {"place": Box([0, 0], [10, 10], unit="m")})
"""Two policy parameters in the unit box, and places in a square of 10 m."""


def plane(policy: FloatArray) -> dict[str, FloatArray]:
    """A linear world for `PLANE`: place = 10 · (0.2 a + 0.6 b + 0.1, 0.8 a − 0.3 b + 0.4)."""
    a, b = policy
    return {"place": 10 * np.array([0.2 * a + 0.6 * b + 0.1, 0.8 * a - 0.3 * b + 0.4])}


def remember(task: Task, world: World, policies: Sequence[Any] | FloatArray) -> NearestModel:
    """A model that has seen what these policies produce."""
    model = NearestModel(Memory(task))
    for policy in policies:
        point = task.check_policy(policy)
        model.update(Trial(point, world(point)))
    return model


def random_policies(task: Task, count: int, seed: int = 0) -> list[Any]:
    """Policies drawn from the policy space."""
    rng = np.random.default_rng(seed)
    return [task.policy_space.sample(rng) for _ in range(count)]


def episode_for(model: NearestModel, goal: Goal, context: Any = None, seed: int = 0) -> Episode:
    """An episode that pursues a goal, from what the model knows now."""
    episode = Episode(0, goal, context, np.random.default_rng(seed))
    episode.before = episode.best = model.competence(goal, context)
    return episode


def tell(model: NearestModel, explorer: Any, episode: Episode, trial: Trial) -> float:
    """Tell a trial to model, episode and explorer, as the learner does; the competence shown."""
    assert episode.goal is not None
    assert episode.best is not None
    model.update(trial)
    shown = model.shown_by(trial, episode.goal, episode.context)
    episode.movements += 1
    episode.attempts += 1
    episode.best = max(episode.best, shown)
    explorer.learn(episode, trial, shown)
    return shown


def report(
    point: Any,
    mode: str = "alone",
    *,
    kind: str = "place",
    pursued: Goal | None = None,
    context: Any = None,
    before: float = -1.0,
    after: float = -1.0,
    movements: int = 1,
    episode: int = 0,
) -> EpisodeReport:
    """The report of an episode whose goal was chosen at ``point``."""
    chosen = Goal(kind, np.asarray(point, dtype=float) if not isinstance(point, str) else point)
    return EpisodeReport(
        episode, mode, chosen, pursued or chosen, context, before, after, movements
    )


class PlainProgress:
    """Progress is the competence gained; interest is its mean: easy to reckon by hand.

    Args:
        window: How many of the newest records count.
    """

    def __init__(self, window: int = 1000) -> None:
        self.window = window

    def progress(self, report: EpisodeReport) -> float:
        """The competence gained."""
        return report.after - report.before

    def interest(self, records: Sequence[Record]) -> float:
        """The mean progress of the newest records."""
        newest = records[-self.window :]
        return sum(r.progress for r in newest) / len(newest) if newest else 0.0


def proposals(
    search: Any,
    goal: Goal,
    context: np.ndarray | None = None,
    count: int = 8,
    seed: int = 0,
) -> list[np.ndarray]:
    """What is proposed again and again while nothing is told: steps of every sort."""
    episode = episode_for(search.model, goal, context, seed)
    search.begin(episode)
    return [search.propose([episode])[0] for _ in range(count)]
