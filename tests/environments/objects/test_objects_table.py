"""Toys come to rest where physics says, and the camera sees them as they lie."""

import hashlib

import numpy as np
import pytest

from sgim.environments.objects import Caregiver, Nuisances, ToyTable
from sgim.environments.objects.nuisances import STILL
from sgim.environments.objects.table import ACTIONS
from sgim.errors import SpaceError
from sgim.recognition.outline import outline
from sgim.records import Goal
from sgim.streams import Streams
from sgim.testing import check_environment, check_teacher

TABLE = ToyTable()
CLEAR = ToyTable(STILL)
TOYS = TABLE.toys.labels
STREAMS = Streams(7)


def digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=6).hexdigest()


def test_the_table_keeps_the_promises_of_worlds() -> None:
    check_environment(TABLE, trials=6)


def test_caregivers_keep_the_promises_of_teachers() -> None:
    for bias in ("unbiased", "biased"):
        check_teacher(Caregiver(TABLE, bias), TABLE.task)


@pytest.mark.parametrize("toy", TOYS)
def test_toys_come_to_rest_on_the_table(toy: str) -> None:
    for action in ACTIONS:
        pose = TABLE.moved(toy, action, STREAMS(f"{action} {toy}"))
        assert 0.01 < pose[2] < 0.08
        assert np.linalg.norm(pose[3:]) == pytest.approx(1)
        height, turn = pose[2], pose[3:]
        later = TABLE.settled(toy, pose)
        assert later[2] == pytest.approx(height, abs=0.004)
        assert abs(later[3:] @ turn) > 0.97


def test_the_same_seed_gives_the_same_poses_and_pictures() -> None:
    poses, pictures = [], []
    for toy in TOYS:
        for action in ACTIONS:
            rng = STREAMS(f"pinned/{action} {toy}")
            pose = TABLE.moved(toy, action, rng)
            poses.append(np.round(pose, 4) + 0.0)
            pictures.append(TABLE.picture(toy, pose, rng).digest())
    assert digest(np.concatenate(poses).tobytes()) == "5d21092826c8"
    assert digest(b"".join(pictures)) == "43d0c075f9d3"


def test_a_picture_shows_the_toy_as_it_lies_wherever_it_came_to_rest() -> None:
    pose = TABLE.moved("car", "push", STREAMS("push"))
    picture = CLEAR.picture("car", pose, STREAMS("camera"))
    assert picture.colours.shape == (240, 320, 3)
    elsewhere = pose.copy()
    elsewhere[:2] += 3.0
    assert CLEAR.picture("car", elsewhere, STREAMS("camera")).digest() == picture.digest()
    rows, columns = np.nonzero(outline(picture))
    assert 2000 < len(rows) < 20000
    assert abs(columns.mean() - 160) < 25
    assert abs(rows.mean() - 120) < 40


@pytest.mark.parametrize("toy", TOYS)
def test_a_toy_looks_different_from_both_sides(toy: str) -> None:
    front, rear = (
        CLEAR.picture(toy, CLEAR.presented(toy, angle), STREAMS("camera")).colours.astype(int)
        for angle in (0.0, np.pi)
    )
    assert (np.abs(front - rear).sum(axis=2) > 60).sum() > 300


def test_each_nuisance_changes_the_picture_and_none_leaves_it_clear() -> None:
    pose = TABLE.moved("dog", "lift", STREAMS("lift"))

    def taken(**settings: float) -> bytes:
        table = ToyTable(Nuisances(**{**vars(STILL), **settings}))
        return table.picture("dog", pose, STREAMS("camera")).digest()

    clear = taken()
    assert clear == taken()
    for name, strength in (
        ("gain", 0.2),
        ("white_balance", 0.1),
        ("noise", 5.0),
        ("blur", 0.6),
        ("zoom", 0.2),
        ("shift", 0.02),
        ("depth_noise", 0.001),
    ):
        assert taken(**{name: strength}) != clear, name
    assert taken(bar=0.5) == clear
    assert taken(bar=0.5, bar_probability=1.0) != clear


def test_a_bar_hides_its_share_of_the_toy() -> None:
    pose = TABLE.moved("cubes", "lift", STREAMS("lift"))
    whole = outline(CLEAR.picture("cubes", pose, STREAMS("camera"))).sum()
    barred = ToyTable(Nuisances(**{**vars(STILL), "bar": 0.4, "bar_probability": 1.0}))
    seen = [outline(barred.picture("cubes", pose, STREAMS("bar", i))).sum() for i in range(30)]
    assert min(seen) > 0.5 * whole
    assert max(seen) > 0.9 * whole
    assert np.mean(seen) == pytest.approx(0.8 * whole, rel=0.08)


def test_a_biased_caregiver_always_shows_the_same_side() -> None:
    def turns(bias: str, side: float = 0.0) -> np.ndarray:
        found = []
        for i in range(8):
            poses: list[np.ndarray] = []
            table = ToyTable(STILL)
            table.seen = lambda toy, pose, rng, poses=poses: poses.append(pose) or {}  # type: ignore
            caregiver = Caregiver(table, bias, side)  # type: ignore[arg-type]
            caregiver.demonstrate(Goal("toy", "cubes"), STREAMS(bias, i))
            found.append(poses[0][3:])
        return np.array(found)

    front, rear = turns("biased"), turns("biased", np.pi)
    assert np.abs(front @ front[0]).min() > np.cos(0.3 / 2) - 1e-3
    assert np.abs(rear @ front[0]).max() < 0.2
    mixed = turns("unbiased")
    assert np.abs(mixed @ mixed[0]).min() < 0.8


def test_caregivers_show_what_is_asked_for_or_anything() -> None:
    caregiver = Caregiver(TABLE)
    shown = caregiver.demonstrate(Goal("toy", "bear"), STREAMS("asked"))
    assert shown.policy == "watch bear"
    assert shown.outcome["toy"] == "bear"
    toys = {caregiver.demonstrate(None, STREAMS("any", i)).outcome["toy"] for i in range(12)}
    assert len(toys) > 2
    with pytest.raises(SpaceError, match="Did you mean 'bear'"):
        caregiver.demonstrate(Goal("toy", "beer"), STREAMS("asked"))


def test_an_unknown_policy_is_refused() -> None:
    with pytest.raises(SpaceError, match="Did you mean 'push car'"):
        TABLE.execute("pull car", None, STREAMS("x"))
