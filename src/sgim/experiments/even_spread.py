"""Spreads demonstrations evenly: one in each of so many tiles, chosen by how well it repeats."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from sgim.errors import SgimError
from sgim.records import Outcome
from sgim.spaces import FloatArray

_FINEST = 40


def by_tile(landings: FloatArray, count: int) -> list[list[int]]:
    """Group landings by the coarsest square tiles of [-1, 1]² of which ``count`` were reached.

    Args:
        landings: In m, shape ``(n, 2)``; those outside are left out.
        count: How many tiles to have, at least.

    Returns:
        The indices of the landings in each tile that was reached.

    Raises:
        SgimError: If landings are too few, or too close together.
    """
    inside = np.flatnonzero((np.abs(landings) < 1).all(axis=1))
    for along in range(2, _FINEST + 1):
        groups: dict[tuple[int, int], list[int]] = {}
        for i in inside.tolist():
            column, row = np.floor((landings[i] + 1) / 2 * along).astype(int).tolist()
            groups.setdefault((column, row), []).append(i)
        if len(groups) >= count:
            return [groups[tile] for tile in sorted(groups)]
    raise SgimError(f"landings lie in fewer than {count} tiles: explore more")


def mean_miss(
    executions: Sequence[Callable[[], Outcome]],
    landing: FloatArray,
    kind: str = "float",
    least: float = math.inf,
) -> float:
    """How far repeated movements land from where the first did, in the outcome's unit.

    Args:
        executions: Each executes the movement once; one that does not land, or fails, misses by 1.
        landing: Where it should land.
        kind: Kind of the outcome.
        least: A mean that is not worth knowing, nor any greater one: the answer is infinite as
            soon as it must be as great as that, and the other executions are left out.
    """
    total = 0.0
    for execute in executions:
        try:
            repeated = execute().get(kind)
        except SgimError:
            repeated = None
        total += 1.0 if repeated is None else float(np.linalg.norm(repeated - landing))
        if total >= least * len(executions):
            return math.inf
    return total / len(executions)
