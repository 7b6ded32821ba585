"""P-values are those of SciPy where it has exact ones, and right where it has none."""

from itertools import product

import numpy as np
import pytest
from scipy.stats import mannwhitneyu, wilcoxon

from sgim.errors import SgimError
from sgim.statistics import (
    equivalence_p,
    holm,
    least_pairs,
    mann_whitney_p,
    not_higher_p,
    probability_lower,
    rank_biserial,
    signed_rank_p,
)

DARWIN = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48]
"""Differences in height of Darwin's crossed and self-fertilised maize, in eighths of an inch."""


def test_the_signed_rank_test_of_darwins_maize() -> None:
    assert signed_rank_p(DARWIN) == pytest.approx(0.04126, abs=5e-6)
    assert signed_rank_p(DARWIN, "greater") == pytest.approx(0.02063, abs=5e-6)


@pytest.mark.parametrize("n", [3, 6, 20, 60, 90])
@pytest.mark.parametrize("alternative", ["two-sided", "greater"])
def test_the_signed_rank_test_is_scipys_without_ties(n: int, alternative) -> None:
    differences = np.random.default_rng(n).normal(0.3, 1, n)
    method = "exact" if n <= 60 else "approx"
    its = wilcoxon(differences, alternative=alternative, method=method).pvalue
    assert signed_rank_p(differences, alternative) == pytest.approx(its, rel=1e-9)


@pytest.mark.parametrize("differences", [[1, 1, -1, 2, 2, 3], [1, 1, 1, 1], [-2, 1, 1, 0, 0]])
def test_the_signed_rank_test_is_exact_with_ties_and_zeros(differences: list[int]) -> None:
    found = np.array([d for d in differences if d])
    ranks = np.array([(np.abs(found) < a).sum() + (np.abs(found) == a).sum() for a in abs(found)])
    ranks = ranks - np.array([((np.abs(found) == a).sum() - 1) / 2 for a in abs(found)])
    flipped = [ranks @ np.array(s) for s in product([0, 1], repeat=len(found))]
    expected = np.mean(np.array(flipped) >= ranks @ (found > 0) - 1e-9)
    assert signed_rank_p(differences, "greater") == pytest.approx(expected)


def test_no_difference_at_all_has_p_of_one() -> None:
    assert signed_rank_p([0.0, 0.0, 0.0]) == 1
    assert mann_whitney_p([2, 2, 2], [2, 2]) == 1
    assert mann_whitney_p([2] * 40, [2] * 40) == 1


@pytest.mark.parametrize(("n", "m"), [(1, 1), (3, 5), (12, 20), (40, 40)])
@pytest.mark.parametrize("alternative", ["two-sided", "greater"])
def test_the_rank_sum_test_is_scipys_without_ties(n: int, m: int, alternative) -> None:
    rng = np.random.default_rng(n)
    one, other = rng.normal(0.4, 1, n), rng.normal(0, 1, m)
    method = "exact" if n + m <= 60 else "asymptotic"
    its = mannwhitneyu(one, other, alternative=alternative, method=method).pvalue
    assert mann_whitney_p(one, other, alternative) == pytest.approx(its, rel=1e-9)


def test_the_rank_sum_test_is_exact_with_ties() -> None:
    # Three of three, apart: 2 of the 20 ways to share six out; the normal curve says .047.
    assert mann_whitney_p([1, 1, 1], [0, 0, 0]) == pytest.approx(0.1)
    assert mann_whitney_p([1, 1, 1], [0, 0, 0], "greater") == pytest.approx(0.05)


def test_the_rank_sum_test_needs_runs_on_both_sides() -> None:
    with pytest.raises(SgimError, match="one run or more"):
        mann_whitney_p([], [1.0])


@pytest.mark.parametrize("test", ["paired", "unpaired"])
def test_p_values_under_no_difference_are_seldom_small(test: str) -> None:
    rng = np.random.default_rng(0)
    samples = rng.integers(0, 6, (2000, 2, 12)).astype(float)  # with many ties
    if test == "paired":
        found = [signed_rank_p(a - b) for a, b in samples]
    else:
        found = [mann_whitney_p(a, b) for a, b in samples]
    assert 0.02 <= np.mean(np.array(found) <= 0.05) <= 0.06


def test_holm_by_hand_as_statsmodels_has_it() -> None:
    np.testing.assert_allclose(holm([0.01, 0.04, 0.03, 0.005]), [0.03, 0.06, 0.06, 0.02])
    np.testing.assert_allclose(holm([0.5, 0.6, 0.001]), [1.0, 1.0, 0.003])
    assert holm([]) == []
    assert holm([0.03]) == [0.03]


