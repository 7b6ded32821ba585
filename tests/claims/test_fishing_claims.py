"""Every claim about the fishing rod can say yes, and can say no."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from sgim.claims import Chapter, Verdicts, decide
from sgim.claims.fishing import FISHING, REACHABLE
from sgim.claims.world import linked, worlds_of
from sgim.environments.fishing.movement import FISHING as MOVEMENTS
from sgim.events import Evaluated
from sgim.runs.summary import Openings, RecordedRun
from sgim.spaces import Box, FloatArray
from sgim.task import Task

ROD = Task(MOVEMENTS.policy_space, {"float": Box([-1, -1], [1, 1])})
VIEW = Task(MOVEMENTS.policy_space, {"ball": Box([0, 0], [1, 1])})


@dataclass(frozen=True)
class Made:
    """How the runs of a learner are made up.

    Attributes:
        early: Error at 1000 movements.
        late: Error at 5000 movements.
        scatter: Standard deviation of the logarithms of the errors.
        tiles: How many places are reached, each three times.
        asking: How many requests are made.
        requested_early: Which share of them is made in the first third.
        within: Which share of the goals can be reached.
        structured: How far the mean of what is shown is from that of random policies.
        seen: Which share of the movements bring the ball to rest in view.
    """

    early: float
    late: float
    scatter: float = 0.02
    tiles: int = 50
    asking: int = 60
    requested_early: float = 0.6
    within: float = 0.1
    structured: float = 0.3
    seen: float = 0.1


WIDE, FLOOR = "fishing-wide", "fishing-floor"
RARE, IM = "demonstration_every=80", "request_cost=2,request_window=15"
SETTINGS = (RARE, IM)

HOLDS: dict[tuple[str, str], Made] = {
    ("fishing", "random"): Made(0.30, 0.20, tiles=50),
    ("fishing", "sagg-riac"): Made(0.25, 0.15, tiles=100, scatter=0.06),
    ("fishing", "observation:D3"): Made(0.50, 0.25),
    ("fishing", "imitation:D3"): Made(0.25, 0.15, scatter=0.01),
    ("fishing", "sgim-d:D3"): Made(0.15, 0.06, tiles=150),
    ("fishing", "sgim-d:D1"): Made(0.16, 0.10),
    ("fishing", "sgim-d:D2"): Made(0.15, 0.06),
    ("fishing", "sgim-d:D4"): Made(0.15, 0.06),
    ("fishing", "sgim-d:D5"): Made(0.20, 0.17),
    (IM, "sgim-im:D3"): Made(0.15, 0.06),
    ("fishing", "sgim-acts:D3"): Made(0.15, 0.06),
    ("fishing", "uniform-choice:D3"): Made(0.20, 0.12),
    ("fishing", "round-robin:D3"): Made(0.20, 0.12),
    ("fishing", "demonstrations-first:D3"): Made(0.20, 0.12),
    ("fishing", "demonstrations-first-sagg-riac:D3"): Made(0.20, 0.12),
    (RARE, "sgim-d:D3"): Made(0.16, 0.07, asking=62),
    (WIDE, "sagg-riac"): Made(0.30, 0.20, within=0.01),
    (WIDE, "sgim-d:D3"): Made(0.15, 0.06, within=0.8),
    (FLOOR, "random"): Made(95.0, 90.0, seen=0.1),
    (FLOOR, "sagg-riac"): Made(95.0, 90.0, seen=0.1),
    (FLOOR, "sgim-d"): Made(40.0, 10.0, seen=0.5),
}


@dataclass(frozen=True)
class MadeUpRun(RecordedRun):
    """A run without a journal."""

    made: Made = field(default_factory=lambda: Made(1.0, 1.0))

    def produced(self, kind: str, movements: int | None = None) -> FloatArray:
        if kind == "ball":
            seen = np.arange(5000) < 5000 * self.made.seen
            return np.where(seen[:, None], [[0.5, 0.5]], [[100.5, 0.5]])
        places = np.stack(np.divmod(np.arange(self.made.tiles), 19), axis=1)
        return np.repeat((places + 0.5) / 19 * 2 - 1, 3, axis=0)

    def aimed_at(self, kind: str) -> tuple[NDArray[np.int64], FloatArray]:
        count = len(self.openings.modes)
        near = np.random.default_rng(self.seed).random(count) < self.made.within
        goals = np.where(near[:, None], np.mean(REACHABLE, axis=0), [[50.0, 50.0]])
        return np.arange(count), goals

    def shown(self) -> FloatArray:
        rng = np.random.default_rng([self.seed or 0, 1])
        return np.clip(rng.random((60, 25)) + self.made.structured, 0, 1)


def run(where: str, learner: str, seed: int, made: Made) -> MadeUpRun:
    rng = np.random.default_rng([seed, [*HOLDS].index((where, learner))])
    early, late = np.array([made.early, made.late]) * np.exp(rng.normal(0, made.scatter, 2))
    begun = np.sort(rng.integers(0, 5000, 400))
    first = np.flatnonzero(begun < 5000 / 3)
    later = np.flatnonzero(begun >= 5000 / 3)
    count = round(made.asking * made.requested_early)
    asks = {*first[:count].tolist(), *later[: made.asking - count].tolist()}
    modes = ["imitate D3" if i in asks else "autonomous" for i in range(400)]
    name = f"modern,{where}" if where in SETTINGS else "modern"
    recipe = {"configuration": {"name": name}, "seed": seed}
    experiment = "fishing" if where in SETTINGS else where
    return MadeUpRun(
        Path(f"{where}-{learner}-{seed}.sgim"),
        {"experiment": experiment, "learner": learner, "recipe": recipe},
        5000,
        {"goals": {"float": 355}, "digest": "00"},
        (Evaluated(1000, {"total": early}), Evaluated(5000, {"total": late})),
        task=VIEW if where == FLOOR else ROD,
        movements=5000,
        openings=Openings(begun, modes, ["float"] * 400),
        troubles={},
        made=made,
    )


def verdicts(
    changed: Mapping[tuple[str, str], Mapping[str, Any]], chapter: Chapter = FISHING
) -> Verdicts:
    """The claims decided by twelve made-up runs of each learner."""
    runs = [
        run(where, learner, seed, replace(made, **changed.get((where, learner), {})))
        for (where, learner), made in HOLDS.items()
        for seed in range(12)
    ]
    world = next(w for w in linked(worlds_of(runs), "fishing") if w.name == "fishing")
    return decide(chapter, world)


IDS = [*(f"F{i}" for i in range(1, 13)), "H5", "H6", "H7", "S1", "S2", "S2b", "S3", "S3b"]

OTHERWISE: list[tuple[str, str, str, dict[str, Any]]] = [
    ("F1", "fishing", "observation:D3", {"late": 0.15}),
    ("F1", "fishing", "sagg-riac", {"late": 0.25}),
    ("F1", "fishing", "imitation:D3", {"late": 0.05}),
    ("F2", "fishing", "sgim-d:D3", {"late": 0.12}),
    ("F3", "fishing", "imitation:D3", {"early": 0.10}),
    ("F4", "fishing", "sgim-d:D3", {"late": 0.08}),
    ("F4", "fishing", "sgim-d:D3", {"early": 0.05}),
    ("F5", "fishing", "imitation:D3", {"late": 0.11}),
    ("F5", "fishing", "imitation:D3", {"scatter": 0.15}),
    ("F6", "fishing", "sagg-riac", {"tiles": 160}),
    ("F6", "fishing", "random", {"tiles": 120}),
    ("F7", WIDE, "sgim-d:D3", {"late": 0.09}),
    ("F7", WIDE, "sagg-riac", {"late": 0.12}),
    ("F8", WIDE, "sgim-d:D3", {"within": 0.3}),
    ("F8", WIDE, "sagg-riac", {"within": 0.95}),
    ("F9", "fishing", "sgim-d:D4", {"late": 0.10}),
    ("F9", "fishing", "sgim-d:D5", {"late": 0.12}),
    ("F10", "fishing", "sgim-d:D2", {"late": 0.12}),
    ("F10", "fishing", "sgim-d:D1", {"late": 0.18}),
    ("F11", "fishing", "sgim-d:D3", {"structured": 0.0}),
    ("F12", FLOOR, "sgim-d", {"seen": 0.05}),
    ("F12", FLOOR, "sgim-d", {"late": 40.0}),
    ("H5", IM, "sgim-im:D3", {"late": 0.18}),
    ("H6", IM, "sgim-im:D3", {"asking": 100}),
    ("H6", RARE, "sgim-d:D3", {"late": 0.04}),
    ("H7", IM, "sgim-im:D3", {"requested_early": 0.2}),
    ("S1", "fishing", "round-robin:D3", {"late": 0.05}),
    ("S2", "fishing", "demonstrations-first:D3", {"late": 0.05}),
    ("S2b", "fishing", "demonstrations-first-sagg-riac:D3", {"late": 0.05}),
    ("S3", IM, "sgim-im:D3", {"late": 0.13}),
    ("S3b", "fishing", "demonstrations-first-sagg-riac:D3", {"late": 0.05}),
]
"""A claim, and the runs of which learner are otherwise, and how."""


@cache
def holding() -> Verdicts:
    return verdicts({})


def test_all_claims_of_the_table_are_declared_once() -> None:
    assert [claim.id for claim in FISHING.claims] == IDS


@pytest.mark.parametrize("claim", IDS)
def test_a_claim_is_reproduced_by_runs_in_which_it_holds(claim: str) -> None:
    verdict = holding().by_id[claim]
    assert verdict.word == "reproduced", [(str(f.component), f.p) for f in verdict.findings]


@pytest.mark.parametrize(("claim", "where", "learner", "changes"), OTHERWISE)
def test_a_claim_is_contradicted_by_runs_in_which_it_is_otherwise(
    claim: str, where: str, learner: str, changes: dict[str, Any]
) -> None:
    alone = replace(FISHING, claims=tuple(one for one in FISHING.claims if one.id == claim))
    verdict = verdicts({(where, learner): changes}, alone).by_id[claim]
    assert verdict.word == "contradicted", [(str(f.component), f.p) for f in verdict.findings]


def test_each_claim_can_be_contradicted() -> None:
    assert {claim for claim, *_ in OTHERWISE} == {*IDS}


def test_a_claim_about_another_world_needs_its_runs() -> None:
    runs = [run("fishing", name, 0, HOLDS["fishing", name]) for name in ("sagg-riac", "sgim-d:D3")]
    (world,) = linked(worlds_of(runs), "fishing")
    assert decide(FISHING, world).by_id["F7"].needs == (
        "sgim-d:D3 in fishing-wide",
        "sagg-riac in fishing-wide",
    )


def test_a_variant_has_its_own_runs_of_other_settings_and_no_other_variants() -> None:
    runs = [
        replace(made, header={**made.header, "experiment": "fishing-noisy"})
        for where, learner in HOLDS
        for made in (run(where, learner, 0, HOLDS[where, learner]),)
        if where in (*SETTINGS, "fishing")
    ]
    wide = [run(WIDE, name, 0, HOLDS[WIDE, name]) for name in ("sagg-riac", "sgim-d:D3")]
    worlds = linked(worlds_of([*runs, *wide]), "fishing")
    found = decide(FISHING, next(w for w in worlds if w.name == "fishing-noisy")).by_id
    assert found["H6"].findings
    assert not found["F7"].findings
