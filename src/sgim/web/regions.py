"""The regions of a run's interest map, and what they promise: from the learner, or its journal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from sgim import algorithms
from sgim.errors import SgimError
from sgim.events import Closed, Opened
from sgim.learner import Learner
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.interest import EpisodeReport
from sgim.outcome.region_tree import RegionTree
from sgim.runs.journal import Journal
from sgim.runs.reasons import expectations
from sgim.task import Task
from sgim.web.protocol import Region

MOST_REGIONS = 400
AT_ONCE = 4000
"""Events folded at a look."""


def regions_of(learner: Learner) -> list[Region]:
    """The regions of a learner's interest map now; none if it has none that can be drawn.

    The learner may be at work in another thread: what is read is whole, if not of one moment.
    """
    interest = getattr(learner.strategy, "interest", None)
    if not isinstance(interest, ExpectedGain | RegionTree):
        return []
    promised = expectations(interest)
    leaves = list(interest.leaves)[: len(promised)]
    drawn = [leaf for leaf in leaves if interest.spaces[leaf.kind].dimension <= 2]
    if len(drawn) > MOST_REGIONS:
        order = np.argsort([-promised[leaf.leaf].max() for leaf in drawn], kind="stable")
        drawn = [drawn[i] for i in order[:MOST_REGIONS]]
    regions = []
    for leaf in drawn:
        box = interest.spaces[leaf.kind]
        low, high = (box.decode(c[: box.dimension]).tolist() for c in (leaf.low, leaf.high))
        value = float(promised[leaf.leaf].max())
        regions.append(Region(leaf.kind, low, high, value))
    return regions


class FoldedRegions:
    """The regions that a journal's episodes make, folded as they come.

    Args:
        path: The journal.
        task: Its task.
        recipe: How its learner is made.

    Raises:
        SgimError: If the recipe is not the library's.
    """

    def __init__(self, path: Path, task: Task, recipe: dict[str, object]) -> None:
        self._path = path
        self._task = task
        self._learner = algorithms.from_recipe(task, recipe)
        self._opened: dict[int, Opened] = {}
        self._after = 0

    def __call__(self) -> list[Region]:
        """The regions, as far as they have been folded."""
        strategy = self._learner.strategy
        with Journal.open(self._path, self._task, append=False) as journal:
            events = journal.entries(self._after, only=("opened", "closed"))
            for _, (row, event) in zip(range(AT_ONCE), events, strict=False):
                self._after = row
                if isinstance(event, Opened):
                    self._opened[event.episode] = event
                elif isinstance(event, Closed):
                    report = _report(self._opened.pop(event.episode, None), event)
                    if report is not None:
                        strategy.update(report)
        return regions_of(self._learner)


def folded(path: Path, task: Task, recipe: object) -> Callable[[], list[Region]] | None:
    """Regions from a journal; None if it does not say how its learner is made."""
    if not isinstance(recipe, dict):
        return None
    try:
        return FoldedRegions(path, task, recipe)
    except SgimError:
        return None


def _report(opened: Opened | None, closed: Closed) -> EpisodeReport | None:
    goal, before, after = closed.pursued, closed.before, closed.after
    if opened is None or goal is None or before is None or after is None or not closed.movements:
        return None
    return EpisodeReport(
        closed.episode,
        closed.mode,
        opened.goal or goal,
        goal,
        opened.context,
        before,
        after,
        closed.movements,
        None,
    )
