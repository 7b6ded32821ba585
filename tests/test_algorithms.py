"""Named learners are made by name or by function, and can be made again from their recipe."""

import numpy as np
import pytest

import sgim
from sgim import algorithms
from sgim.configurations import MODERN
from sgim.environments import ThrowingArm
from sgim.environments.arm import PlanarArm
from sgim.errors import SgimError, UnknownNameError
from sgim.outcome import UniformGoals

TASK = ThrowingArm().task


@pytest.mark.parametrize("name", algorithms.ALGORITHMS)
@pytest.mark.parametrize("configuration", ["modern", "thesis"])
def test_a_recipe_makes_the_same_learner_again(name: str, configuration: str) -> None:
    teachers = [] if name in ("random", "random-goal-babbling", "sagg-riac") else ["T1"]
    made = algorithms.make(name, TASK, teachers, configuration=configuration, seed=5)
    again = algorithms.from_recipe(TASK, made.recipe or {})
    assert again.recipe == made.recipe
    assert list(again.strategy.modes) == list(made.strategy.modes)
    one, other = made.ask(), again.ask()
    assert (one.mode, one.request is None) == (other.mode, other.request is None)
    if one.request is None:
        assert (one.policy == other.policy).all()


def test_one_teacher_may_be_named_alone() -> None:
    learner = sgim.algorithms.sgim_acts(TASK, "expert")
    assert learner.teachers == ("expert",)
    assert list(learner.strategy.modes) == ["autonomous", "mimic expert", "emulate expert"]


def test_learners_of_one_teacher_refuse_none_and_several() -> None:
    with pytest.raises(SgimError, match="exactly one teacher, but 2 are given: T1, T2"):
        algorithms.mimicry(TASK, ["T1", "T2"])
    with pytest.raises(SgimError, match="exactly one teacher, but 0 are given: none"):
        algorithms.emulation(TASK, [])
    with pytest.raises(SgimError, match="use sagg-riac"):
        algorithms.sgim_acts(TASK, [])


@pytest.mark.parametrize("name", ["uniform-choice", "round-robin", "demonstrations-first"])
def test_controls_need_teachers(name: str) -> None:
    with pytest.raises(SgimError, match="name one or more"):
        algorithms.make(name, TASK)


def test_demonstrations_come_first_as_often_as_the_configuration_says() -> None:
    learner = algorithms.make(
        "demonstrations-first", TASK, ["T1", "T2"], configuration="modern,first_demonstrations=5"
    )
    modes = []
    for _ in range(40):
        plan = learner.ask()
        modes.append(plan.mode)
        learner.expire(plan)
    expected = ["mimic T1", "mimic T2", "mimic T1", "mimic T2", "mimic T1"]
    assert [m for m in modes if m != "autonomous"] == expected


def test_unknown_names_are_answered_with_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match="Did you mean 'sagg-riac'"):
        algorithms.make("sag-riac", TASK)
    with pytest.raises(UnknownNameError, match="Did you mean 'modern'"):
        algorithms.make("random", TASK, configuration="modem")
    with pytest.raises(UnknownNameError, match="Did you mean 'prior'"):
        algorithms.from_recipe(
            TASK,
            {
                "learner": "random",
                "teachers": [],
                "seed": 0,
                "configuration": {**MODERN.describe(), "priors": 1},
            },
        )


def test_an_interest_map_of_ones_own_takes_the_place_of_the_algorithms() -> None:
    seen = {}

    def make_map(costs):  # type: ignore[no-untyped-def]
        seen.update(costs)
        return UniformGoals(TASK.goal_spaces)

    learner = algorithms.sgim_acts(TASK, "T1", interest=make_map)
    assert seen == {"autonomous": 1.0, "mimic T1": 2.0, "emulate T1": 2.0}
    assert learner.recipe is None
    assert learner.ask().id == 0


def test_sagg_riac_has_a_control_that_does_not_choose_its_goals() -> None:
    task = PlanarArm(2).task
    control = algorithms.make("sagg-riac", task, configuration="modern,interest=uniform", seed=3)
    points = []
    for _ in range(1500):
        plan = control.ask()
        assert plan.goal is not None
        points.append(plan.goal.point)
        # All that comes out is in one corner, so that interest would not be even.
        control.tell(plan, {"hand": task.outcome_spaces["hand"].low + 0.01})
    quarters = np.histogram2d(*np.transpose(points), bins=2)[0] / len(points)
    assert quarters == pytest.approx(np.full((2, 2), 0.25), abs=0.05)
