"""Figures that most reports have."""

from __future__ import annotations

from functools import partial

from sgim.figures import choices, choices_by_kind, error_curves, performance_profiles
from sgim.reproductions.declaration import Drawing

_COLUMNS = 3
"""Panels in a row, at most, so that a page's width shows them at a size that can be read."""


def errors(name: str, title: str, learners: tuple[str, ...] = ()) -> Drawing:
    """Learning curves of some learners."""
    caption = (
        "Error over the benchmark, by movements made: the interquartile mean of the runs, and its "
        "95 % bootstrap interval at each evaluation. Lower is better."
    )
    return Drawing(
        name, title, caption, partial(error_curves, columns=_COLUMNS), error_curves, learners
    )


def profiles(name: str, title: str, learners: tuple[str, ...] = ()) -> Drawing:
    """Performance profiles of some learners."""
    caption = (
        "Share of a learner's runs whose error at the end is at most what the axis below says, "
        "with its 95 % bootstrap interval. Farther left is better; a line that is nowhere below "
        "another is of the learner that is better throughout."
    )
    return Drawing(
        name,
        title,
        caption,
        partial(performance_profiles, columns=_COLUMNS),
        performance_profiles,
        learners,
    )


def choices_over_time(name: str, title: str, learners: tuple[str, ...]) -> Drawing:
    """What learners choose over time."""
    caption = (
        "Shares of the episodes begun, over movements, all runs together: how to learn, and what "
        "to aim at."
    )
    return Drawing(name, title, caption, choices, choices, learners)


def strategies(name: str, title: str, learners: tuple[str, ...]) -> Drawing:
    """Which mode learners choose for which kind of goal."""
    caption = (
        "Shares of the modes among episodes whose goal is of each kind, over movements, and of "
        "modes and kinds together over the whole of the runs."
    )
    return Drawing(name, title, caption, choices_by_kind, choices_by_kind, learners)
