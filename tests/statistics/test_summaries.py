"""The middle half, the area and the profile are what their definitions say."""

import numpy as np
import pytest
from scipy.stats import ecdf, trim_mean

from sgim.errors import SgimError
from sgim.statistics import area_under_curve, interquartile_mean, performance_profile


def test_the_interquartile_mean_of_a_multiple_of_four_is_scipys_trimmed_mean() -> None:
    values = np.random.default_rng(0).normal(size=(12, 3))
    np.testing.assert_allclose(interquartile_mean(values), trim_mean(values, 0.25, axis=0))
    np.testing.assert_allclose(interquartile_mean(values.T, axis=1), interquartile_mean(values))


@pytest.mark.parametrize(
    ("values", "mean"),
    [
        ([7], 7),
        ([9, 1], 5),
        ([0, 10, 2], (0.25 * 0 + 2 + 0.25 * 10) / 1.5),
        ([1, 2, 3, 4, 100], (0.75 * 2 + 3 + 0.75 * 4) / 2.5),
        ([1, 3, 5, 7, 9, 11, 13, 15, 17], (0.75 * 5 + 7 + 9 + 11 + 0.75 * 13) / 4.5),
    ],
)
def test_values_at_the_quartiles_count_in_part(values: list[float], mean: float) -> None:
    assert interquartile_mean(values) == pytest.approx(mean)


def test_no_values_have_no_interquartile_mean() -> None:
    with pytest.raises(SgimError, match="pass one or more"):
        interquartile_mean([])


def test_the_area_is_the_mean_height_whatever_the_steps() -> None:
    assert area_under_curve([0, 1, 3], [1.0, 0.5, 0.5]) == pytest.approx((0.75 + 2 * 0.5) / 3)
    both = area_under_curve([0, 1000, 2000], [[3, 3, 3], [1, 0, 1]])
    np.testing.assert_allclose(both, [3, 0.5])
    assert area_under_curve([5], [0.25]) == 0.25


def test_an_area_needs_increasing_positions_as_many_as_heights() -> None:
    with pytest.raises(SgimError, match="do not increase"):
        area_under_curve([0, 2, 1], [1, 1, 1])
    with pytest.raises(SgimError, match="expected"):
        area_under_curve([0, 1], [1, 1, 1])


def test_a_profile_is_the_share_of_runs_at_or_under_each_threshold() -> None:
    errors = [0.1, 0.2, 0.2, 0.4]
    np.testing.assert_array_equal(
        performance_profile(errors, [0.05, 0.1, 0.2, 0.3, 1]), [0, 0.25, 0.75, 0.75, 1]
    )
    table = np.array([errors, [1, 1, 1, 1]])
    for axis in (1, -1):
        profiles = performance_profile(table, [0.2, 1], axis=axis)
        np.testing.assert_array_equal(profiles, [[0.75, 1], [0, 1]])


def test_the_area_of_a_fine_curve_is_its_integral() -> None:
    x = np.linspace(0, 2, 2001)
    np.testing.assert_allclose(area_under_curve(x, np.exp(-x)), (1 - np.exp(-2)) / 2, rtol=1e-6)
    uneven = np.geomspace(1, 10, 3001)
    np.testing.assert_allclose(area_under_curve(uneven, 1 / uneven), np.log(10) / 9, rtol=1e-6)


def test_a_profile_is_scipys_empirical_distribution() -> None:
    errors = np.random.default_rng(0).lognormal(size=23)
    thresholds = np.linspace(0, 4, 50)
    expected = ecdf(errors).cdf.evaluate(thresholds)
    np.testing.assert_allclose(performance_profile(errors, thresholds), expected)


def test_the_median_is_where_a_profile_passes_half() -> None:
    errors = np.random.default_rng(1).normal(5, 1, 41)
    at = np.median(errors)
    before, there = performance_profile(errors, [at - 1e-9, at])
    assert before < 0.5 < there
