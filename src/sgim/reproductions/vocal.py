"""Vocal development (section 5.3), made again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sgim.claims.vocal import ALONE, AMID, VOCAL
from sgim.experiments.sweep_plan import Part
from sgim.experiments.vocal_history import with_history
from sgim.figures import vocal_classes
from sgim.figures.vocal_strategies import vocal_strategies
from sgim.reproductions.declaration import Drawing, Quick, Reproduction
from sgim.reproductions.drawings import choices_over_time, errors
from sgim.runs.summary import RecordedRun

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LEARNERS = tuple(VOCAL.learners)
CONFIGURATIONS = ("modern", "thesis")


def _classes(runs: Sequence[RecordedRun], /) -> Figure:
    return vocal_classes([with_history(run) for run in runs])


def _strategies(runs: Sequence[RecordedRun], /) -> Figure:
    return vocal_strategies([with_history(run) for run in runs])


REPRODUCTION = Reproduction(
    name="vocal",
    title="Vocal development",
    source="thesis, section 5.3",
    summary=(
        "An articulatory synthesiser is moved by motor commands, and what it sounds like is the "
        "outcome. Learners explore alone, with or without regard to their progress, or amid one "
        "of three ambient languages, whose sounds they may emulate."
    ),
    parts=(Part(("vocal",), LEARNERS, (), CONFIGURATIONS),),
    chapters=(VOCAL,),
    drawings=(
        errors("errors", "Errors over the sounds of the benchmark"),
        Drawing(
            "classes",
            "Classes of sounds over time, and stages",
            "Shares of sounds without phonation, unarticulated and articulated, over the "
            "vocalisations of each self-exploring run; lines part the stages found in it, which "
            "the table counts.",
            _classes,
            learners=(ALONE,),
        ),
        Drawing(
            "strategies",
            "Exploring alone and emulating",
            "Amid the first language: how often each is chosen, and how competence and its "
            "progress go, over vocalisations.",
            _strategies,
            learners=(AMID["1"],),
        ),
        choices_over_time("choices", "What is chosen over time", tuple(AMID.values())),
    ),
    quick=Quick(seeds=(0, 1), movements=8000),
)
