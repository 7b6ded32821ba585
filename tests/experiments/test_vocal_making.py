"""Articulations and anatomies can be found again, and another speaker's can be fitted."""

import numpy as np
import pytest

from sgim.environments.vocal.anatomy import ADULT
from sgim.environments.vocal.articulations import articulations, formants_of
from sgim.experiments.make_vocal_anatomy import (
    CHILD,
    Fitted,
    fit,
    scaled,
    shares,
)
from sgim.experiments.make_vocal_anatomy import formants_of as resonances
from sgim.experiments.make_vocal_articulations import search, vowel_cost
from sgim.experiments.make_vocal_goals import spread
from sgim.streams import Streams

NEUTRAL = np.zeros((7, 1))


def test_a_tract_of_half_the_size_speaks_about_an_octave_higher() -> None:
    ratio = resonances(scaled(ADULT, 0.5), NEUTRAL) / resonances(ADULT, NEUTRAL)
    assert ratio[:, 0] == pytest.approx([2, 2], rel=0.1)
    same = shares(scaled(ADULT, 0.5), np.random.default_rng(0).uniform(-3, 3, (7, 500)))
    whole = shares(ADULT, np.random.default_rng(0).uniform(-3, 3, (7, 500)))
    assert same == pytest.approx(whole, abs=0.05)


def test_the_articulation_of_a_vowel_is_found_again() -> None:
    positions, cost = search(vowel_cost(ADULT, formants_of("a")), Streams(5)("test"))
    found = resonances(ADULT, positions[:, None])[:, 0]
    assert found == pytest.approx(formants_of("a"), rel=0.01)
    assert cost < 0.01
    table = articulations()["a"][:, None]
    assert resonances(ADULT, table)[:, 0] == pytest.approx(formants_of("a"), rel=0.01)


@pytest.fixture(scope="module")
def child() -> Fitted:
    vowels = {name: CHILD[name] for name in ("heed", "hod", "who'd")}
    return fit(scaled(ADULT, 0.72), vowels, Streams(0), rounds=1, steps=3)


def test_a_child_can_be_fitted(child: Fitted) -> None:
    assert max(np.abs(errors).max() for errors in child.errors.values()) < 0.05
    for name, positions in child.articulations.items():
        found = resonances(child.anatomy, positions[:, None])[:, 0]
        assert found / np.array(CHILD[name]) - 1 == pytest.approx(child.errors[name], abs=1e-3)
    opened, *closed = shares(child.anatomy, np.random.default_rng(0).uniform(-3, 3, (7, 4000)))
    assert 1 / 3 < opened < 2 / 3
    assert min(closed) > 0.15


def test_spread_sounds_are_far_from_each_other() -> None:
    sounds = np.random.default_rng(0).normal(size=(300, 6))
    far = spread(sounds, 10)
    apart = np.linalg.norm(far[:, None] - far[None], axis=2)[np.triu_indices(10, 1)]
    usual = np.linalg.norm(sounds[:10, None] - sounds[None, :10], axis=2)[np.triu_indices(10, 1)]
    assert len(np.unique(far, axis=0)) == 10
    assert apart.min() > usual.min()
