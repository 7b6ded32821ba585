import numpy as np
import pytest

from sgim.environments import AirHockey, hockey_teachers
from sgim.environments.hockey_teacher import hockey_demonstrations, select_hits
from sgim.errors import TeacherError
from sgim.records import Goal, Outcome
from sgim.teachers import DemonstrationSet

TABLE = AirHockey()
SHOWN = hockey_demonstrations()


def made_up(count: int, seed: int = 0) -> tuple[np.ndarray, list[Outcome]]:
    """Trials that hit at random, or do not; each policy holds where it hit."""
    rng = np.random.default_rng(seed)
    policies = np.zeros((count, 14))
    policies[:, 0] = rng.uniform(-1, 1, count)
    return policies, [{"hit": p[:1]} if i % 10 else {} for i, p in enumerate(policies)]


def test_the_teacher_shows_500_hits_spread_evenly_over_the_right_quarter() -> None:
    hits = np.array([d.outcome["hit"][0] for d in SHOWN])
    assert len(hits) == 500
    counts, _ = np.histogram(hits, np.linspace(0.5, 1.0, 11))
    assert counts.sum() == 500
    assert counts.min() >= 40
    assert counts.max() <= 60
    assert hits.max() > 0.95
    assert len(np.unique(hits)) == 500


def test_what_is_shown_can_be_repeated() -> None:
    for demonstration in SHOWN[::25]:
        TABLE.task.check_policy(demonstration.policy)
        again = TABLE.execute(demonstration.policy)["hit"]
        np.testing.assert_array_equal(again, demonstration.outcome["hit"])


def test_the_demonstration_nearest_to_the_goal_is_shown() -> None:
    teacher = hockey_teachers()["expert"]
    assert isinstance(teacher, DemonstrationSet)
    for goal in (0.55, 0.8, 0.99):
        shown = teacher.demonstrate(Goal("hit", np.array([goal])), np.random.default_rng(0))
        assert shown.outcome["hit"][0] == pytest.approx(goal, abs=0.01)
    far = teacher.demonstrate(Goal("hit", np.array([-1.0])), np.random.default_rng(0))
    assert far.outcome["hit"][0] == min(d.outcome["hit"][0] for d in SHOWN)


def test_hits_are_chosen_one_a_slot_where_every_slot_was_reached() -> None:
    policies, outcomes = made_up(4000)
    chosen = select_hits(policies, outcomes, np.random.default_rng(0), count=20)[:, 0]
    np.testing.assert_array_equal(np.floor((chosen - 0.5) / 0.025), np.arange(20))
    again = select_hits(policies, outcomes, np.random.default_rng(0), count=20)[:, 0]
    other = select_hits(policies, outcomes, np.random.default_rng(1), count=20)[:, 0]
    np.testing.assert_array_equal(chosen, again)
    assert not np.array_equal(chosen, other)


def test_slots_that_nobody_reached_take_the_nearest_hit_that_is_left() -> None:
    policies = np.zeros((5, 14))
    policies[:, 0] = [0.5, 0.51, 0.52, 0.95, 0.96]
    outcomes: list[Outcome] = [{"hit": p[:1]} for p in policies]
    chosen = select_hits(policies, outcomes, np.random.default_rng(0), count=5)
    np.testing.assert_array_equal(chosen[:, 0], policies[:, 0])


def test_of_movements_that_end_at_the_same_place_only_one_is_chosen() -> None:
    policies = np.zeros((6, 14))
    policies[:, 0] = [0.6, 0.6, 0.6, 0.61, 0.61, 0.9]
    outcomes: list[Outcome] = [{"hit": p[:1]} for p in policies]
    chosen = select_hits(policies, outcomes, np.random.default_rng(0), count=3)
    np.testing.assert_array_equal(chosen[:, 0], [0.6, 0.61, 0.9])
    with pytest.raises(TeacherError, match="only 3 different"):
        select_hits(policies, outcomes, np.random.default_rng(0), count=4)


def test_too_few_hits_are_an_error_that_says_how_many() -> None:
    policies, outcomes = made_up(10)
    with pytest.raises(TeacherError, match=r"500 hits in \[0.5, 1.0\] .* only \d different"):
        select_hits(policies, outcomes, np.random.default_rng(0))
