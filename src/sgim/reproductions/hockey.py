"""Air hockey (section 4.2.2), made again."""

from __future__ import annotations

from sgim.claims.hockey import HOCKEY, SGIM_D, SGIM_IM
from sgim.experiments.sweep_plan import Part
from sgim.reproductions.declaration import Reproduction
from sgim.reproductions.drawings import choices_over_time, errors, profiles

LEARNERS = tuple(HOCKEY.learners)
FIRST = ("demonstrations-first", "demonstrations-first-sagg-riac")

REPRODUCTION = Reproduction(
    name="hockey",
    title="Air hockey",
    source="thesis, section 4.2.2",
    summary=(
        "A mallet follows a smooth path; if it meets the puck, the puck may reach the far border, "
        "part of which an obstacle hides from straight shots. A teacher shows shots at the right "
        "quarter. SGIM-IM asks him while imitation pays, SGIM-D every thirty movements."
    ),
    parts=(Part(("hockey",), LEARNERS, (), ("modern", "thesis")),),
    chapters=(HOCKEY,),
    drawings=(
        errors(
            "errors",
            "SGIM-IM, SGIM-D and who has no teacher",
            (SGIM_IM, SGIM_D, "sagg-riac", "random"),
        ),
        errors(
            "controls",
            "Learners that may ask, and controls",
            (SGIM_IM, SGIM_D, "sgim-acts", *FIRST, "uniform-choice", "round-robin"),
        ),
        profiles(
            "profiles",
            "How many runs are how good",
            (SGIM_IM, SGIM_D, "sagg-riac", "random", *FIRST),
        ),
        choices_over_time("choices", "What is chosen over time", (SGIM_IM, SGIM_D, "sgim-acts")),
    ),
    worlds=(
        Part(
            ("hockey",),
            LEARNERS,
            (),
            (
                *("modern,demonstration_every=10", "modern,demonstration_every=100"),
                *("modern,request_cost=10", "modern,request_cost=1000"),
            ),
        ),
    ),
)
