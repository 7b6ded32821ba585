"""Throwing and placing a ball (section 4.3.3), made again."""

from __future__ import annotations

from sgim.claims.throwing import EMULATES, MIMICS, SGIM_ACTS, THROWING
from sgim.experiments.sweep_plan import Part
from sgim.reproductions.declaration import Reproduction
from sgim.reproductions.drawings import choices_over_time, errors, profiles, strategies

LEARNERS = tuple(THROWING.learners)
CONTROLS = (
    *("uniform-choice", "round-robin"),
    *("demonstrations-first", "demonstrations-first-sagg-riac"),
)

REPRODUCTION = Reproduction(
    name="throwing",
    title="Throwing and placing a ball",
    source="thesis, section 4.3.3",
    summary=(
        "An arm of one joint swings a ball and lets it go: it is thrown some distance at some "
        "height, or, if it ends almost still, placed at an angle. Teacher T1 throws; T2 and T3 "
        "place, and who copies T3 misreads him. SGIM-ACTS chooses each episode what to aim at, "
        "whether to explore alone, and whom to mimic or to emulate."
    ),
    parts=(Part(("throwing",), LEARNERS, (), ("modern", "thesis")),),
    chapters=(THROWING,),
    drawings=(
        errors(
            "errors",
            "SGIM-ACTS and the learners of the thesis",
            (SGIM_ACTS, "sagg-riac", "random", *MIMICS, *EMULATES),
        ),
        errors("controls", "SGIM-ACTS and controls that do not choose", (SGIM_ACTS, *CONTROLS)),
        profiles("profiles", "How many runs are how good", (SGIM_ACTS, "sagg-riac", *CONTROLS)),
        choices_over_time("choices", "What is chosen over time", (SGIM_ACTS, "sagg-riac")),
        strategies("strategies", "Which mode for which goal", (SGIM_ACTS,)),
    ),
    worlds=(
        Part(
            tuple(f"throwing-{name}" for name in ("5", "20", "30", "100", "loose", "strict")),
            LEARNERS,
            (),
            ("modern", "thesis"),
        ),
        Part(
            ("throwing",),
            LEARNERS,
            (),
            (
                *("modern,prior=0.2", "modern,split_candidates=5", "modern,mimicry_radius=0.15"),
                *("thesis,prior=0.1", "thesis,split_candidates=5", "thesis,mimicry_radius=0.15"),
                "thesis,credit=chosen",
            ),
        ),
    ),
)
