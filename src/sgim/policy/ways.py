"""The ways of answering, by name."""

from __future__ import annotations

from collections.abc import Callable

from sgim.errors import unknown
from sgim.policy.answering import Answering, KernelMean, Nearest, Reliable
from sgim.policy.local_model import LocalModel

ANSWERING: dict[str, Callable[[], Answering]] = {
    "nearest": Nearest,
    "reliable": Reliable,
    "kernel": KernelMean,
    "local": LocalModel,
}


def answering_of(given: str | Answering) -> Answering:
    """A way of answering by its name, or as it is.

    Raises:
        UnknownNameError: If there is none of this name.
    """
    if not isinstance(given, str):
        return given
    if given not in ANSWERING:
        raise unknown("way of answering", given, ANSWERING)
    return ANSWERING[given]()
