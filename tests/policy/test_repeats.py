"""What trials of the same policy tell of noise."""

import numpy as np
import pytest

from sgim.policy.repeats import repeats


def test_nothing_is_known_of_noise_until_a_policy_is_tried_again() -> None:
    assert repeats(np.eye(3), np.ones((3, 2))) == (0, 0.0)


def test_the_variance_of_what_equal_policies_produced_is_found() -> None:
    rng = np.random.default_rng(0)
    policies = rng.random((400, 3))
    often = np.concatenate((policies, policies[:200], policies[:200]))
    smooth = 10 * often[:, :2]
    again, variance = repeats(often, smooth + 0.1 * rng.standard_normal(smooth.shape))
    assert again == 400
    assert variance == pytest.approx(2 * 0.1**2, rel=0.15)  # of both coordinates
    assert repeats(often, smooth) == (400, pytest.approx(0, abs=1e-25))
