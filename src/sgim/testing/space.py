"""The suite for spaces of points that are neither vectors nor labels."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from sgim.spaces import Space
from sgim.streams import Streams
from sgim.testing.promises import require, succeeds


def check_space(space: Space, *, samples: int = 20, seed: int = 0) -> None:
    """Check that a space keeps the promises of `sgim.spaces.Space`.

    Args:
        space: The space.
        samples: How many points to draw.
        seed: Of the points drawn.

    Raises:
        AssertionError: If a promise is broken.
    """
    streams = Streams(seed)
    with succeeds("describe gives what JSON can hold", "Use numbers, strings, lists and dicts"):
        described = json.dumps(space.describe())
    require(
        json.dumps(space.describe()) == described,
        "describe gives the same description each time, for journals know their task by it",
        f"{described:.100} came first and {space.describe()!r:.100} then",
        "Describe only what is fixed when the space is made",
    )
    for number in range(samples):
        with succeeds("sample draws a point", "Draw from the generator it is given"):
            point = space.sample(streams("testing/space", number))
            again = space.sample(streams("testing/space", number))
        check_point(space, point, "a sampled point")
        require(
            space.pack(point) == space.pack(again),
            "sample draws the same point from the same generator",
            f"{point!r:.80} and {again!r:.80} came",
            "Take every random number from the generator given",
        )
        require(
            space.contains(point),
            "a sampled point lies within the bounds",
            f"contains denies it of {point!r:.80}",
            "Sample within the bounds, or widen them",
        )


def check_point(space: Space, point: Any, what: str) -> None:
    """Check that a space accepts one of its points, and packs and encodes it.

    Args:
        space: The space.
        point: A point of it.
        what: What the point is, for the message, such as ``"a sampled point"``.

    Raises:
        AssertionError: If a promise is broken.
    """
    with succeeds(f"check accepts {what}", "Make check and the points agree"):
        checked = space.check(point, what)
    with succeeds(f"pack and unpack take {what}", "Journals keep points as bytes"):
        data = space.pack(checked)
        restored = space.pack(space.unpack(data))
    require(
        isinstance(data, bytes) and restored == data,
        f"unpack gives back {what} exactly, for a journal must restore it",
        f"{point!r:.80} was packed as {data!r:.60} and came back as {restored!r:.60}",
        "Pack every bit of the point: for arrays, tobytes in a fixed byte order",
    )
    dimension = space.dimension
    if dimension is None:
        return
    with succeeds(f"encode takes {what}", "Set dimension to None if points cannot be encoded"):
        vector = space.encode(checked)
    require(
        isinstance(vector, np.ndarray)
        and vector.shape == (dimension,)
        and np.isfinite(vector).all(),
        f"encode gives a finite vector of shape ({dimension},)",
        f"{vector!r:.80} came for {point!r:.80}",
        "Make encode and dimension agree",
    )
    inside = not space.contains(checked) or bool(((vector >= 0) & (vector <= 1)).all())
    require(
        inside,
        "a point within the bounds is encoded in the unit box, by which distances are measured",
        f"{vector!r:.80} came for {point!r:.80}",
        "Scale by the bounds of the space",
    )
