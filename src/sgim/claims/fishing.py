"""The claims about the fishing rod (chapter 3, section 4.2.3), and the controls they need."""

from __future__ import annotations

from sgim.claims.claim import Chapter, Claim
from sgim.claims.components import equal, lower, not_higher, reaches, steadier
from sgim.claims.controls import controls
from sgim.claims.journeys import (
    ChanceOfShown,
    Count,
    Early,
    Floor,
    GoalsWithin,
    Produced,
    Tiles,
)
from sgim.claims.measures import ANY, Constant, Episodes, Error
from sgim.environments.tables import read_table

RANDOM, SAGG_RIAC, SGIM_D = "random", "sagg-riac", "sgim-d:D3"
SGIM_IM = "sgim-im:D3 with request_cost=2,request_window=15"
"""With the constants that section 4.2.3 gives it in this world."""

RARE = "sgim-d:D3 with demonstration_every=80"
IMITATION, OBSERVATION = "imitation:D3", "observation:D3"
OTHERS = (RANDOM, SAGG_RIAC, IMITATION, OBSERVATION)
"""Those that the thesis compares SGIM-D with; all of them that ask, ask demonstrator 3."""

WIDE = "fishing-wide"
ON_FLOOR = "fishing-floor"

ASKING = Episodes(teacher=ANY)
ALONE = Episodes(way="autonomous")

NOISE_FLOORS = (("fishing", 0.034), ("fishing-noisy", 0.070))
"""Experiment → error in m that `sgim.environments.fishing.noise_floor` gave with a large memory."""

APPROACHED = 2.0
"""Times the noise floor at which it counts as approached."""

TILES_ALONG = 19
"""Tiles along each side of [−1, 1]², those of which the benchmark has one goal each."""

REACHABLE = tuple((float(x), float(y)) for x, y in read_table("fishing_goals.csv"))


def _tiles(learner: str) -> Tiles:
    return Tiles(learner, "float", (-1.0, -1.0), (1.0, 1.0), TILES_ALONG)


def _within(learner: str) -> GoalsWithin:
    return GoalsWithin(learner, "float", ALONE, REACHABLE, "what can be reached")


