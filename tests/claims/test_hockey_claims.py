"""Every claim about air hockey can say yes, and can say no."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from sgim.claims import Verdicts, decide
from sgim.claims.hockey import HOCKEY
from sgim.claims.world import worlds_of
from sgim.environments import AirHockey
from sgim.events import Evaluated
from sgim.runs.summary import Openings, RecordedRun

TASK = AirHockey().task

ERRORS = {
    "sgim-im": (0.002, 0.0010),
    "sgim-d": (0.002, 0.0011),
    "sagg-riac": (0.030, 0.0200),
    "random": (0.040, 0.0250),
    "sgim-acts": (0.002, 0.0010),
    "uniform-choice": (0.003, 0.0020),
    "round-robin": (0.003, 0.0020),
    "demonstrations-first": (0.003, 0.0020),
    "demonstrations-first-sagg-riac": (0.003, 0.0020),
}
"""Each learner's errors at 1000 and at 8000 movements."""

ASKING = (0.5, 0.4, 0.2, 0.1)
"""How often SGIM-IM asks, by quarter."""


def verdicts(errors: Mapping[str, tuple[float, float]], asking: Sequence[float]) -> Verdicts:
    """The claims decided by twelve made-up runs of each learner."""
    rng = np.random.default_rng(0)
    runs = []
    for learner, pair in errors.items():
        for seed in range(12):
            early, late = pair * np.exp(rng.normal(0, 0.02, 2))
            modes = [
                mode
                for share in asking
                for mode in rng.choice(["imitate expert", "autonomous"], 400, p=[share, 1 - share])
            ]
            begun = np.linspace(0, 8000, len(modes), endpoint=False).astype(np.int64)
            configuration = {"configuration": {"name": "modern"}, "seed": seed}
            runs.append(
                RecordedRun(
                    Path(f"{learner}-{seed}.sgim"),
                    {"experiment": "hockey", "learner": learner, "recipe": configuration},
                    8000,
                    {"goals": {"hit": 41}, "digest": "00"},
                    (Evaluated(1000, {"total": early}), Evaluated(8000, {"total": late})),
                    task=TASK,
                    movements=8000,
                    openings=Openings(begun, modes, ["hit"] * len(modes)),
                    troubles={},
                )
            )
    (world,) = worlds_of(runs)
    return decide(HOCKEY, world)


IDS = ["H1", "H2", "H3", "H4", "S1", "S2", "S2b", "S3", "S3b"]

OTHERWISE = [
    ("H1", {"sagg-riac": (0.03, 0.005)}, ASKING),
    ("H1", {"random": (0.03, 0.005)}, ASKING),
    ("H2", {"random": (0.001, 0.025)}, ASKING),
    ("H3", {"sgim-d": (0.002, 0.0004)}, ASKING),
    ("H3", {"sgim-d": (0.002, 0.0030)}, ASKING),
    ("H4", {}, (0.1, 0.2, 0.2, 0.5)),
    ("S1", {"round-robin": (0.002, 0.0005)}, ASKING),
    ("S2", {"demonstrations-first": (0.002, 0.0005)}, ASKING),
    ("S2b", {"demonstrations-first-sagg-riac": (0.002, 0.0005)}, ASKING),
    ("S3", {"sgim-d": (0.002, 0.0040)}, ASKING),
    ("S3", {"sgim-im": (0.002, 0.0040)}, ASKING),
    ("S3b", {"demonstrations-first-sagg-riac": (0.002, 0.0005)}, ASKING),
]
"""A claim, and runs in which it is otherwise."""


def test_every_claim_is_reproduced_by_runs_in_which_it_holds() -> None:
    found = verdicts(ERRORS, ASKING)
    assert {name: v.word for name, v in found.by_id.items()} == dict.fromkeys(IDS, "reproduced")


@pytest.mark.parametrize(("claim", "errors", "asking"), OTHERWISE)
def test_a_claim_is_contradicted_by_runs_in_which_it_is_otherwise(
    claim: str, errors: Mapping[str, tuple[float, float]], asking: Sequence[float]
) -> None:
    found = verdicts({**ERRORS, **errors}, asking)
    assert found.by_id[claim].word == "contradicted"


def test_each_claim_can_be_contradicted() -> None:
    assert {claim for claim, *_ in OTHERWISE} == {*IDS}
