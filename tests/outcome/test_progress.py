"""Progress and interest against the thesis's equations, reckoned by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.helpers import report

from sgim.outcome.progress import CompetenceChange, MeanProgress, Record


def with_progress(*values: float) -> list[Record]:
    return [Record((0.5,), value, -1.0) for value in values]


def with_competence(*values: float) -> list[Record]:
    return [Record((0.5,), 0.0, value) for value in values]


def test_progress_is_twice_a_logistic_minus_one_of_the_gain_per_size_and_movement() -> None:
    measure = MeanProgress({"place": 6.0}, scale=1000.0)
    x = 1000.0 * (-0.47 - -0.5) / (6.0 * 20)
    progress = measure.progress(report([0.5], before=-0.5, after=-0.47, movements=20))
    assert progress == pytest.approx(2 / (1 + math.exp(-x)) - 1, rel=1e-12)
    assert progress == pytest.approx(0.124353, abs=1e-6)


def test_progress_is_positive_when_competence_grew_and_odd() -> None:
    measure = MeanProgress({"place": 1.0}, scale=10.0)
    gained = measure.progress(report([0.5], before=-0.5, after=-0.4))
    lost = measure.progress(report([0.5], before=-0.4, after=-0.5))
    assert gained == pytest.approx(-lost)
    assert gained > 0
    assert measure.progress(report([0.5], before=-0.4, after=-0.4)) == 0.0


@given(st.floats(-1, 0), st.floats(-1, 0), st.integers(1, 100), st.floats(1e-3, 1e3))
def test_progress_stays_within_one_whatever_the_scale(
    before: float, after: float, movements: int, size: float
) -> None:
    measure = MeanProgress({"place": size}, scale=1e6)
    episode = report([0.5], before=before, after=after, movements=movements)
    assert -1.0 <= measure.progress(episode) <= 1.0


def test_the_size_is_that_of_the_kind_pursued() -> None:
    measure = MeanProgress({"place": 1.0, "throw": 6.0}, scale=1.0)
    thrown = report([0.5], kind="throw", before=-0.6, after=0.0)
    placed = report([0.5], before=-0.1, after=0.0)
    assert measure.progress(thrown) == pytest.approx(measure.progress(placed))


def test_interest_is_the_mean_of_the_last_progress_values() -> None:
    measure = MeanProgress({"place": 1.0}, window=3)
    assert measure.interest(with_progress(0.9, 0.1, 0.2, 0.6)) == pytest.approx(0.3)
    assert measure.interest(with_progress(0.1, 0.2)) == pytest.approx(0.15)
    assert measure.interest([]) == 0.0


def test_a_change_of_competence_is_that_of_the_halves_of_the_window() -> None:
    measure = CompetenceChange(window=4)
    # |(−0.8 − 0.6) − (−0.5 − 0.3)| / 4; what is older than the window does not count.
    records = with_competence(-1.0, -0.9, -0.8, -0.6, -0.5, -0.3)
    assert measure.interest(records) == pytest.approx(0.6 / 4)


def test_a_loss_of_competence_is_as_interesting_as_a_gain() -> None:
    measure = CompetenceChange(window=4)
    gained = with_competence(-0.8, -0.6, -0.5, -0.3)
    assert measure.interest(gained[::-1]) == pytest.approx(measure.interest(gained))


def test_with_fewer_records_than_the_window_the_halves_are_equal_and_use_what_there_is() -> None:
    measure = CompetenceChange(window=20)
    assert measure.interest([]) == 0.0
    assert measure.interest(with_competence(-0.7)) == 0.0
    assert measure.interest(with_competence(-0.7, -0.3)) == pytest.approx(0.4 / 2)
    # Of three, the oldest is left out.
    assert measure.interest(with_competence(0.0, -0.7, -0.3)) == pytest.approx(0.4 / 2)
    four = with_competence(-0.8, -0.6, -0.5, -0.3)
    assert measure.interest(four) == pytest.approx(0.6 / 4)
    assert measure.interest(with_competence(0.0, -0.8, -0.6, -0.5, -0.3)) == pytest.approx(0.6 / 4)


@given(st.lists(st.floats(-1, 0), max_size=50))
def test_constant_shifts_of_competence_do_not_change_the_interest(values: list[float]) -> None:
    measure = CompetenceChange(window=10)
    shifted = measure.interest(with_competence(*(v - 3.0 for v in values)))
    assert measure.interest(with_competence(*values)) == pytest.approx(shifted, abs=1e-12)


def test_progress_of_an_episode_is_the_competence_gained() -> None:
    episode = report([0.5], before=-0.5, after=-0.2, movements=20)
    assert CompetenceChange().progress(episode) == pytest.approx(0.3)


@pytest.mark.parametrize("window", [0, 1, 3, -2])
def test_a_window_must_have_two_halves(window: int) -> None:
    with pytest.raises(ValueError, match="expected an even number of 2 or more"):
        CompetenceChange(window=window)
