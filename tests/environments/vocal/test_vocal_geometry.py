"""The shape of the tract: what each articulator moves, and where the tract closes."""

import numpy as np
import pytest

from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS
from sgim.environments.vocal.articulations import CLOSURES, articulations
from sgim.environments.vocal.geometry import (
    LINES,
    MOUTH,
    PHARYNX,
    SECTIONS,
    Contours,
    contours,
    tube,
)
from sgim.spaces import FloatArray

UNIFORM = np.random.default_rng(0).uniform(-3, 3, (7, 20_000))


def shape_of(**commands: float) -> Contours:
    """Contours when these articulators (``_`` for a space) are not neutral."""
    positions = np.zeros((7, 1))
    for name, value in commands.items():
        positions[ARTICULATORS.index(name.replace("_", " "))] = value
    return contours(ADULT, positions)


def areas_of(**commands: float) -> FloatArray:
    positions = np.zeros((7, 1))
    for name, value in commands.items():
        positions[ARTICULATORS.index(name.replace("_", " "))] = value
    return np.asarray(tube(ADULT, positions, contours(ADULT, positions)).areas[:, 0])


def test_a_third_to_two_thirds_of_uniform_draws_are_open() -> None:
    assert 1 / 3 < (contours(ADULT, UNIFORM).opening > 0).mean() < 2 / 3
    assert (contours(ADULT, UNIFORM / 3).opening > 0).mean() > 0.9


@pytest.mark.parametrize(
    ("place", "least"), [("labial", 0.15), ("alveolar", 0.15), ("velar", 0.15)]
)
def test_uniform_draws_close_at_every_place(place: str, least: float) -> None:
    shape, lines = contours(ADULT, UNIFORM), CLOSURES[place]
    gaps = shape.lips[None] if lines is None else shape.gaps[slice(*lines)]
    assert (gaps <= 0).any(axis=0).mean() > least


@pytest.mark.parametrize("place", CLOSURES)
def test_the_tract_can_close_at_one_place_alone(place: str) -> None:
    shape, lines = contours(ADULT, articulations()[place][:, None]), CLOSURES[place]
    closed = {*np.flatnonzero(shape.gaps[:, 0] <= 0).tolist()}
    if lines is None:
        assert shape.lips[0] < 0
        assert not closed
    else:
        assert closed
        assert closed <= {*range(*lines)}
        assert shape.lips[0] > 0


def test_gaps_keep_their_sign_where_the_tongue_is_past_the_wall() -> None:
    shape = contours(ADULT, UNIFORM)
    assert shape.gaps.min() < -0.5
    found = tube(ADULT, UNIFORM, shape)
    assert found.areas.min() > 0
    assert found.lengths.min() > 0


def test_wall_and_tongue_are_where_their_distances_say() -> None:
    shape = contours(ADULT, UNIFORM[:, :50])
    apart = np.linalg.norm(shape.points(shape.wall) - shape.points(shape.tongue), axis=0)
    assert apart == pytest.approx(np.abs(shape.gaps))
    assert shape.gaps.shape == (LINES, 50)


def test_each_articulator_moves_what_it_is_named_after() -> None:
    neutral = shape_of()
    mouth, pharynx = slice(LINES - MOUTH, None), slice(None, PHARYNX)
    assert shape_of(jaw=2).gaps[mouth].mean() < neutral.gaps[mouth].mean()
    assert shape_of(jaw=2).lips[0] < neutral.lips[0]
    assert shape_of(tongue_body=2).gaps[pharynx].mean() > neutral.gaps[pharynx].mean()
    assert shape_of(tongue_height=2).gaps.min() < neutral.gaps.min()
    raised = neutral.gaps - shape_of(tongue_tip=1).gaps
    assert raised.argmax() >= LINES - 4
    assert raised.max() > 0.2
    assert raised[: LINES - MOUTH].max() == 0
    assert shape_of(lip_height=2).lips[0] > neutral.lips[0]
    assert areas_of(lip_protrusion=2)[-1] < areas_of()[-1]


def test_larynx_and_lips_change_the_length() -> None:
    def length(**commands: float) -> float:
        positions = np.zeros((7, 1))
        for name, value in commands.items():
            positions[ARTICULATORS.index(name)] = value
        return float(tube(ADULT, positions, contours(ADULT, positions)).lengths.sum())

    assert length(**{"larynx height": 2.0}) < length() - 0.3
    assert length(**{"lip protrusion": 2.0}) > length() + 0.3


def test_single_precision_gives_the_same_shape() -> None:
    double = contours(ADULT, UNIFORM[:, :500])
    single = contours(ADULT, UNIFORM[:, :500].astype(np.float32))
    assert single.gaps.dtype == np.float32
    assert single.gaps == pytest.approx(double.gaps, abs=1e-5)
    areas = tube(ADULT, UNIFORM[:, :500].astype(np.float32), single).areas
    assert areas.dtype == np.float32
    assert areas.shape == (SECTIONS, 500)
