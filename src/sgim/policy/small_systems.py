"""Many small systems of linear equations, solved at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.spaces import FloatArray

_MANY = 8  # Systems from which on to solve them all at once is faster.


def solved(squares: FloatArray, right: FloatArray) -> FloatArray:
    """Solve positive semidefinite systems, a little damped.

    For the few coordinates of an outcome that is faster than LAPACK, and elimination needs no
    pivots here.

    Args:
        squares: Matrices, shape ``(b, n, n)``.
        right: Right-hand sides, shape ``(b, n)``.
    """
    n = right.shape[1]
    if len(right) < _MANY:
        rows, sides = squares.tolist(), right.tolist()
        return np.array([_eliminated(m, r, n) for m, r in zip(rows, sides, strict=True)])
    columns = [list(row) for row in squares.transpose(1, 2, 0).copy()]
    return np.array(_eliminated(columns, list(right.T.copy()), n)).T


def _eliminated(rows: list[list[Any]], right: list[Any], n: int) -> list[Any]:
    """Solve by elimination; the entries are numbers, or arrays with an entry a system."""
    trace = rows[0][0]
    for i in range(1, n):
        trace = trace + rows[i][i]
    damping = 1e-6 / n * trace + 1e-300
    for i in range(n):
        rows[i][i] = rows[i][i] + damping
        for j in range(i):
            factor = rows[i][j] / rows[j][j]
            for k in range(j + 1, n):
                rows[i][k] = rows[i][k] - factor * rows[j][k]
            right[i] = right[i] - factor * right[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            right[i] = right[i] - rows[i][j] * right[j]
        right[i] = right[i] / rows[i][i]
    return right
