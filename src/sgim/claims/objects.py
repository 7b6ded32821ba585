"""The claims about recognising objects (section 2.3.3)."""

from __future__ import annotations

from sgim.claims.claim import Chapter, Claim
from sgim.claims.components import lower
from sgim.claims.label_measures import Dwelling, EvenLabels, Loss, OnLabel
from sgim.claims.measures import Error

HARDEST = "cubes"
CAREGIVERS = ("unbiased", "biased")
SGIM_ACTS = {caregiver: f"sgim-acts:{caregiver}" for caregiver in CAREGIVERS}
RANDOM = {caregiver: f"random:{caregiver}" for caregiver in CAREGIVERS}

CLAIMS = (
    Claim(
        "O1",
        "SGIM-ACTS ends with more pictures recognised than random, with either caregiver.",
        tuple(lower(Error(SGIM_ACTS[c]), Error(RANDOM[c])) for c in CAREGIVERS),
        reading="The error is the share of pictures that are not recognised, the mean of the toys.",
    ),
    Claim(
        "O2",
        "It loses less than random when the caregiver is biased.",
        (
            lower(
                Loss(SGIM_ACTS["biased"], SGIM_ACTS["unbiased"]),
                Loss(RANDOM["biased"], RANDOM["unbiased"]),
            ),
        ),
        reading="Difference of the errors with both caregivers at equal seeds, against the same "
        "difference for random.",
    ),
    Claim(
        "O3",
        "It spends most of its time on the cubes.",
        tuple(lower(EvenLabels(SGIM_ACTS[c]), OnLabel(SGIM_ACTS[c], HARDEST)) for c in CAREGIVERS),
        reading="More than an even share, one in five; the thesis has 54 % and 51 %.",
    ),
    Claim(
        "O4",
        "It stays with an object for longer than random.",
        tuple(lower(Dwelling(RANDOM[c]), Dwelling(SGIM_ACTS[c])) for c in CAREGIVERS),
        reading="Mean number of episodes on end with the same toy.",
        by_construction=True,
    ),
)
"""All are the thesis's."""

OBJECTS = Chapter("objects", "Recognising objects (section 2.3.3)", "objects", CLAIMS)
