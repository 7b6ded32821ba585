"""Goals where outcomes may be noisy: within reach, or where attempts get farther."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from sgim.spaces import BoolArray, FloatArray

_DRAWS = 10  # Until one is taken; a box is hardly ever so large that none lies within reach.

Surrounded = Callable[[str, FloatArray, Any], BoolArray]
"""Whether goals of a kind lie among the outcomes produced so far, in a context.

The goals are scaled to the unit box, shape ``(m, d)``.
"""


class WithinReach:
    """Draws goals where gains cannot be told from luck.

    An outcome that comes nearer to a goal than all before it is a record. Where outcomes are noisy,
    most records are luck: within what has been reached, where noise soon is more than what is
    lacking, and at the edge of what can be reached, where much is lacking for ever.

    So goals are drawn uniformly. One that lies among the outcomes produced so far is taken, since a
    map is the better the more trials it has there. One beyond them is taken as often as attempts
    there have lately come nearer by more than luck explains: often while the edge gives way, and
    seldom once it is that of what can be reached.

    Args:
        deviation: Kind → standard deviation of the noise of an outcome, in the unit box; None where
            there is decidedly no noise, or too little is known.
        surrounded: Whether goals lie among the outcomes produced so far.
        least: By how many standard deviations, along one coordinate, an attempt must come nearer
            for it not to be luck.
    """

    def __init__(
        self,
        deviation: Callable[[str], float | None],
        surrounded: Surrounded,
        *,
        least: float = 0.5,
    ) -> None:
        self._deviation = deviation
        self._surrounded = surrounded
        self._least = least

    def luck(self, kind: str, dimension: int) -> float | None:
        """How much nearer an attempt may come by luck; None where goals are not drawn here."""
        deviation = self._deviation(kind)
        return None if deviation is None else self._least * deviation / math.sqrt(dimension)

    def draw(
        self,
        rngs: Sequence[np.random.Generator],
        kind: str,
        dimension: int,
        context: Any,
        promise: Callable[[FloatArray], float],
    ) -> FloatArray:
        """Draw a goal for each of some generators.

        Args:
            rngs: Where numbers come from.
            kind: The kind.
            dimension: Of its goals.
            context: The present context.
            promise: How likely an attempt at a place is to come nearer by more than luck.

        Returns:
            Goals, scaled to the unit box, shape ``(m, dimension)``.
        """
        draws = np.array([rng.random((_DRAWS, 1 + dimension)) for rng in rngs])
        chosen: FloatArray = draws[:, -1, 1:].copy()
        left = list(range(len(rngs)))
        for tried in (draws[:, :1], draws[:, 1:]):  # The first is often taken.
            if not left:
                break
            places = tried[left, :, 1:].reshape(-1, dimension)
            inside = self._surrounded(kind, places, context).reshape(len(left), -1).tolist()
            refused = []
            for i, within in zip(left, inside, strict=True):
                for draw, among in zip(tried[i], within, strict=True):
                    if among or draw[0] < promise(draw[1:]):
                        chosen[i] = draw[1:]
                        break
                else:
                    refused.append(i)
            left = refused
        return chosen
