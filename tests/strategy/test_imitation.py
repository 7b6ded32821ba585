"""Imitating one teacher now and then: at a fixed frequency, or by the ratio of progress."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from tests.helpers import report
from tests.strategy.test_strategy import Scripted, mode, shown

from sgim.outcome.interest import EpisodeReport
from sgim.strategy.imitation import FixedFrequency, ProgressRatio
from sgim.strategy.modes import Mode
from sgim.strategy.situation import Choice, Situation

ALONE = mode("alone")  # five movements
IMITATING = replace(mode("imitate ann", "ann"), budget=3, pursues="demonstrated", uses="policy")


@dataclass
class Open:
    """An open episode."""

    mode: Mode
    budget: int


def fixed(every: int) -> tuple[FixedFrequency, Scripted]:
    interest = Scripted("alone")
    return FixedFrequency(IMITATING, ALONE, interest, every), interest


def ended(choice: Choice, number: int, movements: int, gain: float = 0.0) -> EpisodeReport:
    """What such an episode reports when it has ended."""
    asked = choice.mode is IMITATING
    made = report([5.0], choice.mode.name, episode=number, before=-0.5, after=-0.5 + gain)
    return replace(made, movements=movements, demonstration=shown(5.0) if asked else None)


def lived(strategy: FixedFrequency, movements: int) -> list[tuple[str, int, int]]:
    """Mode, beginning and length of every episode, each as long as may be."""
    rng, done, told = np.random.default_rng(0), 0, []
    while done < movements:
        choice = strategy.choose(Situation(len(told)), rng)
        length = min(choice.mode.budget, choice.budget or choice.mode.budget)
        strategy.update(ended(choice, len(told), length))
        told.append((choice.mode.name, done, length))
        done += length
    return told


@pytest.mark.parametrize("every", [4, 12, 100])
def test_a_demonstration_comes_every_m_movements_imitations_included(every: int) -> None:
    strategy, _ = fixed(every)
    begun = [at for name, at, _ in lived(strategy, 600) if name == "imitate ann"]
    assert begun == list(range(0, 600, every))


def test_exploration_is_cut_only_where_it_would_overrun_the_next_demonstration() -> None:
    strategy, _ = fixed(12)
    assert [length for _, _, length in lived(strategy, 24)] == [3, 5, 4, 3, 5, 4]
    choices = [strategy.choose(Situation(0), np.random.default_rng(0))]
    assert choices[0] == (IMITATING, None, None)


def test_with_more_imitations_than_movements_between_every_episode_imitates() -> None:
    strategy, _ = fixed(2)
    assert {name for name, *_ in lived(strategy, 30)} == {"imitate ann"}


def test_what_is_under_way_counts_as_if_it_were_done() -> None:
    strategy, _ = fixed(12)
    under_way: list[Open] = []
    names = []
    for number in range(7):
        choice = strategy.choose(Situation(number, under_way=under_way), np.random.default_rng(0))
        under_way.append(Open(choice.mode, choice.budget or choice.mode.budget))
        names.append((choice.mode.name, under_way[-1].budget))
    cycle = [("imitate ann", 3), ("alone", 5), ("alone", 4)]
    assert names == [*cycle, *cycle, cycle[0]]


def test_while_the_teacher_is_away_exploration_goes_on_and_he_is_asked_on_his_return() -> None:
    strategy, _ = fixed(12)
    rng = np.random.default_rng(0)
    for number in range(10):
        choice = strategy.choose(Situation(number, {"ann"}), rng)
        assert (choice.mode, choice.budget) == (ALONE, None)
        assert choice.goal is not None
        strategy.update(ended(choice, number, 5))
    assert strategy.choose(Situation(10), rng).mode is IMITATING


def test_who_declines_is_asked_again_by_the_next_episode() -> None:
    strategy, _ = fixed(12)
    declined = Choice(ALONE, None)  # the episode went on alone
    strategy.update(ended(declined, 0, 5))
    assert strategy.choose(Situation(1), np.random.default_rng(0)).mode is IMITATING


@pytest.mark.parametrize("make", [FixedFrequency, ProgressRatio])
def test_the_interest_map_learns_from_demonstrations_as_from_its_own_goals(make: Any) -> None:
    interest = Scripted("alone")
    more = {"every": 10} if make is FixedFrequency else {}
    strategy = make(IMITATING, ALONE, interest, **more)
    strategy.update(ended(Choice(IMITATING, None), 0, 3, gain=0.2))
    strategy.update(ended(Choice(ALONE, None), 1, 5))
    assert [(r.mode, r.chosen.point[0]) for r in interest.reports] == [("alone", 5.0)] * 2
    assert interest.reports[0].demonstration is not None


def ratio(imitating: Sequence[float], alone: Sequence[float], **options: Any) -> ProgressRatio:
    """The strategy after episodes that gained so much: imitations of 3 movements, others of 5."""
    strategy = ProgressRatio(IMITATING, ALONE, Scripted("alone"), **options)
    for gain in imitating:
        strategy.update(ended(Choice(IMITATING, None), 0, 3, gain))
    for gain in alone:
        strategy.update(ended(Choice(ALONE, None), 0, 5, gain))
    return strategy


def test_both_modes_are_chosen_alike_until_each_was_tried_often_enough() -> None:
    assert ratio([0.3] * 9, [0.1] * 50).probability() == 0.5
    assert ratio([0.3] * 50, [0.1] * 9).probability() == 0.5
    assert ratio([0.3] * 3, [0.1] * 3, initiation=3, cost=1.0).probability() != 0.5


@pytest.mark.parametrize(
    ("imitating", "alone", "cost", "expected"),
    [
        (0.3, 0.1, 1.0, 0.1 / (0.1 + 0.02)),  # per movement, not per episode
        (0.3, 0.1, 5.0, 0.5),
        (0.3, 0.1, 100.0, 0.1),
        (0.3, 0.0, 100.0, 0.9),
        (0.3, -0.1, 100.0, 0.9),
        (-0.3, 0.1, 1.0, 0.1),
        (0.0, 0.0, 1.0, 0.1),
        (-0.3, -0.1, 1.0, 0.1),
    ],
)
def test_asking_is_as_probable_as_its_share_of_progress(
    imitating: float, alone: float, cost: float, expected: float
) -> None:
    strategy = ratio([imitating] * 10, [alone] * 10, cost=cost)
    assert strategy.probability() == pytest.approx(expected)
    rng = np.random.default_rng(0)
    asked = [strategy.choose(Situation(0), rng).mode is IMITATING for _ in range(4000)]
    assert np.mean(asked) == pytest.approx(expected, abs=0.03)


def test_only_the_latest_episodes_of_each_mode_count() -> None:
    old, new = [0.3] * 30, [0.0] * 20
    assert ratio(old + new, [0.1] * 20, cost=1.0, window=20).probability() == 0.1
    assert ratio(old + new[1:], [0.1] * 20, cost=1.0, window=20).probability() > 0.1


def test_an_absent_teacher_is_not_asked() -> None:
    strategy, rng = ratio([0.3] * 10, [0.0] * 10), np.random.default_rng(0)
    for _ in range(50):
        choice = strategy.choose(Situation(0, {"ann"}), rng)
        assert choice.mode is ALONE
        assert choice.goal is not None


def test_a_frequency_below_one_is_refused() -> None:
    with pytest.raises(ValueError, match="every 0 movements, expected ≥ 1"):
        fixed(0)
