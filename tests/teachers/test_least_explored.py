import numpy as np
import pytest

from sgim.errors import TeacherError, UnknownNameError
from sgim.records import Demonstration
from sgim.spaces import Box, Choices
from sgim.task import Task
from sgim.teachers import LeastExplored
from sgim.testing import check_teacher

TASK = Task(Box(0, 1), {"spot": Box([-1, -1], [1, 1]), "label": Choices(["a", "b"])})
SPOTS = [(-0.9, -0.9), (-0.6, -0.6), (0.1, 0.1), (0.9, 0.1)]
SHOWN = [Demonstration({"spot": spot}, policy=[i / 4]) for i, spot in enumerate(SPOTS)]


def teacher() -> LeastExplored:
    return LeastExplored(SHOWN, TASK, kind="spot", tile=0.5)


def shown_by(who: LeastExplored, requests: int = 40) -> set[float]:
    """The policies shown over some requests."""
    rngs = map(np.random.default_rng, range(requests))
    return {float(who.demonstrate(None, rng).policy[0]) for rng in rngs}


def test_it_keeps_the_promises_of_a_teacher() -> None:
    check_teacher(teacher(), TASK)


def test_before_anything_is_explored_every_demonstration_may_be_shown() -> None:
    assert shown_by(teacher()) == {0.0, 0.25, 0.5, 0.75}


def test_it_shows_what_the_learner_has_explored_least() -> None:
    who = teacher()
    who.observe({"spot": np.array([0.3, 0.4])})
    who.observe({"label": "a"})
    who.observe({})
    assert shown_by(who) == {0.0, 0.25, 0.75}
    who.observe({"spot": np.array([-0.8, -0.7])})
    assert shown_by(who) == {0.75}
    who.observe({"spot": np.array([0.6, 0.4])})
    who.observe({"spot": np.array([0.3, 0.4])})
    assert shown_by(who) == {0.0, 0.25, 0.75}


def test_outcomes_where_it_has_nothing_to_show_do_not_matter() -> None:
    who = teacher()
    for _ in range(5):
        who.observe({"spot": np.array([-0.9, 0.9])})
        who.observe({"spot": np.array([70.0, -40.0])})
    assert shown_by(who) == {0.0, 0.25, 0.5, 0.75}


@pytest.mark.parametrize(("kind", "tile"), [("label", 0.5), ("spot", 0.0), ("spot", np.inf)])
def test_what_cannot_be_tiled_is_refused(kind: str, tile: float) -> None:
    with pytest.raises(TeacherError, match="cannot be tiled"):
        LeastExplored(SHOWN, TASK, kind=kind, tile=tile)


def test_demonstrations_and_kinds_are_checked() -> None:
    with pytest.raises(UnknownNameError, match="Did you mean 'spot'"):
        LeastExplored(SHOWN, TASK, kind="spto", tile=0.5)
    with pytest.raises(TeacherError, match="demonstration 0 has no outcome 'spot'"):
        LeastExplored([Demonstration({"label": "a"}, policy=[0.0])], TASK, kind="spot", tile=0.5)