@pytest.mark.parametrize(("paired", "n"), [(True, 12), (False, 12)])
def test_what_is_close_is_equivalent_and_what_is_not_is_not(paired: bool, n: int) -> None:
    rng = np.random.default_rng(0)
    one = rng.normal(10, 0.5, n)
    assert equivalence_p(one, rng.normal(10, 0.5, n), paired=paired) < 0.01
    assert equivalence_p(one, rng.normal(13, 0.5, n), paired=paired) > 0.5
    assert equivalence_p(rng.normal(10, 8, n) ** 2, one**2, paired=paired) > 0.05  # who knows


def test_equal_runs_are_as_equivalent_as_their_number_can_show() -> None:
    assert equivalence_p([1.0] * 5, [1.0] * 5, paired=True) == pytest.approx(2**-5)


def test_the_margin_is_of_the_larger_whichever_that_is() -> None:
    one, other = np.linspace(0.99, 1.01, 10), np.linspace(0.81, 0.83, 10)
    assert equivalence_p(one, other, 0.2, paired=True) < 0.01
    assert equivalence_p(one, other, 0.2, paired=True) == equivalence_p(
        other, one, 0.2, paired=True
    )
    assert equivalence_p(one, other, 0.15, paired=True) > 0.9
    assert equivalence_p(1000 * one, 1000 * other, 0.2, paired=True) < 0.01


def test_an_absolute_margin_is_in_the_units_of_the_values() -> None:
    one, other = np.linspace(-0.1, 0.1, 10), np.linspace(-0.05, 0.15, 10)
    assert equivalence_p(one, other, 0.1, paired=True, relative=False) < 0.01
    assert equivalence_p(one, other, 0.04, paired=True, relative=False) > 0.9


@pytest.mark.parametrize("paired", [True, False])
def test_at_the_margin_equivalence_is_claimed_in_one_case_of_twenty_at_most(paired: bool) -> None:
    rng = np.random.default_rng(1)
    found = [
        equivalence_p(rng.normal(10, 1, 12), rng.normal(8, 0.8, 12), paired=paired)
        for _ in range(1500)
    ]
    assert np.mean(np.array(found) <= 0.05) <= 0.065


def test_a_margin_or_values_that_make_no_sense_are_refused() -> None:
    for margin in (0.0, 1.0, -0.2):
        with pytest.raises(SgimError, match="more than 0, a share below 1"):
            equivalence_p([1.0], [1.0], margin, paired=True)
    with pytest.raises(SgimError, match="relative=False"):
        equivalence_p([-1.0], [1.0], paired=True)


def test_six_pairs_are_the_fewest_that_can_show_a_difference_and_more_for_more_tests() -> None:
    assert least_pairs(1) == 6
    assert signed_rank_p(range(1, 6)) > 0.05 > signed_rank_p(range(1, 7))
    assert least_pairs(4) == 8
    assert max(holm([signed_rank_p(range(1, 9))] * 4)) < 0.05 < 4 * signed_rank_p(range(1, 8))


def test_effect_sizes_by_hand() -> None:
    assert rank_biserial([1, 2, 3]) == 1
    assert rank_biserial([-1, -2]) == -1
    assert rank_biserial([0, 0]) == 0
    assert rank_biserial([1, -2, 3, 0]) == pytest.approx((1 - 2 + 3) / 6)
    assert probability_lower([1, 2], [2, 3], paired=False) == pytest.approx(3.5 / 4)
    assert probability_lower([1, 3], [2, 3], paired=True) == pytest.approx(0.75)


@pytest.mark.parametrize("paired", [True, False])
def test_not_to_be_higher_is_to_be_lower_or_higher_by_less_than_the_margin(paired: bool) -> None:
    other = np.linspace(1.0, 1.1, 12)
    for factor, shown in ((0.1, True), (1.0, True), (1.12, True), (1.4, False)):
        p = not_higher_p(factor * other, other, paired=paired)
        assert (p < 0.01) == shown
    assert not_higher_p(other + 0.05, other, 0.2, paired=paired, relative=False) < 0.01
    assert not_higher_p(other + 0.35, other, 0.2, paired=paired, relative=False) > 0.99


def test_a_margin_that_cannot_be_is_refused() -> None:
    with pytest.raises(SgimError, match="a share below 1"):
        not_higher_p([1.0], [1.0], 1.2, paired=True)
    with pytest.raises(SgimError, match="pass relative=False"):
        not_higher_p([1.0], [-1.0], paired=True)
