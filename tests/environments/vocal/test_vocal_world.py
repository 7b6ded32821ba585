"""The vocal tract as a world: what is heard of a policy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.environments import VocalTract
from sgim.environments.vocal import articulations, spoken
from sgim.environments.vocal.articulations import CLOSURES
from sgim.environments.vocal.perception import SOUND, frame_times, in_hertz, perceived
from sgim.errors import SgimError, SpaceError
from sgim.spaces import FloatArray
from sgim.testing import check_environment

QUIET = VocalTract(noise=0.0)


def random_policies(count: int, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).uniform(-3, 3, (count, 18))


@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_the_tract_keeps_the_promises_of_an_environment(noise: float) -> None:
    check_environment(VocalTract(noise))


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 9))
def test_a_batch_gives_bit_for_bit_what_single_vocalisations_give(seed: int, count: int) -> None:
    policies = random_policies(count, seed)
    policies[: count // 2, [7, 8, 16, 17]] = 1.0
    together = QUIET.sounds(policies)
    alone = np.concatenate([QUIET.sounds(policy[None]) for policy in policies])
    assert together.tobytes() == alone.tobytes()


def test_a_large_batch_is_the_same_as_its_parts() -> None:
    policies = random_policies(900, seed=1)
    policies[:, [7, 8, 16, 17]] = 1.0
    parts = np.concatenate([QUIET.sounds(policies[i : i + 113]) for i in range(0, 900, 113)])
    assert QUIET.sounds(policies).tobytes() == parts.tobytes()


def test_noise_is_drawn_from_each_trials_generator() -> None:
    policies = random_policies(300, seed=2)
    noisy = VocalTract(0.01).execute_batch(
        policies, None, [np.random.default_rng(i) for i in range(300)]
    )
    added = np.array([outcome["sound"] for outcome in noisy]) - QUIET.sounds(policies)
    assert added.std() == pytest.approx(0.01, rel=0.05)
    again = VocalTract(0.01).execute(policies[7], None, np.random.default_rng(7))
    assert again["sound"].tobytes() == noisy[7]["sound"].tobytes()


def test_a_noisy_tract_needs_a_generator() -> None:
    with pytest.raises(SgimError, match="needs a generator"):
        VocalTract(0.01).execute(np.zeros(18))


def test_nothing_is_heard_at_rest() -> None:
    assert QUIET.task.rest is not None
    assert not QUIET.sounds(QUIET.task.rest[None]).any()


def test_there_is_a_voice_only_where_pressure_and_voicing_exceed_0() -> None:
    policy = spoken("a", "a")
    assert QUIET.sounds(policy[None])[0, :2].tolist() == [1.0, 1.0]
    for motor in (7, 8):
        unvoiced = policy.copy()
        unvoiced[[motor, motor + 9]] = 0.0
        assert not QUIET.sounds(unvoiced[None]).any()


@pytest.mark.parametrize("place", CLOSURES)
def test_nothing_is_heard_while_the_tract_is_closed(place: str) -> None:
    vocalisation = QUIET.vocalise(spoken(place, "a"))
    closed = vocalisation.heard == 0
    assert closed.any()
    assert not closed.all()
    assert np.isnan(vocalisation.formants[:, closed]).all()
    assert (vocalisation.formants[:, ~closed] > 0).all()
    assert vocalisation.heard[-1] == 1


def test_a_vowel_is_heard_with_its_formants() -> None:
    heard = in_hertz(QUIET.sounds(spoken("heard", "heard")[None])[0])
    assert heard[:, 0] == pytest.approx([490, 1350], rel=0.05)
    assert heard[:, 1] == pytest.approx([490, 1350], rel=0.05)


def test_silent_frames_count_as_0() -> None:
    heard, formants = np.zeros((30, 1)), np.full((2, 30, 1), 1e9)
    heard[:6], formants[:, :6] = 1, np.array([1000, 1500])[:, None, None]
    sound = dict(zip(SOUND, perceived(heard, formants)[0].tolist(), strict=True))
    assert sound == pytest.approx(
        {"I(1)": 0.4, "I(2)": 0, "F1(1)": 0.4, "F1(2)": 0, "F2(1)": 0, "F2(2)": 0}
    )


def test_one_listens_twice_for_150_ms() -> None:
    times = frame_times()
    assert len(times) == 30
    assert times[0] > 0.25
    assert times[14] < 0.40
    assert times[15] > 0.65
    assert times[-1] < 0.80


def test_sounds_lie_within_their_box_but_for_noise() -> None:
    box = QUIET.task.outcome_spaces["sound"]
    assert box.contains(QUIET.sounds(random_policies(2000, seed=3)))


def test_a_policy_of_another_shape_is_refused() -> None:
    with pytest.raises(SpaceError, match=r"expected \(n, 18\)"):
        QUIET.execute(np.zeros(17))
    assert QUIET.execute_batch([]) == []


def test_every_articulation_is_within_the_bounds_of_commands() -> None:
    assert np.abs(list(articulations().values())).max() <= 3
