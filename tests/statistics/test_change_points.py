"""Stages are found where a series changes."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.errors import SgimError
from sgim.spaces import FloatArray
from sgim.statistics import stages


def steps(*parts: tuple[int, float]) -> FloatArray:
    return np.repeat([value for _, value in parts], [count for count, _ in parts])[:, None]


def rms(values: FloatArray, edges: list[int]) -> float:
    squares = sum(
        ((values[a:b] - values[a:b].mean(axis=0)) ** 2).sum() for a, b in itertools.pairwise(edges)
    )
    return float(np.sqrt(squares / len(values)))


def test_sharp_steps_are_found() -> None:
    series = steps((10, 0.0), (25, 1.0), (5, 0.4))
    noise = np.random.default_rng(0).normal(0, 0.03, series.shape)
    assert stages(series + noise, tolerance=0.1, most=5) == [0, 10, 35, 40]


def test_what_hardly_changes_is_one_stage() -> None:
    noise = np.random.default_rng(0).normal(0.5, 0.05, (60, 3))
    assert stages(noise, tolerance=0.1, most=4) == [0, 60]


def test_no_more_stages_than_allowed_and_none_too_short() -> None:
    ramp = np.linspace(0, 10, 60)[:, None]
    assert len(stages(ramp, tolerance=0.01, most=4)) == 5
    edges = stages(np.random.default_rng(0).normal(size=(20, 2)), tolerance=0.0, most=9, shortest=4)
    assert min(np.diff(edges)) >= 4
    assert edges[-1] == 20


@given(st.integers(0, 1000), st.integers(1, 3))
def test_no_other_cut_into_as_many_stages_scatters_less(seed: int, shortest: int) -> None:
    values = np.random.default_rng(seed).normal(size=(9, 2)).cumsum(axis=0)
    edges = stages(values, tolerance=0.0, most=3, shortest=shortest)
    k = len(edges) - 1
    others = [
        [0, *inner, 9]
        for inner in itertools.combinations(range(1, 9), k - 1)
        if min(np.diff([0, *inner, 9])) >= shortest
    ]
    assert rms(values, edges) == pytest.approx(min(rms(values, other) for other in others))


def test_too_few_windows_are_refused() -> None:
    with pytest.raises(SgimError, match="2 windows cannot be cut into stages of 3"):
        stages(np.zeros((2, 1)), tolerance=0.1, most=2, shortest=3)
