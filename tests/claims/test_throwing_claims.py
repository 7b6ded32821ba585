"""Every claim about throwing can say yes, and can say no."""

from dataclasses import replace
from functools import cache

import pytest
from tests.made_up_runs import ERRORS, HOLDS, MadeUp

from sgim.claims import Verdicts, decide
from sgim.claims.throwing import THROWING

IDS = ["T1", "T2", "T3", "T4", "T5", "T6", "T7", "T8", "T9", "T10", "S1", "S2", "S2b"]

OTHERWISE = [
    ("T1", HOLDS.but(sgim_acts=(0.045, 0.010))),
    ("T1", HOLDS.but(emulation_T3=(0.0005, 0.009))),
    ("T2", HOLDS.but(sgim_acts=(0.001, 0.020))),
    ("T2", HOLDS.but(mimicry_T1=(1.0, 0.007))),
    ("T3", HOLDS.but(sgim_acts=(0.020, 0.010))),
    ("T4", HOLDS.but(sagg_riac=(0.2, 0.05))),
    ("T4", HOLDS.but(random=(0.03, 0.042))),
    ("T4", HOLDS.but(sagg_riac=(0.095, 0.0105))),
    ("T5", HOLDS.but(mimicry_T3=(0.05, 0.35))),
    ("T5", HOLDS.but(emulation_T2=(0.7, 0.04))),
    ("T6", HOLDS.but(choices={"autonomous": (0.6, 0.6, 0.5, 0.4)})),
    ("T7", HOLDS.but(choices={"to_place": (0.03, 0.2, 0.6, 0.03, 0.1, 0.1)})),
    ("T8", HOLDS.but(choices={"to_place": (0.03, 0.1, 0.04, 0.03, 0.7, 0.1)})),
    ("T9", HOLDS.but(choices={"placing": (0.68, 0.6, 0.6, 0.54)})),
    ("T10", HOLDS.but(choices={"to_place": (0.6, 0.1, 0.1, 0.6, 0.1, 0.1)})),
    ("T10", HOLDS.but(choices={"autonomous": [0.9] * 4, "to_place": (3, 1, 0.5, 3, 1, 1)})),
    ("S1", HOLDS.but(uniform_choice=(0.0005, 0.009))),
    ("S1", HOLDS.but(round_robin=(0.0005, 0.009))),
    ("S2", HOLDS.but(demonstrations_first=(0.0005, 0.009))),
    ("S2b", HOLDS.but(demonstrations_first_sagg_riac=(0.0005, 0.009))),
]
"""A claim, and runs in which it is otherwise."""

SCATTERED = [
    ("T1", HOLDS.but(emulation_T3=(0.0011, 0.0108))),
    ("T2", HOLDS.but(sagg_riac=(0.2, 0.0085))),
    ("T3", HOLDS.but(mimicry_T2=(0.0011, 0.35))),
    ("T4", HOLDS.but(sagg_riac=(0.12, 0.0105))),
    ("T5", HOLDS.but(emulation_T1=(0.11, 0.03))),
    ("S1", HOLDS.but(round_robin=(0.001, 0.0103))),
    ("S2", HOLDS.but(demonstrations_first=(0.0011, 0.0107))),
    ("S2b", HOLDS.but(demonstrations_first_sagg_riac=(0.0011, 0.0107))),
]
"""A claim, and runs in which it holds by less than errors scatter."""


@cache
def holding() -> Verdicts:
    return decide(THROWING, HOLDS.world())


def test_all_claims_of_the_table_are_declared_once() -> None:
    assert [claim.id for claim in THROWING.claims] == IDS


@pytest.mark.parametrize("claim", IDS)
def test_a_claim_is_reproduced_by_runs_in_which_it_holds(claim: str) -> None:
    verdict = holding().by_id[claim]
    assert verdict.word == "reproduced"
    assert verdict.p is not None
    assert verdict.p <= verdict.p_holm < 0.05


@pytest.mark.parametrize(("claim", "runs"), OTHERWISE)
def test_a_claim_is_contradicted_by_runs_in_which_it_is_otherwise(claim: str, runs: MadeUp) -> None:
    verdict = decide(THROWING, runs.world()).by_id[claim]
    assert verdict.word == "contradicted"
    assert verdict.deciding.direction < 0


def test_each_claim_can_be_contradicted() -> None:
    assert {claim for claim, _ in OTHERWISE} == {*IDS}


@pytest.mark.parametrize("claim", IDS)
def test_a_claim_that_holds_in_few_runs_is_not_shown(claim: str) -> None:
    few = replace(HOLDS, seeds=range(4))
    assert decide(THROWING, few.world()).by_id[claim].word == "not shown"


@pytest.mark.parametrize(("claim", "runs"), SCATTERED)
def test_a_claim_that_holds_by_less_than_errors_scatter_is_not_shown(
    claim: str, runs: MadeUp
) -> None:
    verdict = decide(THROWING, replace(runs, scatter=0.12).world()).by_id[claim]
    assert verdict.word == "not shown"
    assert 0 < verdict.deciding.direction < 1


def test_to_be_tied_on_throwing_is_enough() -> None:
    tied = HOLDS.but(sagg_riac=(0.2, 0.0095))
    assert decide(THROWING, tied.world()).by_id["T2"].word == "reproduced"


def test_t10_counts_the_goals_that_were_chosen_and_not_all_requests() -> None:
    """T1 is asked for most throws, which says nothing of placing."""
    for_throws = HOLDS.but(choices={"to_throw": (1, 0.01, 0.01, 1, 0.01, 0.01)})
    assert decide(THROWING, for_throws.world()).by_id["T10"].word == "reproduced"


def test_an_even_share_is_one_of_the_modes_that_there_are() -> None:
    """With ten teachers there are 21 modes, and a tenth is no longer seldom."""
    tenth = HOLDS.but(choices={"to_place": (1, 1, 1.2, 1, 1, 1), "to_throw": (1, 1, 1.2, 1, 1, 1)})
    assert decide(THROWING, tenth.world()).by_id["T7"].word == "reproduced"
    crowd = replace(tenth, teachers=[f"T{k}" for k in range(1, 11)])
    assert decide(THROWING, crowd.world()).by_id["T7"].word == "contradicted"


@pytest.mark.parametrize("learner", ERRORS)
def test_a_claim_without_runs_says_whose_it_needs(learner: str) -> None:
    found = decide(THROWING, HOLDS.without(learner).world())
    lacking = {claim.id for claim in THROWING.claims if learner in claim.learners}
    assert {v.claim.id for v in found.verdicts if v.word == "no runs"} == lacking
    assert all(found.by_id[claim].needs == (learner,) for claim in lacking)
    assert all(v.word == "reproduced" for v in found.verdicts if v.claim.id not in lacking)
