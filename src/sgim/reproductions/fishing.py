"""The fishing rod (chapter 3, section 4.2.3), made again."""

from __future__ import annotations

from sgim.claims.fishing import FISHING, IMITATION, OBSERVATION, RANDOM, SAGG_RIAC, SGIM_D
from sgim.experiments.sweep_plan import Part
from sgim.reproductions.declaration import Quick, Reproduction
from sgim.reproductions.drawings import choices_over_time, errors, profiles

CONTROLS = (
    *("sgim-acts:D3", "uniform-choice:D3", "round-robin:D3"),
    *("demonstrations-first:D3", "demonstrations-first-sagg-riac:D3"),
)
LEARNERS = tuple(FISHING.sweeps["fishing", ""])
CONFIGURATIONS = ("modern", "thesis")

REPRODUCTION = Reproduction(
    name="fishing",
    title="The fishing rod",
    source="thesis, chapter 3 and section 4.2.3",
    summary=(
        "A robot arm with a fishing rod casts its float where asked on the water. Demonstrators "
        "have shown casts of several sorts. SGIM-D asks one at a fixed frequency, SGIM-IM while "
        "imitation pays."
    ),
    parts=(Part(("fishing",), LEARNERS, (), CONFIGURATIONS),),
    needed=tuple(
        Part(
            (experiment,),
            tuple(learners),
            (),
            tuple(f"{name},{settings}" if settings else name for name in CONFIGURATIONS),
        )
        for (experiment, settings), learners in FISHING.sweeps.items()
        if (experiment, settings) != ("fishing", "")
    ),
    chapters=(FISHING,),
    drawings=(
        errors(
            "errors",
            "SGIM-D and the learners of the thesis",
            (SGIM_D, SAGG_RIAC, IMITATION, OBSERVATION, RANDOM),
        ),
        errors("controls", "Learners that may ask, and controls", (SGIM_D, *CONTROLS)),
        profiles("profiles", "How many runs are how good", (SGIM_D, SAGG_RIAC, RANDOM, *CONTROLS)),
        choices_over_time("choices", "What is chosen over time", (SGIM_D, "sgim-acts:D3")),
    ),
    quick=Quick(tuple(range(4)), 1000),
)
