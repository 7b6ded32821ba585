from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.helpers import report

from sgim.outcome.interest import EpisodeReport, UniformGoals
from sgim.policy.simple import RandomPolicies
from sgim.records import Demonstration, Goal
from sgim.spaces import Box
from sgim.strategy.modes import Mode
from sgim.strategy.news import News
from sgim.strategy.situation import Situation
from sgim.strategy.strategy import Aimless, JointChoice

PLACE = Box(0, 10)
RNG = np.random.default_rng(0)


def mode(name: str, teacher: str | None = None, **options: Any) -> Mode:
    return Mode(name, RandomPolicies(PLACE), 5, teacher=teacher, **options)


ALONE = mode("alone")
MODES = [ALONE, mode("mimic ann", "ann"), mode("emulate ann", "ann"), mode("mimic bob", "bob")]


class Scripted:
    """An interest map that chooses what it is told to, and notes what it is asked."""

    def __init__(self, choice: str) -> None:
        self.choice = choice
        self.offered: list[list[str]] = []
        self.contexts: list[Any] = []
        self.reports: list[EpisodeReport] = []

    def update(self, report: EpisodeReport) -> None:
        self.reports.append(report)

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: Any
    ) -> tuple[Goal, str]:
        self.offered.append(list(modes))
        self.contexts.append(context)
        name = self.choice if self.choice in modes else modes[0]
        return Goal("place", np.array([rng.random()])), name


def test_the_interest_map_chooses_mode_and_goal_together() -> None:
    interest = Scripted("mimic bob")
    strategy = JointChoice(MODES, interest, ALONE)
    context = np.array([0.5])
    chosen, goal, _ = strategy.choose(Situation(0, (), context), np.random.default_rng(3))
    assert chosen is MODES[3]
    assert goal is not None
    assert goal.point[0] == np.random.default_rng(3).random()
    assert interest.offered == [[m.name for m in MODES]]
    assert interest.contexts == [context]


def test_modes_of_absent_teachers_are_not_offered() -> None:
    interest = Scripted("mimic ann")
    strategy = JointChoice(MODES, interest, ALONE)
    chosen = strategy.choose(Situation(0, {"ann"}), RNG).mode
    assert interest.offered == [["alone", "mimic bob"]]
    assert chosen is ALONE


def test_while_every_teacher_is_absent_the_goal_is_pursued_alone() -> None:
    strategy = JointChoice(MODES[1:3], Scripted("mimic ann"), ALONE)
    chosen, goal, _ = strategy.choose(Situation(0, ["ann"]), RNG)
    assert chosen is ALONE
    assert goal is not None


def test_reports_go_to_the_interest_map() -> None:
    interest = Scripted("alone")
    episode = report([5.0])
    JointChoice(MODES, interest, ALONE).update(episode)
    assert interest.reports == [episode]


def test_with_an_interest_map_that_knows_nothing_modes_are_chosen_alike() -> None:
    strategy = JointChoice(MODES, UniformGoals({"place": PLACE}), ALONE)
    rng = np.random.default_rng(0)
    counted = Counter(strategy.choose(Situation(0), rng).mode.name for _ in range(2000))
    assert {m: n / 2000 for m, n in counted.items()} == pytest.approx(
        {m.name: 0.25 for m in MODES}, abs=0.04
    )


def test_modes_must_have_different_names() -> None:
    with pytest.raises(ValueError, match=r"different names, got .*'alone', 'alone'"):
        JointChoice([ALONE, mode("alone")], Scripted("alone"), ALONE)
    with pytest.raises(ValueError, match="different names"):
        JointChoice([], Scripted("alone"), ALONE)


def test_an_aimless_strategy_has_one_mode_and_no_goal() -> None:
    random = mode("random", pursues="nothing")
    strategy = Aimless(random)
    strategy.update(report([5.0]))
    assert strategy.choose(Situation(0, {"ann"}), RNG) == (random, None, None)
    assert strategy.modes == {"random": random}
    assert strategy.alone is random


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"budget": 0}, "'m' has a budget of 0"),
        ({"cost": 0.0}, "'m' has cost 0.0"),
        ({"cost": float("nan")}, "'m' has cost nan"),
        ({"pursues": "demonstrated"}, "'m' pursues demonstrations but has no teacher"),
    ],
)
def test_a_mode_that_cannot_work_is_refused_by_name(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Mode("m", RandomPolicies(PLACE), **{"budget": 1, **options})


def shown(place: float) -> Demonstration:
    return Demonstration({"place": np.array([place])}, np.array([0.5]))


def test_a_teacher_never_asked_is_expected_to_bring_news() -> None:
    assert News({"place": PLACE}).expected("mimic ann") == 1.0


def test_news_is_the_share_of_demonstrations_seen_once_with_one_imagined() -> None:
    news = News({"place": PLACE})
    for place in (1.0, 2.0, 2.0, 3.0, 3.0, 3.0):
        news.take_in("mimic ann", shown(place))
    assert news.expected("mimic ann") == pytest.approx((1 + 1) / (6 + 1))
    assert news.expected("emulate ann") == 1.0


def test_a_teacher_who_only_repeats_himself_is_asked_ever_less() -> None:
    interest, news = Scripted("mimic ann"), News({"place": PLACE})
    strategy = JointChoice(MODES, interest, ALONE, news)
    rng = np.random.default_rng(0)
    asked = []
    for number in range(400):
        chosen, goal, _ = strategy.choose(Situation(0), rng)
        asked.append(chosen.teacher is not None)
        assert goal is not None
        if chosen.teacher is not None:
            episode = report([5.0], chosen.name, episode=number)
            strategy.update(replace(episode, demonstration=shown(number % 3)))
    assert all(asked[:1])
    assert np.mean(asked[200:]) < 0.25
    assert not JointChoice(MODES, interest, ALONE).news
