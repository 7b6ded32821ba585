"""Every claim about vocal development can say yes, and can say no."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sgim.claims import Verdicts, decide
from sgim.claims.vocal import ALONE, AMID, UNINTERESTED, VOCAL
from sgim.claims.vocal_measures import FirstArticulated, Mistaken, NoOrder, Reach
from sgim.claims.world import worlds_of
from sgim.environments import VocalTract, ambient_language
from sgim.events import Evaluated
from sgim.experiments.vocal_history import VocalHistory, VocalRun
from sgim.runs.summary import Openings
from sgim.spaces import FloatArray

TASK = VocalTract().task
SOUNDS = 1200
TENTH = SOUNDS // 10
SEEDS = range(12)

Phases = Sequence[tuple[int, tuple[float, float, float]]]
"""For so many tenths, the shares of silent, unarticulated and articulated sounds."""

ORDERED: Phases = ((3, (0.6, 0.35, 0.05)), (4, (0.1, 0.8, 0.1)), (3, (0.05, 0.25, 0.7)))
LATE: Phases = ((9, (0.6, 0.35, 0.05)), (1, (0.05, 0.25, 0.7)))
BACKWARDS: Phases = ((3, (0.05, 0.25, 0.7)), (4, (0.1, 0.8, 0.1)), (3, (0.6, 0.35, 0.05)))


@dataclass(frozen=True)
class MadeUp:
    """How runs of a learner are made up.

    Attributes:
        phases: The classes of its sounds.
        emulated: Share of emulations in each tenth.
        competence: Of emulations, in each tenth.
        early: Language that the sounds of the first tenth are like; None for none.
        mature: Language that those of the last are like.
    """

    phases: Phases = ORDERED
    emulated: Sequence[float] = (0.1, 0.1, 0.2, 0.2, 0.3, 0.7, 0.4, 0.3, 0.2, 0.2)
    competence: Sequence[float] = (0.2, 0.2, 0.2, 0.2, 0.2, 0.25, 0.6, 0.8, 0.8, 0.85)
    early: str | None = None
    mature: str | None = None


HOLDS = {
    ALONE: MadeUp(emulated=[0.0] * 10),
    UNINTERESTED: MadeUp(phases=LATE, emulated=[0.0] * 10),
    **{learner: MadeUp(mature=language) for language, learner in AMID.items()},
}
"""Learners of which every claim holds."""


def history(made: MadeUp, rng: np.random.Generator) -> VocalHistory:
    shares = np.repeat([s for _, s in made.phases], [t * TENTH for t, _ in made.phases], axis=0)
    drawn = (rng.random((SOUNDS, 1)) > np.cumsum(shares, axis=1)).sum(axis=1)
    intensity = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])[drawn]
    formants = rng.uniform(-0.6, 0.6, (SOUNDS, 2, 2)) * intensity[:, None]
    sounds = np.concatenate([intensity, formants.reshape(SOUNDS, 4)], axis=1)
    for language, rows in ((made.early, slice(TENTH)), (made.mature, slice(-TENTH, None))):
        if language is not None:
            ambient = ambient_language(language).sounds
            sounds[rows] = ambient[rng.integers(len(ambient), size=TENTH)]
    sounds += rng.normal(0, 0.02, sounds.shape)
    emulating = rng.random(SOUNDS) < np.repeat(made.emulated, TENTH)
    away = rng.normal(size=sounds.shape)
    away /= np.linalg.norm(away, axis=1)[:, None]
    competence = np.repeat(made.competence, TENTH) + rng.normal(0, 0.005, SOUNDS)
    goals = sounds - np.log(competence)[:, None] * away
    return VocalHistory(sounds, goals, ("autonomous", "emulate x"), emulating.astype(np.int64))


def run(learner: str, seed: int, made: MadeUp) -> VocalRun:
    return VocalRun(
        Path(f"{learner.replace(':', '-')}-{seed}.sgim"),
        {
            "experiment": "vocal",
            "learner": learner,
            "recipe": {"configuration": {"name": "modern"}, "seed": seed},
        },
        SOUNDS,
        {"goals": {"sound": 3}, "digest": "00"},
        (Evaluated(SOUNDS, {"sound": 0.1, "total": 0.1}),),
        task=TASK,
        movements=SOUNDS,
        openings=Openings(np.zeros(0, dtype=np.int64), [], []),
        troubles={},
        history=history(made, np.random.default_rng([seed, sum(map(ord, learner))])),
    )


def verdicts(changed: Mapping[str, MadeUp]) -> Verdicts:
    made = {**HOLDS, **changed}
    (world,) = worlds_of([run(name, seed, made[name]) for name in made for seed in SEEDS])
    return decide(VOCAL, world)


def of_all(**changes: Any) -> dict[str, MadeUp]:
    """The learners amid languages, changed."""
    return {name: replace(HOLDS[name], **changes) for name in AMID.values()}


FIRST = AMID["1"]
OTHERWISE: list[tuple[str, Mapping[str, MadeUp]]] = [
    ("V1", {ALONE: replace(HOLDS[ALONE], phases=LATE)}),
    ("V1", {ALONE: replace(HOLDS[ALONE], phases=BACKWARDS)}),
    (
        "V1b",
        {
            ALONE: replace(HOLDS[ALONE], phases=LATE),
            UNINTERESTED: replace(HOLDS[UNINTERESTED], phases=ORDERED),
        },
    ),
    ("V2", {ALONE: replace(HOLDS[ALONE], phases=BACKWARDS)}),
    (
        "V2",
        {
            ALONE: replace(HOLDS[ALONE], phases=LATE),
            UNINTERESTED: replace(HOLDS[UNINTERESTED], phases=ORDERED),
        },
    ),
    ("V3", {FIRST: replace(HOLDS[FIRST], competence=[0.1, 0.2, 0.4, 0.6, 0.7] + [0.8] * 5)}),
    ("V3", {FIRST: replace(HOLDS[FIRST], competence=[0.2] * 10)}),
    ("V4", {FIRST: replace(HOLDS[FIRST], emulated=np.linspace(0.9, 0.1, 10).tolist())}),
    ("V4", {FIRST: replace(HOLDS[FIRST], emulated=np.linspace(0.1, 0.9, 10).tolist())}),
    ("V5", {name: replace(HOLDS[name], early=language) for language, name in AMID.items()}),
    ("V5", of_all(mature="1")),
    ("V6", of_all(mature=None, early="1")),
    ("V6b", {ALONE: replace(HOLDS[ALONE], mature="2"), **of_all(mature=None)}),
]
"""A claim, and learners of which it is otherwise."""

IDS = ["V1", "V1b", "V2", "V3", "V4", "V5", "V6", "V6b"]


def test_every_claim_is_reproduced_by_runs_in_which_it_holds() -> None:
    found = verdicts({})
    assert {name: v.word for name, v in found.by_id.items()} == dict.fromkeys(IDS, "reproduced")


@pytest.mark.parametrize(("claim", "changed"), OTHERWISE)
def test_a_claim_is_contradicted_by_runs_in_which_it_is_otherwise(
    claim: str, changed: Mapping[str, MadeUp]
) -> None:
    assert verdicts(changed).by_id[claim].word in ("contradicted", "not shown")


def test_each_claim_can_fail() -> None:
    assert {claim for claim, _ in OTHERWISE} == {*IDS}


def test_a_run_is_without_order_if_a_stage_is_missing_or_goes_back() -> None:
    ends = [1.0 - NoOrder(ALONE).of(run(ALONE, 0, MadeUp(p)), SOUNDS) for p in (ORDERED, LATE)]
    assert ends == [1.0, 0.0]
    assert NoOrder(ALONE).of(run(ALONE, 0, MadeUp(BACKWARDS)), SOUNDS) == 1.0


def test_the_first_articulated_window_is_found() -> None:
    measure = FirstArticulated(ALONE)
    assert measure.of(run(ALONE, 0, MadeUp(ORDERED)), SOUNDS) == pytest.approx(0.7, abs=0.02)
    never: Phases = ((10, (0.5, 0.5, 0.0)),)
    assert measure.of(run(ALONE, 0, MadeUp(never)), SOUNDS) == 1.0


def test_reach_needs_sounds_near_every_sound_of_the_language() -> None:
    made = run(FIRST, 0, HOLDS[FIRST])
    assert Reach(FIRST, "1", "mature").of(made, SOUNDS) < 0.05
    ambient = ambient_language("1").sounds
    one_only: FloatArray = made.history.sounds.copy()
    one_only[-TENTH:] = ambient[0]
    half = replace(made, history=replace(made.history, sounds=one_only))
    assert Reach(FIRST, "1", "mature").of(half, SOUNDS) > 0.5


def test_languages_are_told_by_other_runs_only() -> None:
    learners = tuple(AMID.values())
    groups = {name: [run(name, seed, HOLDS[name]) for seed in (0, 1)] for name in learners}
    mature = Mistaken(learners, "mature").values(groups, SOUNDS)
    assert {*mature} == {0, 1}
    assert max(mature.values()) < 0.05
    single = {name: runs[:1] for name, runs in groups.items()}
    assert np.isnan([*Mistaken(learners, "mature").values(single, SOUNDS).values()]).all()
