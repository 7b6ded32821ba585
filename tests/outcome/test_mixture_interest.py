"""Interest by mixtures: goals are drawn where competence grows, or changes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from tests.helpers import report

from sgim.mixtures import GaussianMixture
from sgim.outcome import AbsoluteProgress, InterestMap, MixtureInterest
from sgim.outcome.mixture_interest import Weighting
from sgim.spaces import Box, Choices, FloatArray
from sgim.streams import Streams

LINE = {"place": Box([0.0], [10.0])}
TWO = {"place": Box([0.0], [10.0]), "word": Box([0.0], [1.0])}


def draws(
    interest: InterestMap, modes: Sequence[str] = ("alone",), n: int = 400
) -> tuple[FloatArray, list[str], list[str]]:
    """Points, kinds and modes of n choices."""
    chosen = [interest.choose(np.random.default_rng(i), modes, None) for i in range(n)]
    points = np.array([goal.point[0] for goal, _ in chosen])
    return points, [goal.kind for goal, _ in chosen], [mode for _, mode in chosen]


def practise(interest: InterestMap, episodes: int, *, modes: Sequence[str] = ("alone",)) -> None:
    """Competence grows for goals above 5, by the last of the modes; below it falls a little."""
    rng = np.random.default_rng(0)
    for number in range(episodes):
        mode = modes[number % len(modes)]
        point = 10 * rng.random()
        grows = point > 5 and mode == modes[-1]
        after = -0.8 + (0.6 if grows else -0.1) * number / episodes + 0.02 * rng.random()
        interest.update(report([point], mode, after=after, episode=number))


@pytest.mark.parametrize("weighting", ["covariance", "correlation"])
def test_goals_are_drawn_where_competence_grows(weighting: Weighting) -> None:
    interest = MixtureInterest(LINE, {"alone": 1.0}, Streams(0), every=400, weighting=weighting)
    practise(interest, 400)
    points, _, _ = draws(interest)
    assert (points > 5).mean() > 0.9


def test_without_progress_goals_are_drawn_as_they_were() -> None:
    interest = MixtureInterest(LINE, {"alone": 1.0}, Streams(0), every=400, weighting="none")
    practise(interest, 400)
    points, _, _ = draws(interest)
    assert 0.35 < (points > 5).mean() < 0.65


def test_only_the_latest_episodes_count() -> None:
    interest = MixtureInterest(LINE, {"alone": 1.0}, Streams(0), window=200, every=100)
    practise(interest, 300)
    rng = np.random.default_rng(1)
    for number in range(200):  # Now it grows below 5.
        point = 10 * rng.random()
        after = -0.8 + 0.6 * (point < 5) * number / 200
        interest.update(report([point], after=after))
    points, _, _ = draws(interest)
    assert (points < 5).mean() > 0.9


def test_the_strategy_that_brings_progress_is_chosen_and_only_among_those_present() -> None:
    modes = ("alone", "emulate T")
    interest = MixtureInterest(LINE, dict.fromkeys(modes, 1.0), Streams(0), every=400)
    practise(interest, 400, modes=modes)
    _, _, chosen = draws(interest, modes)
    assert chosen.count("emulate T") > 350
    assert set(draws(interest, ["alone"])[2]) == {"alone"}


def test_one_of_three_modes_is_chosen_for_its_progress_too() -> None:
    modes = ("a", "b", "c")
    for interest in (
        MixtureInterest(LINE, dict.fromkeys(modes, 1.0), Streams(0), every=600),
        AbsoluteProgress(LINE, dict.fromkeys(modes, 1.0), Streams(0), every=600, window=600),
    ):
        practise(interest, 600, modes=modes)
        _, _, chosen = draws(interest, modes)
        assert chosen.count("c") > 200


def test_a_costly_mode_is_chosen_less() -> None:
    shares = []
    for cost in (1.0, 20.0):
        interest = MixtureInterest(LINE, {"a": 1.0, "b": cost}, Streams(0), every=400)
        rng = np.random.default_rng(0)
        for number in range(400):
            after = -0.8 + 0.6 * number / 400
            interest.update(report([10 * rng.random()], "ab"[number % 2], after=after))
        shares.append(draws(interest, ["a", "b"])[2].count("b") / 400)
    assert shares[1] < shares[0] / 2


def test_first_goals_are_what_was_produced_and_anything_if_that_is_not_known() -> None:
    produced = GaussianMixture(np.ones(1), np.array([[0.25]]), np.array([[[1e-4]]]))
    interest = MixtureInterest(LINE, {"alone": 1.0}, Streams(0), produced=lambda kind: produced)
    points, _, _ = draws(interest)
    assert np.abs(points - 2.5).max() < 0.5
    points, _, _ = draws(MixtureInterest(LINE, {"alone": 1.0}, Streams(0)))
    assert points.min() < 0.5
    assert points.max() > 9.5


def test_remedies_mix_in_what_they_promise() -> None:
    modes = {"alone": 1.0, "emulate T": 1.0}

    def made(uniform: float, recent: float, modes_share: float) -> MixtureInterest:
        interest = MixtureInterest(
            LINE,
            modes,
            Streams(0),
            every=400,
            recent=lambda kind: np.array([[0.1]]),
            uniform_share=uniform,
            recent_share=recent,
            recent_noise=0.01,
            random_modes=modes_share,
        )
        practise(interest, 400, modes=tuple(modes))
        return interest

    assert (draws(made(0.5, 0, 0), list(modes))[0] < 5).mean() == pytest.approx(0.25, abs=0.07)
    assert (draws(made(0, 0.3, 0), list(modes))[0] < 2).mean() == pytest.approx(0.3, abs=0.07)
    share = draws(made(0, 0, 0.4), list(modes))[2].count("alone") / 400
    assert share == pytest.approx(0.2, abs=0.07)


def test_kinds_are_chosen_by_their_progress() -> None:
    for interest in (
        MixtureInterest(TWO, {"alone": 1.0}, Streams(0), every=200),
        AbsoluteProgress(TWO, {"alone": 1.0}, Streams(0), every=200, random_share=0.0),
    ):
        rng = np.random.default_rng(0)
        for number in range(200):
            interest.update(report([10 * rng.random()], after=-0.5))
            noisy = -0.9 + 0.8 * number / 200 + 0.3 * rng.random()
            interest.update(report([rng.random()], kind="word", after=noisy))
        _, kinds, _ = draws(interest)
        assert kinds.count("word") > 350


def test_absolute_progress_is_found_where_competence_falls_too() -> None:
    interest = AbsoluteProgress(LINE, {"alone": 1.0}, Streams(0), random_share=0.0)
    rng = np.random.default_rng(0)
    for number in range(500):
        point = 10 * rng.random()
        after = -0.1 - 0.8 * (point > 5) * number / 500 * rng.random()
        interest.update(report([point], after=after))
    points, _, _ = draws(interest)
    assert (points > 5).mean() > 0.8


def test_absolute_progress_draws_anything_as_often_as_said() -> None:
    interest = AbsoluteProgress(LINE, {"alone": 1.0}, Streams(0), random_share=0.4)
    rng = np.random.default_rng(0)
    for number in range(250):
        point = 10 * rng.random()
        interest.update(report([point], after=-0.5 + 0.3 * (point > 5) * (number % 2)))
    points, _, _ = draws(interest, n=1000)
    assert (points < 5).mean() == pytest.approx(0.2, abs=0.08)


def test_spaces_that_are_no_boxes_are_refused() -> None:
    with pytest.raises(TypeError, match="goal spaces that are a Box"):
        MixtureInterest({"word": Choices(["a"])}, {"alone": 1.0}, Streams(0))
    with pytest.raises(TypeError, match="a context space that is a Box"):
        AbsoluteProgress(LINE, {"alone": 1.0}, Streams(0), context_space=Choices(["a"]))
