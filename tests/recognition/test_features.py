"""What stands on the table is found by depth, and its features are kept with their places."""

import numpy as np
import pytest

from sgim.arrays import Arrays
from sgim.errors import SgimError, SpaceError
from sgim.recognition import FEATURES, Eye, Features, Picture
from sgim.recognition.features import neighbours
from sgim.recognition.outline import outline
from sgim.recognition.superpixels import superpixels
from sgim.spaces import space_from_description
from sgim.testing import check_space
from tests.recognition.made_up import GREEN, RED, picture

SQUARE = (slice(30, 90), slice(50, 110))


def test_what_stands_on_a_tilted_table_is_outlined() -> None:
    found = outline(picture((RED, GREEN)))
    assert found[SQUARE].mean() > 0.97
    assert found.sum() == pytest.approx(3600, rel=0.03)


def test_an_empty_table_and_one_too_near_to_see_have_no_outline() -> None:
    assert not outline(picture((RED,), height=0.0)).any()
    blind = picture((RED,))
    assert not outline(Picture(blind.colours, np.zeros_like(blind.depth))).any()


def test_what_hides_an_object_is_not_taken_for_it() -> None:
    shown = picture((RED, GREEN))
    depth = shown.depth.copy()
    depth[:, 70:80] = 0.0  # a bar too near for the camera to tell
    found = outline(Picture(shown.colours, depth))
    assert not found[:, 70:80].any()
    assert found[30:90, 50:70].mean() > 0.9
    assert found[30:90, 80:110].mean() > 0.9


def test_superpixels_do_not_mix_colours() -> None:
    colours = np.zeros((40, 40, 3), np.float32)
    colours[:, 23:, 1] = 50
    places, means = superpixels(colours, np.ones((40, 40), bool), 10.0)
    assert len(places) >= 8
    assert set(means[:, 1].round(3)) == {0.0, 50.0}
    assert ((places[:, 0] > 22.5) == (means[:, 1] > 25)).all()


def test_neighbours_are_the_nearest_each_pair_once() -> None:
    places = np.array([[0, 0], [1, 0], [2, 0], [50, 0], [51, 0]], np.float32)
    pairs = neighbours(places, 1)
    assert pairs.tolist() == [[0, 1], [1, 2], [3, 4]]
    assert neighbours(places[:1]).shape == (0, 2)
    assert len(neighbours(places, 9)) == 10


def test_features_lie_in_the_object_and_know_their_picture() -> None:
    shown = picture((RED, GREEN))
    features = Eye().look(shown)
    assert len(features.points) > 5
    assert len(features.regions) > 8
    assert features.digest.tobytes() == shown.digest()
    assert np.allclose((features.roots**2).sum(axis=1), 1, atol=1e-5)
    green = features.colours[features.colours[:, 1] < 0]
    assert 0.3 < len(green) / len(features.colours) < 0.7


def test_a_picture_of_nothing_has_no_features() -> None:
    features = Eye().look(picture((RED,), height=0.0))
    assert len(features.points) == len(features.colours) == len(features.point_pairs) == 0


def test_features_come_back_from_bytes_and_their_space_from_its_description() -> None:
    check_space(FEATURES)
    features = Eye().look(picture((RED, GREEN)))
    again = Features.of(FEATURES.unpack(FEATURES.pack(features.arrays)))
    for name in FEATURES.fields:
        assert np.array_equal(getattr(again, name), getattr(features, name))
    assert space_from_description(FEATURES.describe()).describe() == FEATURES.describe()


def test_what_is_no_features_is_refused() -> None:
    space = Arrays({"a": ("float32", 2)})
    with pytest.raises(SpaceError, match="outcome is list, expected arrays a"):
        space.check([1], "outcome")
    with pytest.raises(SpaceError, match=r"'a' of shape \(3,\), float32; expected \(rows, 2\)"):
        space.check({"a": np.zeros(3, np.float32)})
    with pytest.raises(SpaceError, match="float64; expected"):
        space.check({"a": np.zeros((3, 2))})
    with pytest.raises(SpaceError, match="not finite"):
        space.check({"a": np.full((1, 2), np.nan, np.float32)})
    paired = Arrays({"a": ("float32", 1), "b": ("uint8", 1)}, together=[("a", "b")])
    with pytest.raises(SpaceError, match="1 in 'a', 2 in 'b'; expected as many rows in each"):
        paired.check({"a": np.zeros((1, 1), np.float32), "b": np.zeros((2, 1), np.uint8)})
    with pytest.raises(SgimError, match="unknown field 'c'"):
        Arrays({"a": ("float32", 1)}, together=[("a", "c")])
    with pytest.raises(SpaceError, match="cannot be encoded"):
        space.encode({"a": np.zeros((1, 2), np.float32)})
    for wrong in ({}, {"a": ("U3", 1)}, {"a": ("float32", 0)}):
        with pytest.raises(SpaceError, match=r"expected a number type|needs one or more fields"):
            Arrays(wrong)
