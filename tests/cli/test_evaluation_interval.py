"""How often a run is evaluated when nobody says."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.experiments.experiment import evaluation_interval


@pytest.mark.parametrize(
    ("movements", "every"),
    [(8000, 1000), (10000, 1000), (4000, 1000), (1500, 375), (400, 100), (250, 50), (1, 1)],
)
def test_the_last_evaluation_is_at_the_end_where_that_is_possible(
    movements: int, every: int
) -> None:
    assert evaluation_interval(movements) == every


@given(st.integers(1, 10**6))
def test_a_run_is_evaluated_four_times_or_more_and_every_thousand_movements(movements: int) -> None:
    every = evaluation_interval(movements)
    assert 1 <= every <= 1000
    assert every <= max(1, movements // 4)
    assert movements // every <= 2 * max(4, movements // 1000 + 1)
