"""A component is decided by the numbers of its runs, and says how."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import mannwhitneyu, wilcoxon
from tests.made_up_runs import HOLDS, MOVEMENTS, MadeUp

from sgim.claims import Claim, decide
from sgim.claims.claim import Chapter
from sgim.claims.components import Component, Finding, equal, lower, not_higher
from sgim.claims.measures import ANY, Episodes, Error, EvenShare, Share
from sgim.claims.world import World
from sgim.errors import SgimError
from sgim.runs.summary import Openings
from sgim.statistics import equivalence_p, holm, interquartile_mean, not_higher_p
from sgim.streams import Streams

ACTS, RANDOM = Error("sgim-acts"), Error("random")
ALL = Episodes()
SHARE = Share("sgim-acts", Episodes(way="autonomous"))


def found(component: Component, world: World | None = None) -> Finding:
    return component.test(world or HOLDS.world(), Streams(0), [])


def numbers(measure: Error | Share, world: World | None = None) -> np.ndarray:
    return np.array([*(world or HOLDS.world()).values(measure).values()])


def test_learners_are_compared_seed_by_seed_by_the_test_of_wilcoxon() -> None:
    finding = found(lower(ACTS, RANDOM))
    one, other = numbers(ACTS), numbers(RANDOM)
    assert finding.seeds == [*range(12)]
    np.testing.assert_array_equal(finding.one, one)
    np.testing.assert_array_equal(finding.other, other)
    assert finding.p == pytest.approx(wilcoxon(one - other).pvalue)
    assert finding.direction == 1
    ratio = interquartile_mean(one) / interquartile_mean(other)
    assert finding.effect.value == pytest.approx(float(ratio))
    assert finding.effect.low < finding.effect.value < finding.effect.high


def test_learners_with_other_seeds_are_not_paired() -> None:
    runs = [run for run in HOLDS.runs() if run.learner == "sgim-acts"]
    runs += [r for r in replace(HOLDS, seeds=range(20, 28)).runs() if r.learner == "random"]
    groups = {name: [r for r in runs if r.learner == name] for name in ("sgim-acts", "random")}
    world = World("throwing", "modern", MOVEMENTS, groups, ())
    notes: list[str] = []
    finding = lower(ACTS, RANDOM).test(world, Streams(0), notes)
    assert finding.seeds is None
    assert finding.runs == "12, 8"
    assert finding.direction == 1
    expected = mannwhitneyu(finding.one, finding.other, method="exact").pvalue
    assert finding.p == pytest.approx(expected)
    assert "not paired" in notes[0]


def test_what_points_the_other_way_is_no_evidence_however_small_its_p() -> None:
    finding = found(lower(RANDOM, ACTS))
    assert finding.p < 0.01
    assert finding.direction == -1
    assert finding.p_of_claim == 1


def test_at_most_so_many_times_another_is_tested_at_that_multiple() -> None:
    """The total errors are about .0055 and .025: a little more than a fifth."""
    assert found(lower(ACTS, RANDOM, times=0.25)).direction == 1
    assert found(lower(ACTS, RANDOM, times=0.2)).direction == -1
    assert str(lower(ACTS, RANDOM, times=0.25)) == "total error: sgim-acts < 0.25 × random"


def test_a_share_can_be_compared_with_a_constant() -> None:
    finding = found(lower(SHARE, 0.6))
    assert finding.p == pytest.approx(wilcoxon(numbers(SHARE) - 0.6).pvalue)
    assert finding.direction == 1
    assert finding.effect.value == pytest.approx(interquartile_mean(numbers(SHARE)) - 0.6)
    assert found(lower(SHARE, 0.5)).direction == -1
    assert str(lower(SHARE, 0.6)) == "sgim-acts: share of autonomous < 0.6"


def test_equal_errors_differ_by_less_than_a_fifth_of_the_larger() -> None:
    near = HOLDS.but(random=(0.00115, 0.0115)).world()
    finding = found(equal(ACTS, RANDOM), near)
    assert finding.p == equivalence_p(finding.one, finding.other, 0.2, paired=True)
    assert finding.p < 0.01
    assert finding.direction == 1
    for place, throw in ((0.0014, 0.014), (0.0007, 0.007)):
        other = found(equal(ACTS, RANDOM), HOLDS.but(random=(place, throw)).world())
        assert other.direction == -1
        assert other.p > 0.95


def test_equal_shares_differ_by_less_than_ten_points() -> None:
    middle = float(np.median(numbers(SHARE)))
    assert found(equal(SHARE, middle + 0.08)).direction == 1
    assert found(equal(SHARE, middle + 0.08)).p < 0.01
    assert found(equal(SHARE, middle + 0.12)).direction == -1
    assert found(equal(SHARE, middle - 0.12)).direction == -1


def test_not_higher_is_lower_or_within_the_margin() -> None:
    for place, throw, direction in ((0.9, 0.9, 1), (0.0009, 0.009, 1), (0.0007, 0.007, -1)):
        finding = found(not_higher(ACTS, RANDOM), HOLDS.but(random=(place, throw)).world())
        assert finding.direction == direction
        assert finding.p == not_higher_p(finding.one, finding.other, 0.2, paired=True)


def test_runs_without_such_episodes_are_left_out_and_named() -> None:
    runs = HOLDS.runs()
    silent = Openings(np.array([0]), ["autonomous"], ["throw"])
    runs = [replace(r, openings=silent) if r.seed == 3 else r for r in runs]
    acts = [run for run in runs if run.learner == "sgim-acts"]
    share = Share("sgim-acts", Episodes(teacher="T1"), among=Episodes(kind="place"))
    notes: list[str] = []
    world = World("throwing", "modern", MOVEMENTS, {"sgim-acts": acts}, ())
    finding = lower(share, EvenShare("sgim-acts", 2)).test(world, Streams(0), notes)
    assert finding.seeds == [s for s in range(12) if s != 3]
    assert "without seeds 3" in notes[0]


def test_where_no_run_has_such_episodes_nothing_is_shown() -> None:
    share = Share("sgim-acts", Episodes(teacher="T9"), among=Episodes(teacher="T9"))
    claim = Claim("X", "Nobody asks T9.", (lower(share, 0.5),))
    verdicts = decide(Chapter("x", "X", "throwing", (claim,)), HOLDS.world())
    assert verdicts.verdicts[0].word == "not shown"
    assert verdicts.verdicts[0].p == 1
    assert any("no run has both" in note for note in verdicts.notes)


def test_shares_count_the_episodes_of_their_quarter_among_those_meant() -> None:
    modes = ["autonomous", "mimic T1", "emulate T2", "mimic T2", "emulate T1", "autonomous"]
    kinds = ["place", "place", "throw", None, "place", "throw"]
    movements = np.array([0, 999, 1000, 1500, 3000, 3999])
    run = replace(HOLDS.runs()[-1], openings=Openings(movements, modes, kinds))

    def share(counted: Episodes, among: Episodes = ALL, quarter: int | None = None) -> float:
        return Share("sgim-acts", counted, among, quarter).of(run, MOVEMENTS)

    assert share(Episodes(way="autonomous")) == 2 / 6
    assert share(Episodes(way="autonomous"), quarter=1) == 1 / 2
    assert share(Episodes(way="autonomous"), quarter=2) == 0
    assert np.isnan(share(Episodes(way="autonomous"), quarter=3))
    assert share(Episodes(teacher=ANY)) == 4 / 6
    assert share(Episodes(teacher="T1"), Episodes(kind="place")) == 2 / 3
    assert share(Episodes(teacher="T1"), Episodes(kind="place", teacher=ANY)) == 1
    assert share(Episodes(way="mimic"), Episodes(teacher="T2")) == 1 / 2
    assert share(Episodes(way="emulate", kind="place")) == 1 / 6


def test_an_even_share_goes_by_the_teachers_that_there_are() -> None:
    run = MadeUp(teachers=("A", "B")).runs()[-1]
    assert EvenShare("sgim-acts").of(run, MOVEMENTS) == 1 / 5
    assert EvenShare("sgim-acts", 2).of(run, MOVEMENTS) == 2 / 5
    assert EvenShare("sgim-acts", of_teachers=True).of(run, MOVEMENTS) == 1 / 2
    with pytest.raises(SgimError, match="which teachers sgim-acts has"):
        EvenShare("sgim-acts").of(MadeUp(teachers=()).runs()[-1], MOVEMENTS)


def test_an_error_that_was_not_measured_is_named() -> None:
    with pytest.raises(SgimError, match=r"no grasp error at 4000 movements"):
        Error("sgim-acts", "grasp").of(HOLDS.runs()[-1], MOVEMENTS)


def test_a_claim_is_as_sure_as_its_least_sure_component_and_corrected_for_all_claims() -> None:
    near = HOLDS.but(random=(0.00102, 0.0104))
    world = replace(near, scatter=0.05, seeds=range(8)).world()
    sure, unsure = lower(ACTS, Error("mimicry:T1")), lower(ACTS, RANDOM)
    claims = (
        Claim("A", "Both.", (sure, unsure)),
        Claim("B", "Sure.", (sure,)),
        Claim("C", "No runs.", (lower(ACTS, Error("nobody")),)),
        Claim("D", "Otherwise.", (sure, lower(RANDOM, ACTS, times=0.5))),
    )
    a, b, c, d = decide(Chapter("x", "X", "throwing", claims), world).verdicts
    p_sure, p_unsure = found(sure, world).p, found(unsure, world).p
    assert p_sure < p_unsure < 1
    assert (a.p, b.p, c.p, d.p) == (p_unsure, p_sure, None, 1)
    assert [a.p_holm, b.p_holm, d.p_holm] == holm([p_unsure, p_sure, 1])
    assert (a.word, b.word, c.word, d.word) == (
        "not shown",
        "reproduced",
        "no runs",
        "contradicted",
    )
    assert a.deciding.component == unsure
    assert d.deciding.component == claims[3].components[1]
    assert c.needs == ("nobody",)


def test_too_few_seeds_are_said() -> None:
    (claim,) = [Claim("A", "Few.", (lower(ACTS, RANDOM),))]
    chapter = Chapter("x", "X", "throwing", (claim,))
    few = decide(chapter, replace(HOLDS, seeds=range(5)).world())
    assert any("6 seeds or more are needed" in note for note in few.notes)
    assert not decide(chapter, replace(HOLDS, seeds=range(6)).world()).notes
