"""A recogniser learns one labelled picture at a time, and says what others are taken for."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sgim.errors import SgimError, UnknownNameError
from sgim.recognition import (
    Eye,
    NothingLearnedError,
    Picture,
    Recogniser,
    Settings,
)
from sgim.recognition.dictionary import Dictionary
from sgim.recognition.saving import FORMAT, SavedRecogniserError
from tests.recognition.made_up import GREEN, RED, YELLOW, picture

KINDS = {"flag": (RED, GREEN), "bus": (YELLOW,), "cherry": (RED,)}


def taught(pictures: int = 3, **settings: Any) -> Recogniser:
    recogniser = Recogniser(Settings(**settings))
    for seed in range(pictures):
        for label, colours in KINDS.items():
            recogniser.learn(picture(colours, seed), label)
    return recogniser


def test_new_pictures_of_what_was_learned_are_recognised() -> None:
    recogniser = taught()
    assert recogniser.labels == ("flag", "bus", "cherry")
    for seed in range(100, 105):
        for label, colours in KINDS.items():
            found = recogniser.recognise(picture(colours, seed))
            assert found.label == label
            assert 0 < found.second_likelihood <= found.likelihood <= 1


def test_the_picture_learned_last_is_found_again() -> None:
    recogniser = Recogniser(Settings(new_view=1.1))
    for label, colours in KINDS.items():
        assert recogniser.learn(picture(colours), label)
        found = recogniser.recognise(picture(colours))
        assert found.label == label
        assert found.likelihood == pytest.approx(1)


def test_a_picture_unlike_the_objects_views_is_a_new_view() -> None:
    recogniser = taught()
    known = recogniser.known_views("bus")
    assert not recogniser.learn(picture(KINDS["bus"], 0), "bus")
    assert recogniser.known_views("bus") == known
    assert recogniser.learn(picture((GREEN,), 0), "bus")
    assert recogniser.known_views("bus") == known + 1


def test_nothing_is_recognised_before_something_is_learned() -> None:
    with pytest.raises(NothingLearnedError, match=r"learn.* comes before recognise"):
        Recogniser().recognise(picture((RED,)))


def test_a_picture_of_nothing_is_taken_for_nothing_and_can_be_learned() -> None:
    nothing, recogniser = picture((RED,), height=0.0), Recogniser()
    recogniser.learn(nothing, "nothing")
    assert recogniser.recognise(nothing).label is None
    recogniser.learn(picture((RED,)), "cherry")
    assert recogniser.recognise(nothing).label is None
    assert recogniser.recognise(picture((RED,))).label == "cherry"
    assert recogniser.recognise(picture((RED,))).second is None


def test_unknown_labels_and_what_is_no_picture_are_refused() -> None:
    recogniser = taught(1)
    with pytest.raises(UnknownNameError, match=r"'cherries'\. Did you mean 'cherry'"):
        recogniser.known_views("cherries")
    with pytest.raises(SgimError, match="label is 3, expected a word"):
        recogniser.learn(picture((RED,)), 3)  # type: ignore[arg-type]
    with pytest.raises(SgimError, match=r"a ndarray cannot be looked at, expected a Picture"):
        recogniser.recognise(np.zeros((48, 64, 3)))  # type: ignore[arg-type]


def test_a_gallery_says_the_same_however_long_it_has_been_kept() -> None:
    features = [Eye().look(picture(KINDS[k], seed)) for k in KINDS for seed in range(50, 54)]
    recogniser = Recogniser(Settings(point_radius=0.4, colour_radius=8))
    kept = None
    for seed in range(4):
        for label, colours in KINDS.items():
            recogniser.learn(picture(colours, seed), label)
            kept = kept or recogniser.gallery(features)
            fresh = recogniser.recognise_all(recogniser.gallery(features))
            assert recogniser.recognise_all(kept) == fresh
            assert [recogniser.recognise(one) for one in features] == fresh


def test_words_are_farther_apart_than_the_radius_and_never_change() -> None:
    rng = np.random.default_rng(0)
    dictionary = Dictionary(3, 0.5)
    vectors = rng.random((300, 3)).astype(np.float32)
    assigned = dictionary.add(vectors)
    words = dictionary.words.copy()
    apart = np.linalg.norm(words[:, None] - words[None], axis=2) + np.eye(len(words))
    assert apart.min() > 0.5 - 1e-5
    assert np.linalg.norm(vectors - words[assigned], axis=1).max() <= 0.5 + 1e-5
    dictionary.add(5 + vectors)
    assert np.array_equal(dictionary.words[: len(words)], words)
    assert (dictionary.find(vectors + np.float32(50)) == -1).all()
    assert (Dictionary(3, 0.5).find(vectors) == -1).all()


def test_a_saved_recogniser_answers_and_goes_on_learning_as_before(tmp_path: Path) -> None:
    path, recogniser = tmp_path / "toys.npz", taught(point_radius=0.5)
    recogniser.save(path)
    again = Recogniser.load(path)
    assert again.settings == recogniser.settings
    assert again.labels == recogniser.labels
    for seed in range(20, 23):
        for label, colours in KINDS.items():
            shown = picture(colours, seed)
            assert again.recognise(shown) == recogniser.recognise(shown)
            assert again.learn(shown, label) == recogniser.learn(shown, label)
            assert again.recognise(shown) == recogniser.recognise(shown)
    Recogniser().save(path)
    assert Recogniser.load(path).labels == ()


def test_a_recogniser_of_a_newer_version_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "toys.npz"
    taught(1).save(path)
    with np.load(path) as kept:
        arrays = dict(kept)
    about = json.loads(arrays["about"].tobytes())
    about["format"] = FORMAT + 1
    arrays["about"] = np.frombuffer(json.dumps(about).encode(), np.uint8)
    np.savez(path, **arrays)
    with pytest.raises(SavedRecogniserError, match=r"format 2.*saved by a newer version"):
        Recogniser.load(path)


@pytest.mark.parametrize("damage", ["text", "cut", "other", "pickle"])
def test_what_is_no_recogniser_is_refused(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "toys.npz"
    taught(1).save(path)
    match damage:
        case "text":
            path.write_text("toys")
        case "cut":
            path.write_bytes(path.read_bytes()[:300])
        case "other":
            np.savez(path, a=np.zeros(3))
        case "pickle":
            np.savez(path, about=np.array([{"format": 1}], dtype=object))
    with pytest.raises(SavedRecogniserError, match="no saved recogniser, or is damaged"):
        Recogniser.load(path)


def test_pictures_with_many_pixels_are_looked_at_like_others() -> None:
    small = picture((RED, GREEN))
    large = Picture(
        np.kron(small.colours, np.ones((4, 4, 1), np.uint8)),
        np.kron(small.depth, np.ones((4, 4), np.float32)),
    )
    features = Eye().look(large)
    assert len(features.points) <= Eye().most_points
    assert (features.colours[:, 1] < 0).any()
    assert (features.colours[:, 1] > 20).any()
