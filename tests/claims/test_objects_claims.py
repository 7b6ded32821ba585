"""Every claim about recognising objects can say yes, and can say no."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from sgim.claims import Verdicts, decide
from sgim.claims.label_measures import Dwelling, EvenLabels, OnLabel
from sgim.claims.objects import OBJECTS
from sgim.claims.world import World, worlds_of
from sgim.events import Evaluated
from sgim.recognition import FEATURES
from sgim.runs.summary import Openings, RecordedRun
from sgim.spaces import Choices
from sgim.task import Task

TOYS = Choices(["cubes", "car", "dog", "ball", "bear"])
TASK = Task(TOYS, {"view": FEATURES, "toy": TOYS}, goal_spaces={"toy": TOYS})
MOVEMENTS = 105

ERRORS = {
    "sgim-acts:unbiased": 0.08,
    "sgim-acts:biased": 0.085,
    "random:unbiased": 0.10,
    "random:biased": 0.12,
}
"""Each learner's final share of pictures that it doesn't recognise."""

CUBES = {"sgim-acts": 0.5, "random": 0.2}
STAYING = {"sgim-acts": 0.5, "random": 0.0}


def chosen(cubes: float, staying: float, rng: np.random.Generator) -> list[str | None]:
    labels: list[str | None] = list(TOYS.labels)
    others = (1 - cubes) / 4
    while len(labels) < MOVEMENTS:
        if len(labels) > 5 and rng.random() < staying:
            labels.append(labels[-1])
        else:
            labels.append(str(rng.choice(TOYS.labels, p=[cubes, *[others] * 4])))
    return labels


def world(
    errors: Mapping[str, float] = ERRORS,
    cubes: Mapping[str, float] = CUBES,
    staying: Mapping[str, float] = STAYING,
    wobble: float = 0.0,
) -> World:
    """Twenty made-up runs of each learner; SGIM-ACTS wobbles from seed to seed."""
    rng, runs = np.random.default_rng(0), []
    for learner, error in errors.items():
        name = learner.partition(":")[0]
        for seed in range(20):
            total = error + 0.005 * rng.normal() + wobble * (name == "sgim-acts") * (-1) ** seed
            labels = chosen(cubes[name], staying[name], rng)
            runs.append(
                RecordedRun(
                    Path(f"{learner}-{seed}.sgim"),
                    {
                        "experiment": "objects",
                        "learner": learner,
                        "recipe": {"configuration": {"name": "modern"}, "seed": seed},
                    },
                    MOVEMENTS,
                    {"pictures": {}, "digest": "00"},
                    (Evaluated(0, {"total": 1.0}), Evaluated(MOVEMENTS, {"total": total})),
                    task=TASK,
                    movements=MOVEMENTS,
                    openings=Openings(
                        np.arange(MOVEMENTS), ["push"] * MOVEMENTS, ["toy"] * MOVEMENTS, labels
                    ),
                    troubles={},
                )
            )
    (made,) = worlds_of(runs)
    return made


def words(verdicts: Verdicts) -> dict[str, str]:
    return {name: verdict.word for name, verdict in verdicts.by_id.items()}


def test_all_claims_hold_where_they_should() -> None:
    verdicts = decide(OBJECTS, world())
    assert words(verdicts) == dict.fromkeys(("O1", "O2", "O3", "O4"), "reproduced")
    assert [c.id for c in OBJECTS.claims if c.by_construction] == ["O4"]


@pytest.mark.parametrize(
    ("claim", "errors", "cubes", "staying"),
    [
        ("O1", {"sgim-acts:biased": 0.14}, {}, {}),
        ("O1", {"sgim-acts:unbiased": 0.13}, {}, {}),
        ("O2", {"sgim-acts:biased": 0.11}, {}, {}),
        ("O3", {}, {"sgim-acts": 0.05}, {}),
        ("O4", {}, {"sgim-acts": 0.2}, {"sgim-acts": 0.0, "random": 0.5}),
    ],
)
def test_each_claim_is_contradicted_where_it_fails(
    claim: str, errors: dict[str, float], cubes: dict[str, float], staying: dict[str, float]
) -> None:
    made = world(ERRORS | errors, CUBES | cubes, STAYING | staying)
    assert words(decide(OBJECTS, made))[claim] == "contradicted"


def test_a_claim_whose_effect_is_small_is_not_shown() -> None:
    close = {"sgim-acts:unbiased": 0.097, "sgim-acts:biased": 0.117}
    verdicts = decide(OBJECTS, world(ERRORS | close, wobble=0.05))
    assert words(verdicts)["O1"] == "not shown"


def test_shares_and_stays_leave_the_presentation_out() -> None:
    run = world().groups["random:biased"][0]
    assert isinstance(run, RecordedRun)
    labels = ["cubes", "car", "dog", "ball", "bear", "car", "car", "cubes", "dog", "dog", "dog"]
    run.openings.labels[:] = labels
    assert EvenLabels("random:biased").of(run, 11) == 1 / 5
    assert OnLabel("random:biased", "cubes").of(run, 11) == 1 / 6
    assert OnLabel("random:biased", "cubes").of(run, 7) == 0
    assert Dwelling("random:biased").of(run, 11) == 2.0
    assert np.isnan(Dwelling("random:biased").of(run, 5))
