"""Formants: against closed forms, a dense eigenvalue solver, and what men's vowels are."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq

from sgim.environments.vocal.anatomy import ADULT
from sgim.environments.vocal.articulations import (
    CORNERS,
    VOWELS,
    articulations,
    formants_of,
)
from sgim.environments.vocal.formants import RANGES, SPEED_OF_SOUND, formants, ladder
from sgim.environments.vocal.geometry import SECTIONS, Tube, contours, tube
from sgim.spaces import FloatArray


def cylinders(areas: list[float], lengths: list[float], sections: int = 60) -> Tube:
    """Tubes one behind another, each cut into so many sections."""
    each = np.repeat(areas, sections)[:, None]
    return Tube(each, np.repeat(np.array(lengths) / sections, sections)[:, None])


def dense(shape: Tube, wall_mass: float = 1.5) -> FloatArray:
    """All resonances in Hz by NumPy's solver for symmetric matrices, shape ``(m, n)``."""
    diagonal, beside = ladder(shape, wall_mass)
    found = []
    for entries, squares in zip(diagonal.T, beside.T, strict=True):
        matrix = np.diag(entries) + np.diag(np.sqrt(squares), 1) + np.diag(np.sqrt(squares), -1)
        found.append(np.sqrt(np.linalg.eigvalsh(matrix)) / (2 * np.pi))
    return np.array(found).T


def radiated(area: float) -> float:
    """By how much the radiated wave lengthens a tube, in cm."""
    return 8 * np.sqrt(area / np.pi) / (3 * np.pi)


def random_tube(count: int, seed: int = 0) -> Tube:
    """Tubes of random articulations that are open."""
    positions = np.random.default_rng(seed).uniform(-3, 3, (7, 3 * count))
    shape = contours(ADULT, positions)
    opened = np.flatnonzero(shape.opening > 0)[:count]
    assert len(opened) == count
    found = tube(ADULT, positions, shape)
    return Tube(found.areas[:, opened], found.lengths[:, opened])


@pytest.mark.parametrize("length", [14.0, 17.0, 20.0])
@pytest.mark.parametrize("area", [1.0, 4.0])
def test_a_uniform_tube_resonates_at_odd_quarters_of_its_wavelength(
    length: float, area: float
) -> None:
    def past_a_quarter(frequency: float) -> float:
        wave = 2 * np.pi * frequency / SPEED_OF_SOUND
        return float(np.cos(wave * length + np.arctan(wave * radiated(area))))

    found = dense(cylinders([area], [length]), wall_mass=np.inf)[:3, 0]
    assert found == pytest.approx(first_roots(past_a_quarter, 3), rel=1e-3)
    shorter = np.array([1, 3, 5]) * SPEED_OF_SOUND / (4 * (length + radiated(area)))
    assert found == pytest.approx(shorter, rel=0.02)


@pytest.mark.parametrize(
    ("areas", "lengths"),
    [([1.0, 7.0], [9.0, 8.0]), ([8.0, 1.0], [9.0, 6.0]), ([6.0, 0.5], [11.0, 5.0])],
)
def test_two_tubes_resonate_where_their_impedances_cancel(
    areas: list[float], lengths: list[float]
) -> None:
    def mismatch(frequency: float) -> float:
        wave = 2 * np.pi * frequency / SPEED_OF_SOUND
        front = wave * lengths[1] + np.arctan(wave * radiated(areas[1]))
        # cot(back) / A1 = tan(front) / A2, without poles
        back = wave * lengths[0]
        return float(
            areas[1] * np.cos(back) * np.cos(front) - areas[0] * np.sin(back) * np.sin(front)
        )

    found = dense(cylinders(areas, lengths), wall_mass=np.inf)[:3, 0]
    assert found == pytest.approx(first_roots(mismatch, 3), rel=4e-3)


def first_roots(function: Callable[[float], float], count: int) -> list[float]:
    """The first roots above 0."""
    grid = np.arange(20.0, 5000.0, 10.0)
    values = np.array([function(x) for x in grid])
    crossings = np.flatnonzero(values[:-1] * values[1:] < 0)[:count]
    return [brentq(function, grid[i], grid[i + 1]) for i in crossings]


def test_bisection_finds_what_a_dense_solver_finds() -> None:
    tubes = random_tube(400)
    exact = np.clip(dense(tubes)[:2], *np.array(RANGES).T[:, :, None])
    off = np.abs(formants(tubes) - exact)
    assert off[0].max() < 0.3
    assert off[1].max() < 0.9
    fine = formants(tubes, steps=18)
    assert np.abs(fine - exact).max() < 0.1


def test_formants_are_found_by_rank_so_that_none_is_missed() -> None:
    # A narrow constriction brings the second and third resonance together.
    tubes = cylinders([4.0, 0.05, 4.0], [8.0, 1.0, 7.0])
    found = formants(tubes, (*RANGES, (250.0, 5000.0)), steps=18)[:, 0]
    assert found == pytest.approx(dense(tubes)[:3, 0], abs=0.5)
    assert found[0] < found[1] < found[2]


def test_yielding_walls_raise_the_first_formant_of_a_narrow_mouth() -> None:
    tubes = cylinders([8.0, 0.65], [9.0, 8.0])
    raised = dense(tubes)[0] - dense(tubes, wall_mass=np.inf)[0]
    assert 30 < raised[0] < 120


def test_a_long_tract_speaks_lower_than_a_short_one() -> None:
    long, short = (formants(cylinders([3.0], [length]))[:, 0] for length in (20.0, 14.0))
    assert (long < short).all()


def test_the_neutral_tract_is_a_mans() -> None:
    neutral = np.zeros((7, 1))
    shape = contours(ADULT, neutral)
    found = tube(ADULT, neutral, shape)
    assert found.areas.shape == (SECTIONS, 1)
    assert found.lengths.sum() == pytest.approx(17.0, abs=0.05)
    assert dense(found)[:3, 0] == pytest.approx([500, 1500, 2393], rel=2e-3)


def spoken_formants(name: str) -> FloatArray:
    positions = articulations()[name][:, None]
    shape = contours(ADULT, positions)
    assert shape.opening[0] > 0
    return formants(tube(ADULT, positions, shape))[:, 0]


@pytest.mark.parametrize("name", CORNERS)
def test_the_corner_vowels_can_be_said(name: str) -> None:
    assert spoken_formants(name) == pytest.approx(formants_of(name), rel=0.05)


@pytest.mark.parametrize("name", VOWELS)
def test_a_mans_english_vowels_can_be_said(name: str) -> None:
    assert spoken_formants(name) == pytest.approx(formants_of(name), rel=0.10)