CLAIMS = (
    Claim(
        "F1",
        "Final error: observation > random > SAGG-RIAC, and SGIM-D is lowest.",
        (
            lower(Error(RANDOM), Error(OBSERVATION)),
            lower(Error(SAGG_RIAC), Error(RANDOM)),
            *(lower(Error(SGIM_D), Error(other)) for other in OTHERS),
        ),
    ),
    Claim(
        "F2",
        "SGIM-D has at most half of random's error.",
        (
            lower(Error(SGIM_D), Error(RANDOM)),
            reaches(Error(SGIM_D), Error(RANDOM), 0.5),
        ),
        reading="It is lower, and the interval of the ratio reaches down to .5.",
    ),
    Claim(
        "F3",
        "SGIM-D is already lower at 1000 movements.",
        tuple(lower(Error(SGIM_D, at=1000), Error(other, at=1000)) for other in OTHERS),
        reading="Than each of the learners that it is compared with at the end.",
    ),
    Claim(
        "F4",
        "SGIM-D approaches the noise floor.",
        (
            lower(Error(SGIM_D), Floor(SGIM_D, NOISE_FLOORS), APPROACHED),
            lower(Error(SGIM_D), Error(SGIM_D, at=1000)),
        ),
        reading="Its final error is less than twice the floor, and less than at 1000 movements.",
    ),
    Claim(
        "F5",
        "Imitation is comparable to SAGG-RIAC, with less variance between runs.",
        (
            equal(Error(IMITATION), Error(SAGG_RIAC)),
            steadier(Error(IMITATION), Error(SAGG_RIAC)),
        ),
        reading="Comparable: within 20 % of the larger error.",
    ),
    Claim(
        "F6",
        "Explored area: SGIM-D > SAGG-RIAC > random.",
        (
            lower(_tiles(SAGG_RIAC), _tiles(SGIM_D)),
            lower(_tiles(RANDOM), _tiles(SAGG_RIAC)),
        ),
        reading="Tiles of 19 × 19 over [−1, 1]² that were reached twice or more.",
    ),
    Claim(
        "F7",
        "In the 10⁴ times larger outcome space SGIM-D keeps its precision, SAGG-RIAC does not.",
        (
            not_higher(Error(f"{SGIM_D} in {WIDE}"), Error(SGIM_D)),
            lower(Error(SAGG_RIAC), Error(f"{SAGG_RIAC} in {WIDE}")),
            lower(Error(f"{SGIM_D} in {WIDE}"), Error(f"{SAGG_RIAC} in {WIDE}")),
        ),
        reading="SGIM-D's error there is higher by less than 20 %, SAGG-RIAC's is higher, and "
        "SGIM-D's is lower than SAGG-RIAC's.",
    ),
    Claim(
        "F8",
        "There, SGIM-D's goals concentrate on the reachable set.",
        (
            lower(Constant(f"{SGIM_D} in {WIDE}", 0.5), _within(f"{SGIM_D} in {WIDE}")),
            lower(_within(f"{SAGG_RIAC} in {WIDE}"), _within(f"{SGIM_D} in {WIDE}")),
        ),
        reading="More than half of the goals that it chooses lie within the convex hull of the "
        "benchmark, and a larger share than of SAGG-RIAC's.",
    ),
    Claim(
        "F9",
        "Demonstrator 4 (the hard half) is as good as 3, demonstrator 5 (the easy half) between "
        "random and SAGG-RIAC.",
        (
            equal(Error("sgim-d:D4"), Error(SGIM_D)),
            lower(Error("sgim-d:D5"), Error(RANDOM)),
            lower(Error(SAGG_RIAC), Error("sgim-d:D5")),
        ),
    ),
    Claim(
        "F10",
        "Demonstrators 2 and 3 help more than 1; SGIM-D with any of the three beats the other "
        "learners.",
        (
            *(lower(Error(better), Error("sgim-d:D1")) for better in ("sgim-d:D2", SGIM_D)),
            *(
                lower(Error(f"sgim-d:D{number}"), Error(other))
                for number in (1, 2, 3)
                for other in OTHERS
            ),
        ),
    ),
    Claim(
        "F11",
        "Demonstrations 3 are structured: their parameters reject the random distribution.",
        (lower(ChanceOfShown(SGIM_D), 0.05),),
        reading="What was shown in each run, against as many random policies: a multivariate "
        "analysis of variance gives a p below .05.",
    ),
    Claim(
        "F12",
        "On the floor SGIM-D brings the ball to rest in view more often, and its error is 5 to 10 "
        "times smaller.",
        tuple(
            component
            for other in (f"{RANDOM} in {ON_FLOOR}", f"{SAGG_RIAC} in {ON_FLOOR}")
            for component in (
                lower(Produced(other, "ball"), Produced(f"sgim-d in {ON_FLOOR}", "ball")),
                lower(Error(f"sgim-d in {ON_FLOOR}"), Error(other), times=0.2),
            )
        ),
        reading="Than random and SAGG-RIAC; the error is at most a fifth of theirs.",
    ),
    Claim(
        "H5",
        "SGIM-IM has a lower error than SAGG-RIAC, which has a lower one than random.",
        (
            lower(Error(SGIM_IM), Error(SAGG_RIAC)),
            lower(Error(SAGG_RIAC), Error(RANDOM)),
        ),
    ),
    Claim(
        "H6",
        "With no more demonstrations than SGIM-D every 80 movements, SGIM-IM's error is no higher.",
        (
            not_higher(Count(SGIM_IM, ASKING), Count(RARE, ASKING)),
            not_higher(Error(SGIM_IM), Error(RARE)),
        ),
        reading="Both within 20 %.",
    ),
    Claim(
        "H7",
        "SGIM-IM's requests concentrate early.",
        (lower(Constant(SGIM_IM, 1 / 3), Early(SGIM_IM, ASKING, 1 / 3)),),
        reading="More than a third of them fall in the first third of the movements.",
    ),
    *controls(":D3", SGIM_IM),
)
"""F1 to H7 are the thesis's; S1 to S3b are controls that its central idea needs."""

FISHING = Chapter("fishing", "The fishing rod (chapter 3, section 4.2.3)", "fishing", CLAIMS)
