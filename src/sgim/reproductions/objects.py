"""Recognising objects (section 2.3), made again."""

from __future__ import annotations

from sgim.claims.objects import CAREGIVERS, OBJECTS, RANDOM, SGIM_ACTS
from sgim.experiments.sweep_plan import Part
from sgim.figures import recognised
from sgim.reproductions.declaration import Drawing, Quick, Reproduction
from sgim.reproductions.drawings import choices_over_time, errors, profiles

LEARNERS = tuple(OBJECTS.learners)

REPRODUCTION = Reproduction(
    name="objects",
    title="Recognising objects",
    source="thesis, section 2.3",
    summary=(
        "A robot learns to recognise five toys. Each episode it chooses one, and whether to "
        "manipulate it by itself or to ask a caregiver to show it; the caregiver may be biased."
    ),
    parts=(Part(("objects",), LEARNERS, ()),),
    chapters=(OBJECTS,),
    drawings=(
        Drawing(
            "recognised",
            "Pictures recognised",
            "How many pictures of an object are recognised, in the mean of the objects, by "
            "episodes: the interquartile mean of the runs, and its 95 % bootstrap interval.",
            recognised,
        ),
        errors("errors", "Errors for each object", (*SGIM_ACTS.values(), *RANDOM.values())),
        profiles("profiles", "How many runs are how good"),
        choices_over_time(
            "choices", "What is chosen over time", tuple(SGIM_ACTS[c] for c in CAREGIVERS)
        ),
    ),
    quick=Quick(seeds=(0, 1, 2, 3), movements=40),
)
