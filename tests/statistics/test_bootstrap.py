"""Bootstrap intervals hold what they should, about as often as they say."""

import numpy as np
import pytest
from scipy.stats import bootstrap

from sgim.statistics import bootstrap as module
from sgim.statistics import (
    bootstrap_interval,
    interquartile_estimate,
    interquartile_mean,
    profile_estimate,
)


def mean(strata):
    return strata[0].mean(axis=1)


def test_an_interval_is_about_scipys() -> None:
    values = np.random.default_rng(1).normal(size=25)
    mine = bootstrap_interval([values], mean, np.random.default_rng(2), resamples=20_000)
    its = bootstrap(
        (values,), np.mean, n_resamples=20_000, method="percentile", rng=np.random.default_rng(3)
    ).confidence_interval
    np.testing.assert_allclose(mine, its, atol=0.015)


@pytest.mark.parametrize("skewed", [False, True])
def test_intervals_of_the_interquartile_mean_cover_it_about_as_often_as_they_say(
    skewed: bool,
) -> None:
    rng = np.random.default_rng(4)

    def draw(*shape: int) -> np.ndarray:
        return rng.lognormal(size=shape) if skewed else rng.normal(size=shape)

    truth = interquartile_mean(draw(1_000_000))
    tries = 600
    found = [interquartile_estimate(draw(20), rng, resamples=800) for _ in range(tries)]
    covered = np.mean([e.low <= truth <= e.high for e in found])
    # Percentile intervals of 20 runs are known to be a little narrow.
    assert 0.89 <= covered <= 0.98


def test_a_lower_level_is_covered_less_often() -> None:
    rng = np.random.default_rng(5)
    found = [
        interquartile_estimate(rng.normal(size=40), rng, resamples=500, level=0.5)
        for _ in range(500)
    ]
    assert 0.43 <= np.mean([e.low <= 0 <= e.high for e in found]) <= 0.57


def test_strata_are_resampled_within_themselves() -> None:
    low, high = np.zeros(5), np.full(7, 10.0)

    def pooled(strata):
        assert [s.shape[1] for s in strata] == [5, 7]
        return np.concatenate(strata, axis=1).mean(axis=1)

    interval = bootstrap_interval([low, high], pooled, np.random.default_rng(0))
    np.testing.assert_allclose(interval, 70 / 12)  # nothing varies between resamples


def test_what_belongs_together_stays_together() -> None:
    one = np.random.default_rng(0).normal(size=15)
    pairs = np.stack([one + 2, one], axis=1)
    interval = bootstrap_interval(
        [pairs], lambda s: (s[0][..., 0] - s[0][..., 1]).mean(axis=1), np.random.default_rng(1)
    )
    np.testing.assert_allclose(interval, 2)


def test_curves_have_an_interval_at_each_point_however_they_are_cut_up(monkeypatch) -> None:
    runs = np.random.default_rng(0).normal(size=(8, 5)) + np.arange(5)
    whole = interquartile_estimate(runs, np.random.default_rng(1))
    assert whole.value.shape == whole.low.shape == whole.high.shape == (5,)
    assert (whole.low < whole.value).all()
    assert (whole.value < whole.high).all()
    monkeypatch.setattr(module, "_NUMBERS_AT_ONCE", 999)
    parts = interquartile_estimate(runs, np.random.default_rng(1))
    np.testing.assert_array_equal(parts.low, whole.low)


def test_the_interval_of_a_profile_is_that_of_a_share() -> None:
    errors = np.array([0.0] * 12 + [1.0] * 18)
    found = profile_estimate(errors, np.array([-1, 0.5, 1.0]), np.random.default_rng(0))
    np.testing.assert_array_equal(found.value, [0, 0.4, 1])
    # 95 % of the draws of 30 with a chance of .4 are from 7 to 17.
    np.testing.assert_allclose(found.low, [0, 7 / 30, 1], atol=1.01 / 30)
    np.testing.assert_allclose(found.high, [0, 17 / 30, 1], atol=1.01 / 30)


def test_the_same_generator_gives_the_same_interval() -> None:
    runs = np.random.default_rng(0).normal(size=9)
    one, same, other = (interquartile_estimate(runs, np.random.default_rng(s)) for s in (1, 1, 2))
    assert one == same
    assert one.low != other.low


def test_one_run_has_a_value_but_no_interval() -> None:
    found = interquartile_estimate(np.array([[0.5, 0.25]]), np.random.default_rng(0))
    np.testing.assert_array_equal(found.value, [0.5, 0.25])
    assert found.as_json() == {"value": [0.5, 0.25], "low": [None, None], "high": [None, None]}
