"""Claims over folders of journals: world by world, and over worlds."""

from dataclasses import replace

import pytest
from tests.made_up_runs import HOLDS

from sgim.claims import decide
from sgim.claims.plausible import count_worlds
from sgim.claims.throwing import THROWING
from sgim.claims.world import worlds_of
from sgim.errors import SgimError

OTHERWISE = HOLDS.but(demonstrations_first=(0.0005, 0.009))


def test_each_experiment_and_configuration_is_a_world_the_base_first() -> None:
    several = [
        replace(HOLDS, configuration="thesis"),
        replace(HOLDS, configuration="modern,prior=0.1"),
        replace(HOLDS, experiment="throwing-5"),
        HOLDS,
    ]
    worlds = worlds_of(run for made in several for run in made.runs())
    assert [(world.experiment, world.configuration) for world in worlds] == [
        ("throwing", "modern"),
        ("throwing-5", "modern"),
        ("throwing", "modern,prior=0.1"),
        ("throwing", "thesis"),
    ]
    assert all(len(world.groups["sgim-acts"]) == 12 for world in worlds)


def test_runs_that_do_not_compare_are_refused() -> None:
    with pytest.raises(SgimError, match=r"are both .* with seed 0"):
        worlds_of([*HOLDS.runs(), *HOLDS.runs()])


def test_counts_say_in_which_worlds_a_claim_does_not_hold() -> None:
    several = [
        HOLDS,
        replace(OTHERWISE, experiment="throwing-5"),
        replace(HOLDS, configuration="modern,prior=0.1"),
        replace(HOLDS, configuration="thesis"),
        replace(HOLDS.without("random"), configuration="modern,prior=0.2", seeds=range(4)),
    ]
    tables = [decide(THROWING, made.world()) for made in several]
    (plausible,) = count_worlds(tables)
    assert plausible.configuration == "modern"
    assert plausible.worlds == (
        "throwing",
        "throwing-5",
        "throwing with prior=0.1",
        "throwing with prior=0.2",
    )
    counts = {count.claim.id: count for count in plausible.counts}
    few = {"not shown": ["throwing with prior=0.2"]}
    assert (counts["S1"].holds, len(counts["S1"].words)) == (3, 4)
    assert counts["S1"].elsewhere == few
    assert counts["S2"].holds == 2
    assert counts["S2"].elsewhere == {"contradicted": ["throwing-5"], **few}
    assert (counts["T1"].holds, len(counts["T1"].words)) == (3, 3)
    assert counts["T1"].elsewhere == {}


def test_in_counts_six_seeds_are_enough_though_not_after_correction() -> None:
    few = [replace(HOLDS, seeds=range(6), experiment=name) for name in ("throwing", "throwing-5")]
    tables = [decide(THROWING, made.world()) for made in few]
    assert {table.by_id["S1"].word for table in tables} == {"not shown"}
    (plausible,) = count_worlds(tables)
    assert {count.claim.id: count.holds for count in plausible.counts}["S1"] == 2


def test_worlds_in_which_nothing_is_decided_are_not_counted() -> None:
    alone = replace(HOLDS, errors={"mimicry:T1": (1, 1)}, experiment="throwing-5")
    assert count_worlds([decide(THROWING, made.world()) for made in (HOLDS, alone)]) == []


def test_one_world_is_not_counted() -> None:
    assert count_worlds([decide(THROWING, HOLDS.world())]) == []
