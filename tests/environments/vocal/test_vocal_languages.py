"""What is spoken around the learner, and how vocalisations are classified."""

import numpy as np
import pytest

from sgim.environments.vocal import ambient_language, vocal_goals
from sgim.environments.vocal.classes import CLASSES, PHONES, TYPES, classes, phones, types
from sgim.environments.vocal.languages import DESCRIPTIONS, LANGUAGES
from sgim.environments.vocal.world import VocalTract
from sgim.records import Goal
from sgim.testing import check_teacher

I1, I2, F11, F12, F21, F22 = range(6)
TASK = VocalTract().task


def sound(first: float, second: float) -> list[float]:
    return [first, second, 0.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", LANGUAGES)
def test_a_language_is_two_articulated_sounds_that_can_be_goals(name: str) -> None:
    sounds = ambient_language(name).sounds
    assert sounds.shape == (2, 6)
    assert (classes(sounds) == CLASSES.index("articulated")).all()
    assert TASK.outcome_spaces["sound"].contains(sounds)
    assert name in DESCRIPTIONS


def test_the_first_language_differs_in_the_second_first_formant() -> None:
    apart = np.abs(np.diff(ambient_language("1").sounds, axis=0))[0]
    assert apart[F12] > 0.5 > 10 * apart[F11]
    assert (ambient_language("1").sounds[:, I1] < 0.5).all()
    assert (ambient_language("1").sounds[:, I2] > 0.9).all()


def test_the_second_language_differs_in_the_first_first_formant() -> None:
    apart = np.abs(np.diff(ambient_language("2").sounds, axis=0))[0]
    assert apart[F11] > 0.5 > 10 * apart[F12]


def test_the_third_language_is_localised() -> None:
    sounds = ambient_language("3").sounds
    assert (sounds[:, F11] < 0).all()
    assert (sounds[:, F22] > 0).all()
    apart = [np.linalg.norm(np.diff(ambient_language(name).sounds, axis=0)) for name in "123"]
    assert apart[2] < min(apart[:2]) / 2


def test_a_language_is_heard_as_outcomes_only_each_as_often() -> None:
    teacher = ambient_language("1")
    check_teacher(teacher, TASK)
    rng = np.random.default_rng(0)
    shown = [teacher.demonstrate(Goal("sound", np.zeros(6)), rng) for _ in range(400)]
    assert all(d.policy is None and d.trajectory is None for d in shown)
    first = sum((d.outcome["sound"] == teacher.sounds[0]).all() for d in shown)
    assert 150 < first < 250


def test_a_phone_is_none_below_a_tenth_and_a_vowel_above_nine_tenths() -> None:
    sounds = np.array([sound(x, 1 - x) for x in (0.0, 0.09, 0.1, 0.5, 0.9, 0.91, 1.0)])
    found = [PHONES[phone] for phone in phones(sounds)[:, 0].tolist()]
    assert found == ["N", "N", "C", "C", "C", "V", "V"]


def test_types_and_classes_are_those_of_the_two_phones() -> None:
    level = {"N": 0.0, "C": 0.5, "V": 1.0}
    sounds = np.array([sound(level[first], level[second]) for first, second in TYPES])
    assert types(sounds).tolist() == [*range(9)]
    named = {t: CLASSES[c] for t, c in zip(TYPES, classes(sounds).tolist(), strict=True)}
    assert {t for t, c in named.items() if c == "no phonation"} == {"NN"}
    assert {t for t, c in named.items() if c == "unarticulated"} == {"VN", "NV", "CN", "NC"}
    assert {t for t, c in named.items() if c == "articulated"} == {"CV", "VC", "VV", "CC"}


def test_the_benchmark_has_every_type_of_sound() -> None:
    goals = np.array([goal.point for goal in vocal_goals()])
    counts = np.bincount(types(goals), minlength=len(TYPES))
    assert counts[0] == 1
    assert (counts[1:] == 12).all()
    assert TASK.outcome_spaces["sound"].contains(goals)
