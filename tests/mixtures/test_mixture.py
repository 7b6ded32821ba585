"""Mixtures: densities, marginals, draws; whatever the data, numbers stay finite."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import multivariate_normal

from sgim.mixtures import (
    Conditional,
    GaussianMixture,
    fit,
    fit_by_criterion,
    split_starved,
    updated,
)
from sgim.mixtures.incremental import falling_rate
from sgim.mixtures.selection import criterion
from sgim.spaces import FloatArray


def made_up(rng: np.random.Generator, k: int = 3, d: int = 4) -> GaussianMixture:
    halves = rng.standard_normal((k, d, d))
    covariances = halves @ np.swapaxes(halves, 1, 2) + 0.1 * np.eye(d)
    return GaussianMixture(rng.random(k) + 0.1, 2 * rng.standard_normal((k, d)), covariances)


def scipy_logs(mixture: GaussianMixture, data: FloatArray) -> FloatArray:
    parts = zip(mixture.weights, mixture.means, mixture.covariances, strict=True)
    return np.column_stack(
        [np.log(w) + multivariate_normal(m, c).logpdf(data) for w, m, c in parts]
    )


def test_densities_are_those_of_scipy() -> None:
    rng = np.random.default_rng(0)
    mixture, data = made_up(rng), rng.standard_normal((50, 4))
    logs = scipy_logs(mixture, data)
    np.testing.assert_allclose(mixture.log_parts(data), logs, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(mixture.shares(data).sum(axis=1), 1.0)
    likelihood = np.log(np.exp(logs).sum(axis=1)).mean()
    assert mixture.log_likelihood(data) == pytest.approx(likelihood)


def test_a_marginal_has_the_means_and_covariances_of_its_coordinates() -> None:
    mixture = made_up(np.random.default_rng(1))
    marginal = mixture.marginal([2, 0])
    np.testing.assert_array_equal(marginal.means, mixture.means[:, [2, 0]])
    np.testing.assert_array_equal(marginal.covariances[:, 0, 1], mixture.covariances[:, 2, 0])


def test_draws_follow_the_mixture() -> None:
    mixture = made_up(np.random.default_rng(2))
    points = mixture.sample(np.random.default_rng(3), 200_000)
    mean = mixture.weights @ mixture.means
    offsets = mixture.means - mean
    spread = np.einsum("k,kij->ij", mixture.weights, mixture.covariances)
    spread += np.einsum("k,ki,kj->ij", mixture.weights, offsets, offsets)
    np.testing.assert_allclose(points.mean(axis=0), mean, atol=0.03)
    np.testing.assert_allclose(np.cov(points, rowvar=False), spread, atol=0.15)


def test_a_conditional_is_what_bayes_gives() -> None:
    rng = np.random.default_rng(4)
    mixture = made_up(rng)
    conditional = Conditional(mixture, 2)
    points = rng.standard_normal((5, 2))
    densities = np.exp(scipy_logs(mixture.marginal([0, 1]), points))
    shares = densities / densities.sum(axis=1, keepdims=True)
    np.testing.assert_allclose(conditional.shares(points), shares, rtol=1e-9)
    for k in range(3):
        covariance = mixture.covariances[k]
        gain = covariance[2:, :2] @ np.linalg.inv(covariance[:2, :2])
        centre = mixture.means[k, 2:] + (points - mixture.means[k, :2]) @ gain.T
        chosen = np.full(5, k)
        np.testing.assert_allclose(conditional.centres(points, chosen), centre, rtol=1e-9)
        spread = covariance[2:, 2:] - gain @ covariance[:2, 2:]
        factor = conditional.factors[k]
        np.testing.assert_allclose(factor @ factor.T, spread, rtol=1e-9, atol=1e-12)


@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.integers(1, 8), st.integers(1, 20))
@settings(max_examples=30, deadline=None)
def test_a_draw_is_the_same_to_the_last_bit_whatever_is_drawn_with_it(
    seed: int, k: int, g: int, others: int
) -> None:
    rng = np.random.default_rng(seed)
    conditional = Conditional(made_up(rng, k, g + others), g)
    points, picks = rng.standard_normal((23, g)), rng.random(23)
    normals = rng.standard_normal((23, others))
    together = conditional.draw(points, picks, normals)
    for size in (1, 5):
        pieces = [slice(i, i + size) for i in range(0, 23, size)]
        apart = [conditional.draw(points[s], picks[s], normals[s]) for s in pieces]
        assert np.array_equal(np.concatenate(apart), together)


def test_classical_em_finds_clusters_that_lie_apart() -> None:
    rng = np.random.default_rng(5)
    centres = np.array([[0.0, 0.0], [5.0, 0.0], [0.0, 5.0]])
    data = np.concatenate([c + 0.3 * rng.standard_normal((200, 2)) for c in centres])
    mixture = fit(data, 3, np.random.default_rng(0))
    order = np.lexsort(mixture.means.round().T)
    np.testing.assert_allclose(mixture.means[order], centres, atol=0.1)
    np.testing.assert_allclose(mixture.weights, 1 / 3, atol=0.01)
    np.testing.assert_allclose(mixture.covariances[0], 0.09 * np.eye(2), atol=0.03)


def test_more_sweeps_never_make_a_fit_less_likely() -> None:
    rng = np.random.default_rng(6)
    data = rng.random((300, 3)) ** 2
    likelihoods = [
        fit(data, 5, np.random.default_rng(0), sweeps=n, floor=1e-9, tolerance=0).log_likelihood(
            data
        )
        for n in range(8)
    ]
    assert np.all(np.diff(likelihoods) > -1e-9)


def test_akaike_takes_as_many_components_as_there_are_clusters() -> None:
    rng = np.random.default_rng(7)
    data = np.concatenate([c + 0.2 * rng.standard_normal((80, 2)) for c in (0, 3, 6, 9)])
    mixture = fit_by_criterion(data, range(1, 8), np.random.default_rng(0))
    assert mixture.components == 4
    assert criterion(mixture, data) < criterion(fit(data, 2, np.random.default_rng(0)), data)


def test_an_update_with_one_component_is_a_weighted_mean() -> None:
    rng = np.random.default_rng(8)
    old, data = made_up(rng, 1, 3), rng.standard_normal((100, 3)) + 1
    new = updated(old, data, 0.25, floor=0.0)
    mean = 0.75 * old.means[0] + 0.25 * data.mean(axis=0)
    between = old.means[0] - mean
    offsets = data - mean
    spread = 0.75 * (old.covariances[0] + np.outer(between, between))
    spread += 0.25 * offsets.T @ offsets / 100
    np.testing.assert_allclose(new.means[0], mean)
    np.testing.assert_allclose(new.covariances[0], spread)


def test_updates_follow_data_that_move_and_remember_by_the_rate() -> None:
    rng = np.random.default_rng(9)
    mixture = fit(rng.standard_normal((400, 2)), 4, rng)
    kept, moved = mixture, mixture
    for _ in range(30):
        data = rng.standard_normal((400, 2)) + 5
        kept, moved = updated(kept, data, 0.001), updated(moved, data, 0.2)
    assert kept.weights @ kept.means[:, 0] == pytest.approx(5 * (1 - 0.999**30), abs=0.1)
    assert moved.weights @ moved.means[:, 0] == pytest.approx(5, abs=0.1)


def test_the_rate_falls_logarithmically_and_then_stays() -> None:
    rates = [falling_rate(done, 0.1, 0.01) for done in (0, 0.5, 1, 2)]
    np.testing.assert_allclose(rates, [0.1, np.sqrt(0.1 * 0.01), 0.01, 0.01])


def test_a_starved_component_gets_half_of_the_heaviest_and_the_whole_stays_as_it_was() -> None:
    rng = np.random.default_rng(10)
    whole = made_up(rng, 3, 2)
    starved = whole.reweighted(np.array([0.7, 0.3, 1e-6]))
    split = split_starved(starved, 0.002)
    np.testing.assert_allclose(split.weights, [0.35, 0.3, 0.35], atol=1e-5)
    np.testing.assert_allclose((split.means[0] + split.means[2]) / 2, whole.means[0])
    offset = (split.means[0] - split.means[2]) / 2
    together = split.covariances[0] + np.outer(offset, offset)
    np.testing.assert_allclose(together, whole.covariances[0])
    assert split_starved(whole, 1e-9).weights.tolist() == whole.weights.tolist()


DATA = st.sampled_from(["constant", "constant with outliers", "few", "a line", "huge", "normal"])


def data_of(sort: str, rng: np.random.Generator, d: int) -> FloatArray:
    n = 2 if sort == "few" else 60
    data = rng.standard_normal((n, d))
    if sort.startswith("constant"):
        data[:] = 0.3
    if sort == "constant with outliers":
        data[:2] = 9.0
    if sort == "a line":
        data = np.outer(rng.standard_normal(n), np.ones(d))
    return data * 1e6 if sort == "huge" else data


@given(st.lists(DATA, min_size=2, max_size=6), st.integers(2, 7), st.integers(0, 1000))
@settings(max_examples=60, deadline=None)
def test_no_data_and_no_goal_make_a_draw_that_is_not_finite(
    sorts: list[str], d: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    mixture = fit(data_of(sorts[0], rng, d), 8, rng, sweeps=10)
    for sort in sorts[1:]:
        mixture = updated(mixture, data_of(sort, rng, d), 0.1)
        if seed % 2:
            mixture = split_starved(mixture, 0.002)
    assert np.isfinite(mixture.log_likelihood(data_of("normal", rng, d)))
    np.linalg.cholesky(mixture.covariances)
    conditional = Conditional(mixture, d - 1)
    goals = np.array([[x] * (d - 1) for x in (0.0, 0.3, -7.0, 1e9, -1e80, 1e100)])
    drawn = conditional.draw(goals, rng.random(6), rng.standard_normal((6, 1)))
    assert np.isfinite(drawn).all()
    np.testing.assert_allclose(conditional.shares(goals).sum(axis=1), 1.0)


def test_what_is_no_mixture_is_refused() -> None:
    mixture = made_up(np.random.default_rng(0))
    with pytest.raises(ValueError, match=r"shapes \(2,\), \(3, 4\)"):
        GaussianMixture(np.ones(2), mixture.means, mixture.covariances)
    with pytest.raises(ValueError, match="positive weights"):
        mixture.reweighted(np.zeros(3))
