"""The motors follow eq. 5.1."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from sgim.environments.vocal.motor import MOTORS, NEUTRAL, SECOND_COMMAND, trajectories, weights
from sgim.spaces import FloatArray

TIMES = np.linspace(0, 0.8, 33)


def integrated(policy: FloatArray) -> FloatArray:
    """Eq. 5.1 solved numerically, command by command, shape ``(9, t)``."""
    frequency, damping = 2 * np.pi / 0.8, 1.01

    def moving(command: FloatArray):  # type: ignore[no-untyped-def]
        def derivative(_: float, state: FloatArray) -> FloatArray:
            place, speed = state.reshape(2, -1)
            pull = -2 * damping * frequency * speed - frequency**2 * (place - command)
            return np.concatenate([speed, pull])

        return derivative

    first, second = policy.reshape(2, -1)
    state = np.concatenate([NEUTRAL, np.zeros(9)])
    found = []
    for command, start, end in ((first, 0.0, SECOND_COMMAND), (second, SECOND_COMMAND, 0.8)):
        last = end == 0.8
        times = TIMES[(start <= TIMES) & ((end > TIMES) | last)]
        wanted = np.unique([*times, end])
        solved = solve_ivp(
            moving(command), (start, end), state, t_eval=wanted, rtol=1e-10, atol=1e-12
        )
        state = solved.y[:, -1]
        found.append(solved.y[:9, np.isin(wanted, times)])
    return np.concatenate(found, axis=1)


def test_trajectories_solve_the_equation_and_carry_the_velocity_over() -> None:
    policy = np.random.default_rng(0).uniform(-3, 3, 18)
    assert trajectories(policy[None], TIMES)[:, :, 0] == pytest.approx(integrated(policy), abs=1e-8)


def test_by_the_second_command_58_percent_of_the_first_is_reached() -> None:
    neutral, first, second = weights(np.array([SECOND_COMMAND]))[:, 0]
    assert first == pytest.approx(0.58, abs=0.005)
    assert second == 0.0
    assert neutral + first + second == pytest.approx(1.0)


def test_a_policy_at_rest_stays_at_rest() -> None:
    path = trajectories(np.tile(NEUTRAL, 2)[None], TIMES)
    assert path[:, :, 0] == pytest.approx(np.repeat(NEUTRAL[:, None], len(TIMES), axis=1))
    assert path.shape == (len(MOTORS), len(TIMES), 1)
