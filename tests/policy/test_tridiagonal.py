"""Systems with many shifts by tridiagonal matrices: as solved one by one."""

import numpy as np
import pytest

from sgim.policy.tridiagonal import shifted, tridiagonal


@pytest.mark.parametrize(("k", "d"), [(2, 1), (3, 2), (16, 2), (48, 6)])
def test_log_determinants_and_forms_are_those_of_the_shifted_matrices(k: int, d: int) -> None:
    rng = np.random.default_rng(k)
    factors = rng.normal(size=(3, 4, k, k))
    matrices = factors @ np.swapaxes(factors, -1, -2)
    right = rng.normal(size=(3, 1, k, d))
    shifts = 10.0 ** rng.uniform(-8, 1, size=(3, 4, 2, 5))
    logs, forms = shifted(*tridiagonal(matrices, right), shifts)
    assert logs.shape == (3, 4, 2, 5)
    assert forms.shape == (3, 4, 2, 5, d)
    whole = matrices[:, :, None, None] + shifts[..., None, None] * np.eye(k)
    assert logs == pytest.approx(np.linalg.slogdet(whole)[1], rel=1e-9, abs=1e-9)
    sides = np.broadcast_to(right[:, :, None, None], (*whole.shape[:-1], d))
    expected = np.einsum("...kd,...kd->...d", sides, np.linalg.solve(whole, sides))
    assert forms == pytest.approx(expected, rel=1e-5)


def test_a_matrix_without_an_inverse_has_one_with_the_least_shift() -> None:
    points = np.linspace(0, 1, 48)[:, None]
    smooth = np.exp(-((points - points.T) ** 2))
    logs, forms = shifted(*tridiagonal(smooth, points), np.array([1e-8]))
    values, vectors = np.linalg.eigh(smooth)
    values = np.maximum(values, 0) + 1e-8
    assert logs == pytest.approx(np.log(values).sum(), rel=1e-6)
    assert forms[0] == pytest.approx(((vectors.T @ points) ** 2 / values[:, None]).sum(0), rel=1e-5)
