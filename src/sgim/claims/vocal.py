"""The claims about vocal development (section 5.3), and the controls they need."""

from __future__ import annotations

from sgim.claims.claim import Chapter, Claim
from sgim.claims.components import equal, lower
from sgim.claims.vocal_measures import (
    Articulated,
    Distance,
    Emulated,
    EmulationGain,
    FirstArticulated,
    Mistaken,
    NoOrder,
    Reach,
)
from sgim.experiments.vocal_history import read_vocal_run

ALONE = "sagg-riac-gmm"
UNINTERESTED = "goal-babbling-gmm"
AMID = {language: f"sgim-acts-gmm:{language}" for language in ("1", "2", "3")}

CHANCE = 2 / 3
"""The share of sounds whose language of three is mistaken by whoever guesses."""

_ALL = tuple(AMID.values())

CLAIMS = (
    Claim(
        "V1",
        "Most self-exploring runs pass from no phonation and unarticulated sounds to unarticulated "
        "to articulated ones.",
        (lower(NoOrder(ALONE), 0.5),),
        reading="Stages by change points; all three must come in this order, and none go back.",
    ),
    Claim(
        "V1b",
        "More of them do than of runs whose goals ignore progress.",
        (lower(NoOrder(ALONE), NoOrder(UNINTERESTED)),),
        reading="The control of V1: the same learner, whose interest has the weights it is fitted "
        "with.",
    ),
    Claim(
        "V2",
        "The articulated share grows from the first to the last third, and earlier than without "
        "progress.",
        (
            lower(Articulated(ALONE, 1), Articulated(ALONE, 3)),
            lower(FirstArticulated(ALONE), FirstArticulated(UNINTERESTED)),
        ),
        reading="Earlier: a third of the sounds are articulated after a smaller part of the run.",
    ),
    Claim(
        "V3",
        "At first emulation gives no progress, later it does.",
        (
            equal(EmulationGain(AMID["1"], 1), 0.0),
            lower(EmulationGain(AMID["1"], 1), EmulationGain(AMID["1"], 2)),
        ),
        reading="Amid language 1, as in the thesis. At first: in the first half its competence "
        "grows by less than 0.1, and by less than in the second.",
    ),
    Claim(
        "V4",
        "Emulation is chosen more as it starts to pay and less once mastered.",
        (
            lower(Emulated(AMID["1"], 1), Emulated(AMID["1"])),
            lower(Emulated(AMID["1"], 10), Emulated(AMID["1"])),
        ),
        reading="Amid language 1. Its share in the tenth of the run in which its competence grows "
        "most is larger than in the first tenth and than in the last.",
    ),
    Claim(
        "V5",
        "Early sounds do not depend on the ambient language, mature ones do.",
        (
            equal(Mistaken(_ALL, "early"), CHANCE),
            lower(Mistaken(_ALL, "mature"), CHANCE),
        ),
        reading="By a classifier that tells the language of a sound by sounds of other runs: at "
        "chance, within ten percentage points, for the first tenth of a run; better for the last.",
    ),
    Claim(
        "V6",
        "Mature sounds overlap the ambient ones.",
        tuple(
            lower(measure(learner, language, "mature"), measure(learner, language, "early"))
            for language, learner in AMID.items()
            for measure in (Distance, Reach)
        ),
        reading="Amid each language, sounds are nearer to it in the last tenth of the run than in "
        "the first, and there are some nearer to each of its sounds.",
    ),
    Claim(
        "V6b",
        "More than those of self-exploring runs.",
        tuple(
            lower(Distance(learner, language, "mature"), Distance(ALONE, language, "mature"))
            for language, learner in AMID.items()
        ),
        reading="The control of V6: mature sounds of runs without a language are farther from it.",
    ),
)
"""V1 to V6 are the thesis's; V1b and V6b are controls that its central idea needs."""

VOCAL = Chapter(
    "vocal", "Vocal development (section 5.3)", "vocal", CLAIMS, read_chooser=read_vocal_run
)
