from pathlib import Path

import numpy as np
import pytest

from sgim.environments import FishingRod, fishing_demonstrations, fishing_teacher
from sgim.environments.fishing import demonstrators
from sgim.environments.fishing.demonstrators import DEMONSTRATORS, write_policies, write_recordings
from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import AMPLITUDES, FISHING, HOME
from sgim.environments.fishing.reaching import reaching
from sgim.errors import SgimError, UnknownNameError
from sgim.records import Demonstration, Outcome, Trajectory
from sgim.spaces import FloatArray

USUAL = FishingRod()
STILL = FishingRod(0.0)


def landings_of(demonstrator: int) -> FloatArray:
    return np.array([d.outcome["float"] for d in fishing_demonstrations(demonstrator)])


def recordings(demonstrator: int) -> list[Trajectory]:
    shown = [d.trajectory for d in fishing_demonstrations(demonstrator)]
    return [recording for recording in shown if recording is not None]


@pytest.mark.parametrize("demonstrator", [1, 2, 3])
def test_127_demonstrations_spread_over_what_can_be_reached(demonstrator: int) -> None:
    landings = landings_of(demonstrator)
    assert landings.shape == (127, 2)
    assert (np.abs(landings) < 1).all()
    apart = np.linalg.norm(landings[:, None] - landings, axis=2)
    np.fill_diagonal(apart, np.inf)
    assert np.median(apart.min(axis=1)) > 0.05
    quarters = {(bool(x > 0), bool(y > 0)) for x, y in landings}
    assert len(quarters) == 4


@pytest.mark.parametrize("demonstrator", [1, 2])
def test_what_a_learner_shows_are_policies(demonstrator: int) -> None:
    for shown in fishing_demonstrations(demonstrator):
        assert shown.trajectory is None
        USUAL.task.check_policy(shown.policy)


def test_kinaesthetic_demonstrations_are_smooth_recordings_of_one_shape() -> None:
    assert all(shown.policy is None for shown in fishing_demonstrations(3))
    found = recordings(3)
    assert len(found) == 127
    for recording in found:
        assert (recording.joints, recording.unit) == (JOINTS, "rad")
        np.testing.assert_allclose(recording.positions[0], HOME, atol=1e-6)
        assert 0.8 <= recording.times[-1] <= 3.0
        moved = recording.positions[-1] - HOME
        assert (np.abs(moved) <= AMPLITUDES + 1e-6).all()
        shares = (recording.positions - HOME) / moved
        assert (np.diff(shares, axis=0) > -1e-4).all()
        np.testing.assert_allclose(shares, shares[:, :1].repeat(6, axis=1), atol=1e-3)


def test_a_kinaesthetic_demonstration_led_again_lands_where_it_did() -> None:
    for shown in fishing_demonstrations(3)[::12]:
        assert shown.trajectory is not None
        again = STILL.follow(shown.trajectory)["float"]
        np.testing.assert_allclose(again, shown.outcome["float"], atol=1e-3)


def test_what_the_robot_makes_of_recordings_lands_where_they_did_and_repeats() -> None:
    rng = np.random.default_rng(0)
    residuals, still, usual = [], [], []
    for shown in fishing_demonstrations(3)[::6]:
        policy, residual = FISHING.fit(shown.trajectory)  # type: ignore[arg-type]
        residuals.append(np.degrees(residual))
        for outcome, misses in (
            (STILL.execute(policy), still),
            (USUAL.execute(policy, None, rng), usual),
        ):
            landing = outcome.get("float", np.full(2, np.inf))
            misses.append(np.linalg.norm(landing - shown.outcome["float"]))
    assert max(residuals) < 4
    assert np.median(residuals) < 1
    assert np.median(still) < 0.03
    assert np.median(usual) < 0.05


def repeated(demonstrator: int) -> float:
    """How far demonstrated movements land from where they did, with noise, in the median."""
    rng = np.random.default_rng(0)
    misses = []
    for shown in fishing_demonstrations(demonstrator)[::3]:
        again: Outcome = (
            USUAL.follow(shown.trajectory, rng)
            if shown.trajectory is not None
            else USUAL.execute(shown.policy, None, rng)
        )
        landed = "float" in again
        apart = np.linalg.norm(again["float"] - shown.outcome["float"]) if landed else 1.0
        misses.append(float(apart))
    return float(np.median(misses))


def test_what_is_shown_can_be_repeated_and_best_what_was_chosen_for_it() -> None:
    random, reliable, kinaesthetic = (repeated(demonstrator) for demonstrator in (1, 2, 3))
    assert reliable < random < 0.1
    assert kinaesthetic < 0.06


def test_demonstrators_4_and_5_share_out_what_3_shows() -> None:
    behind, ahead = landings_of(4), landings_of(5)
    assert (behind[:, 1] < 0).all()
    assert (ahead[:, 1] >= 0).all()
    assert len(behind) + len(ahead) == 127
    assert min(len(behind), len(ahead)) > 25


def test_demonstrator_3_covers_the_disc_that_it_can_lead_the_float_to() -> None:
    landings = landings_of(3)
    assert landings.min(axis=0).max() < -0.9
    assert landings[:, 0].max() > 0.9
    assert landings[:, 1].max() > 0.5


@pytest.mark.parametrize("demonstrator", DEMONSTRATORS)
def test_a_teacher_shows_what_the_learner_has_explored_least(demonstrator: int) -> None:
    teacher = fishing_teacher(demonstrator, USUAL.task)
    landings = landings_of(demonstrator)
    for landing in landings[1:]:
        if np.abs(landing - landings[0]).max() > 1 / 6:
            teacher.observe({"float": landing})  # type: ignore[attr-defined]
    for number in range(10):
        shown = teacher.demonstrate(None, np.random.default_rng(number))
        assert shown is not None
        assert np.abs(shown.outcome["float"] - landings[0]).max() <= 1 / 6


def test_an_unknown_demonstrator_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="unknown demonstrator 6"):
        fishing_demonstrations(6)


def test_missing_data_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demonstrators, "RECORDINGS", "none.npz")
    with pytest.raises(SgimError, match=r"no data 'none\.npz'"):
        fishing_demonstrations(3)


def test_what_is_written_is_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "data").mkdir()
    monkeypatch.setattr(demonstrators, "files", lambda package: tmp_path)
    recording = reaching(HOME + 0.3 * AMPLITUDES, 1.1)
    write_recordings(
        tmp_path / "data" / demonstrators.RECORDINGS,
        [Demonstration({"float": np.array([0.1, y])}, trajectory=recording) for y in (-0.2, 0.2)],
        "float",
    )
    behind, ahead = fishing_demonstrations(3)
    assert behind.trajectory is not None
    np.testing.assert_array_equal(behind.trajectory.positions, recording.positions)
    np.testing.assert_array_equal(behind.trajectory.times, recording.times)
    np.testing.assert_array_equal(ahead.outcome["float"], [0.1, 0.2])
    policy = np.linspace(0, 1, 25)
    write_policies(
        tmp_path / "data" / demonstrators.LEARNED[1],
        [Demonstration({"float": np.array([0.1, 0.2])}, policy=policy)],
    )
    np.testing.assert_array_equal(fishing_demonstrations(1)[0].policy, policy)
