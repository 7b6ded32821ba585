"""The recogniser as a model: competence by section 2.2.1, from the latest picture of a label."""

import pytest

from sgim.errors import UnknownNameError
from sgim.recognition import FEATURES, Eye, Recogniser, Recognition, RecognitionModel, Settings
from sgim.records import Goal, Trial
from sgim.spaces import Choices
from sgim.task import Task
from sgim.testing import check_model
from tests.recognition.made_up import GREEN, RED, YELLOW, picture

TOYS = Choices(["flag", "bus"])
TASK = Task(Choices(["push flag", "push bus"]), {"view": FEATURES, "toy": TOYS},
            goal_spaces={"toy": TOYS})  # fmt: skip


def trial(toy: str, colours: tuple[tuple[int, int, int], ...], seed: int = 0) -> Trial:
    view = Eye().look(picture(colours, seed)).arrays
    return Trial(f"push {toy}", {"view": view, "toy": toy})


def taught() -> RecognitionModel:
    model = RecognitionModel("view", "toy", Recogniser(Settings(new_view=1.1)))
    for colours in ((RED, GREEN), (GREEN,), (YELLOW,)):
        model.update(trial("flag", colours))
    return model


@pytest.mark.parametrize(
    ("first", "second", "competence"),
    [
        ("flag", "flag", 3 * 0.8 - 1),
        ("flag", "bus", 3 * 0.8 / 1.5 - 1),
        ("flag", None, 3 * 0.8 / 1.5 - 1),
        ("bus", "flag", 3 * 0.5 / 1.8 - 1),
        ("bus", "bus", -1.0),
        (None, None, -1.0),
    ],
)
def test_competence_is_that_of_the_two_best_views(
    first: str | None, second: str | None, competence: float
) -> None:
    model = taught()
    assert model.recogniser.known_views("flag") == 3
    shown = model.shown(Recognition(first, 0.8, second, 0.5), "flag")
    assert shown == pytest.approx(competence)


def test_competence_is_shown_by_the_latest_picture_once_it_has_been_learned() -> None:
    model = RecognitionModel("view", "toy")
    flag, bus = Goal("toy", "flag"), Goal("toy", "bus")
    assert model.competence(flag, None) == -1
    model.update(trial("flag", (RED, GREEN)))
    assert model.competence(flag, None) == pytest.approx(0.0, abs=1e-6)  # one view, likelihood 1
    before = model.competence(flag, None)
    model.update(trial("bus", (YELLOW,)))
    assert model.competence(flag, None) == before
    assert model.competence(bus, None) > -1
    latest = model.recogniser.recognise(Eye().look(picture((YELLOW,))))
    assert model.competence(bus, None) == model.shown(latest, "bus")


def test_competence_can_be_tested_before_a_picture_is_learned() -> None:
    model = RecognitionModel("view", "toy", tested="before")
    model.update(trial("bus", (YELLOW,)))
    model.update(trial("flag", (RED, GREEN)))
    unseen = trial("flag", (YELLOW,), 1)
    before = model.recogniser.recognise(Eye().look(picture((YELLOW,), 1)))
    assert before.label == "bus"
    expected = model.shown(before, "flag")
    model.update(unseen)
    assert model.competence(Goal("toy", "flag"), None) == expected


def test_a_trial_without_a_view_or_a_label_teaches_nothing() -> None:
    model = RecognitionModel("view", "toy")
    whole = trial("flag", (RED,))
    for kind in ("view", "toy"):
        model.update(Trial("push flag", {kind: whole.outcome[kind]}))
    model.update(Trial("push flag", {}))
    assert model.recogniser.labels == ()
    with pytest.raises(UnknownNameError, match="unknown label 'flag'"):
        model.shown(Recognition("flag", 1.0, None, 0.0), "flag")


def test_the_model_keeps_the_promises_of_models() -> None:
    check_model(lambda: RecognitionModel("view", "toy"), TASK)
