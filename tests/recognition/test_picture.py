"""What is no picture is refused with what was expected, what came, and what to do."""

from typing import Any

import numpy as np
import pytest

from sgim.recognition import Picture, PictureError

COLOURS = np.zeros((48, 64, 3), np.uint8)
DEPTH = np.ones((48, 64))
NAN = np.where(np.arange(64) == 5, np.nan, DEPTH)


@pytest.mark.parametrize(
    ("colours", "depth", "message"),
    [
        (COLOURS[..., :2], DEPTH, r"shape \(48, 64, 2\), expected \(height, width, 3\)"),
        (COLOURS[..., 0], DEPTH, r"expected \(height, width, 3\): red, green, blue"),
        (COLOURS / 255, DEPTH, r"float64, expected uint8.*\(255 \* colours\)"),
        (COLOURS, DEPTH[:-1], r"depth has shape \(47, 64\), expected .* \(48, 64\)"),
        (COLOURS[:20], DEPTH[:20], "20 × 64 pixels, expected 32 × 32 or more"),
        (COLOURS, DEPTH.astype(np.uint16), "uint16, expected floating-point .* depth / 1000"),
        (COLOURS, NAN, "depth is nan at row 0, column 5.*48: use np.nan_to_num"),
        (COLOURS, np.full((48, 64), np.inf), "depth is inf at row 0, column 0"),
        (COLOURS, -DEPTH, r"depth is -1.0 at row 0, column 0, expected m"),
        ("picture", DEPTH, r"colours have shape \(\)"),
    ],
)
def test_what_is_no_picture_is_refused(colours: Any, depth: Any, message: str) -> None:
    with pytest.raises(PictureError, match=message):
        Picture(colours, depth)


def test_a_picture_does_not_change_with_the_arrays_it_is_made_of() -> None:
    colours, depth = COLOURS.copy(), DEPTH.copy()
    picture = Picture(colours, depth)
    before = picture.digest()
    colours[:], depth[:] = 9, 9
    assert picture.digest() == before == Picture(COLOURS, DEPTH).digest()
    with pytest.raises(ValueError, match="read-only"):
        picture.colours[0] = 1


def test_digests_tell_pictures_apart_by_colour_and_by_depth() -> None:
    bright, near = COLOURS.copy(), DEPTH.copy()
    bright[7, 7, 1], near[7, 7] = 1, 0.5
    digests = {Picture(c, d).digest() for c in (COLOURS, bright) for d in (DEPTH, near)}
    assert {len(digest) for digest in digests} == {16}
    assert len(digests) == 4
