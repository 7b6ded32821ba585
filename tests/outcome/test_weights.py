"""Block sums draw as a sum over the whole table would."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.outcome.weights import BlockSums


def filled(table: np.ndarray) -> BlockSums:  # type: ignore[type-arg]
    sums = BlockSums()
    for row in range(len(table)):
        sums.refresh(table[: row + 1], row)
    return sums


@given(st.integers(1, 200), st.integers(1, 4), st.integers(0, 99), st.floats(0, 0.999999))
def test_a_draw_is_the_one_of_the_whole_table(
    rows: int, columns: int, seed: int, pick: float
) -> None:
    table = np.random.default_rng(seed).integers(0, 1000, (rows, columns)) / 8.0
    weights = (table - table.min()).ravel()
    row, column = filled(table).draw(table, pick)
    place = row * columns + column
    if weights.sum() > 0:
        before = weights[:place].sum()
        assert before <= pick * weights.sum() + 1e-6
        assert pick * weights.sum() <= before + weights[place] + 1e-6
    assert 0 <= row < rows


def test_a_changed_row_is_drawn_by_its_new_value() -> None:
    table = np.zeros((150, 2))
    sums = filled(table)
    table[130, 1] = 1.0
    sums.refresh(table, 130)
    assert {sums.draw(table, pick) for pick in np.linspace(0, 0.99, 20)} == {(130, 1)}
    table[130, 1], table[3, 0] = 0.0, 2.0
    sums.refresh(table, 130)
    sums.refresh(table, 3)
    assert {sums.draw(table, pick) for pick in np.linspace(0, 0.99, 20)} == {(3, 0)}


def test_equal_values_are_drawn_alike() -> None:
    table = np.full((100, 3), 0.3)
    sums = filled(table)
    drawn = {sums.draw(table, pick) for pick in (np.arange(300) + 0.5) / 300}
    assert len(drawn) == 300


@pytest.mark.parametrize("pick", [0.0, 0.9999999999999999])
def test_the_ends_of_the_range_are_within_the_table(pick: float) -> None:
    table = np.random.default_rng(0).random((65, 7))
    row, column = filled(table).draw(table, pick)
    assert row < 65
    assert column < 7
