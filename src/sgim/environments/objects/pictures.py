"""The pictures by which recognition is measured: 64 of each toy, kept as features."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib.resources import files

import numpy as np

from sgim.environments.objects.table import ToyTable
from sgim.errors import SgimError
from sgim.recognition.features import FEATURES, Features
from sgim.recognition.picture import Picture
from sgim.streams import Streams

PICTURES_FILE = "objects_pictures.npz"
EACH = 64
SEED = 20_261_125


def evaluation_pictures(
    table: ToyTable, toy: str, count: int = EACH, seed: int = SEED
) -> Iterator[Picture]:
    """Drop a toy turned over anyhow and look at it, as often as asked.

    The streams are the pictures' own, so that no learner meets the same pictures.

    Args:
        table: Where.
        toy: Its name.
        count: How many pictures.
        seed: Of the streams.
    """
    streams = Streams(seed)
    for number in range(count):
        rng = streams(f"pictures/{toy}", number)
        yield table.picture(toy, table.moved(toy, "lift", rng), rng)


def make_pictures(
    table: ToyTable, count: int = EACH, seed: int = SEED
) -> dict[str, list[Features]]:
    """The features of `evaluation_pictures` of each toy."""
    look = table.eye.look
    return {
        toy: [look(picture) for picture in evaluation_pictures(table, toy, count, seed)]
        for toy in table.toys.labels
    }


@cache
def kept_pictures() -> dict[str, list[Features]]:
    """The pictures that come with the package, by their features.

    Raises:
        SgimError: If they are missing.
    """
    resource = files("sgim.environments") / "data" / PICTURES_FILE
    if not resource.is_file():
        raise SgimError(f"the package has no {PICTURES_FILE} in sgim/environments/data")
    kept: dict[str, list[Features]] = {}
    with resource.open("rb") as file, np.load(file) as arrays:
        packed, lengths, toys = arrays["packed"].tobytes(), arrays["lengths"], arrays["toys"]
    start = 0
    for toy, length in zip(toys.tolist(), lengths.tolist(), strict=True):
        kept.setdefault(toy, []).append(
            Features.of(FEATURES.unpack(packed[start : start + length]))
        )
        start += length
    return kept
