"""Many symmetric systems that differ by a multiple of the identity, by tridiagonal matrices.

To bring a matrix to tridiagonal form takes a small part of the time that its eigenvectors take, and
a tridiagonal system with any shift is solved in linear time (G. H. Golub and C. F. Van Loan,
"Matrix Computations", Johns Hopkins University Press, 2013, sections 4.3 and 8.3).
"""

from __future__ import annotations

import numpy as np

from sgim.spaces import FloatArray


def tridiagonal(
    matrices: FloatArray, right: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Symmetric matrices in a basis in which they are tridiagonal, and right-hand sides there.

    Args:
        matrices: Shape ``(..., k, k)``, k at least 2.
        right: Right-hand sides, of a shape that broadcasts to ``(..., k, d)``.

    Returns:
        Diagonals, shape ``(..., k)``, what stands beside them, shape ``(..., k - 1)``, and
        right-hand sides, shape ``(..., k, d)``.
    """
    from scipy.linalg.lapack import dormqr, dsytrd

    right = np.broadcast_to(right, (*matrices.shape[:-1], right.shape[-1])).copy()
    diagonals, beside = np.empty(matrices.shape[:-1]), np.empty(matrices[..., 1:, 0].shape)
    for each in np.ndindex(matrices.shape[:-2]):
        reflections, diagonals[each], beside[each], scales, _ = dsytrd(matrices[each], lower=1)
        # They leave the first coordinate as it is, and are stored as those of a QR factorization.
        work = right.shape[-1]
        right[each][1:] = dormqr(
            "L", "T", reflections[1:, :-1], scales, right[each][1:], lwork=work
        )[0]
    return diagonals, beside, right


def shifted(
    diagonals: FloatArray, beside: FloatArray, right: FloatArray, shifts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Log-determinants of tridiagonal matrices with shifts, and quadratic forms of their inverses.

    Args:
        diagonals: Shape ``(..., k)``.
        beside: Shape ``(..., k - 1)``.
        right: Right-hand sides r, shape ``(..., k, d)``.
        shifts: What is added to the diagonals, any number of them, shape ``(..., *s)``; with it the
            matrices must be positive definite.

    Returns:
        Log-determinants, shape ``(..., *s)``, and rᵀ A⁻¹ r of each column, shape ``(..., *s, d)``.
    """
    more = shifts.ndim - diagonals.ndim + 1
    # Coordinates first, and room for shifts.
    along = [
        np.moveaxis(a, -1, 0).reshape(a.shape[-1], *a.shape[:-1], *[1] * more)
        for a in (diagonals, beside)
    ]
    sides = np.moveaxis(right, -2, 0)
    sides = sides.reshape(*sides.shape[:-1], *[1] * more, sides.shape[-1])
    pivots = np.empty((len(sides), *shifts.shape))
    pivots[0] = along[0][0] + shifts
    solved = np.broadcast_to(sides[0], (*shifts.shape, right.shape[-1]))
    forms: FloatArray = solved**2 / pivots[0][..., None]
    for i in range(1, len(sides)):
        factors = along[1][i - 1] / pivots[i - 1]
        pivots[i] = along[0][i] + shifts - factors * along[1][i - 1]
        solved = sides[i] - factors[..., None] * solved
        forms += solved**2 / pivots[i][..., None]
    logs: FloatArray = np.log(pivots).sum(axis=0)
    return logs, forms
