from collections import Counter

import numpy as np
import pytest
from tests.helpers import PlainProgress, report

from sgim.outcome.interest import UniformGoals
from sgim.outcome.progress import CompetenceChange
from sgim.outcome.table import InterestTable
from sgim.records import Goal
from sgim.spaces import Box, Choices

TOYS = Choices(["dog", "car", "ball"])
MODES = {"push": 1.0, "ask": 2.0}


def table(uniform: float = 0.0) -> InterestTable:
    return InterestTable("place", TOYS, MODES, PlainProgress(), uniform=uniform)


def attempt(one: InterestTable, toy: str, mode: str, gain: float) -> None:
    one.update(report(toy, mode, before=0.0, after=gain))


def shares(one: InterestTable, modes: list[str], count: int = 4000) -> dict[tuple[str, str], float]:
    rng = np.random.default_rng(0)
    chosen = [one.choose(rng, modes, None) for _ in range(count)]
    counted = Counter((goal.point, mode) for goal, mode in chosen)
    return {pair: number / count for pair, number in counted.items()}


def test_pairs_not_yet_tried_start_at_the_prior_over_the_cost() -> None:
    assert table().interest == {
        (toy, mode): 0.3 / cost for toy in TOYS.labels for mode, cost in MODES.items()
    }


def test_interest_is_the_measure_over_the_cost() -> None:
    one = table()
    attempt(one, "dog", "ask", 0.5)
    attempt(one, "dog", "ask", 0.1)
    assert one.interest["dog", "ask"] == pytest.approx(0.3 / 2)
    attempt(one, "dog", "push", 0.1)
    assert one.interest["dog", "push"] == pytest.approx(0.1)
    assert one.interest["car", "push"] == 0.3


def test_pairs_are_drawn_in_proportion_to_their_interest_above_the_least() -> None:
    one = table()
    gains = {"dog": (0.1, 0.2), "car": (0.3, 0.2), "ball": (0.5, 0.6)}
    for toy, (pushed, asked) in gains.items():
        attempt(one, toy, "push", pushed)
        attempt(one, toy, "ask", asked)
    # Interests less the least, 0.1: push 0, 0.2, 0.4; ask 0, 0, 0.2; together 0.8.
    drawn = shares(one, ["push", "ask"])
    assert drawn == pytest.approx(
        {("car", "push"): 0.25, ("ball", "push"): 0.5, ("ball", "ask"): 0.25}, abs=0.03
    )


def test_a_share_of_the_choices_is_uniform() -> None:
    one = table(uniform=0.4)
    for toy in TOYS.labels:
        for mode in MODES:
            attempt(one, toy, mode, 0.0)
    attempt(one, "car", "ask", 1.0)
    drawn = shares(one, ["push", "ask"])
    assert drawn["car", "ask"] == pytest.approx(0.6 + 0.4 / 6, abs=0.03)
    assert drawn["dog", "push"] == pytest.approx(0.4 / 6, abs=0.02)


def test_equal_interests_are_drawn_alike() -> None:
    one = table()
    for toy in TOYS.labels:
        attempt(one, toy, "push", 0.2)
    assert shares(one, ["push"]) == pytest.approx(
        {(toy, "push"): 1 / 3 for toy in TOYS.labels}, abs=0.03
    )


def test_only_modes_that_are_offered_are_chosen() -> None:
    one = table(uniform=0.5)
    attempt(one, "car", "ask", 1.0)
    assert {mode for _, mode in shares(one, ["push"])} == {"push"}


def test_reports_of_other_kinds_modes_and_labels_are_ignored() -> None:
    one = table()
    before = dict(one.interest)
    one.update(report([0.5], "push", kind="elsewhere", after=0.0))
    one.update(report("dog", "dance", after=0.0))
    one.update(report("cat", "push", after=0.0))
    assert one.interest == before


def test_an_episode_counts_for_the_label_that_was_pursued() -> None:
    one = table()
    one.update(report("dog", "ask", pursued=Goal("place", "car"), before=0.0, after=0.8))
    assert one.interest["car", "ask"] == pytest.approx(0.4)
    assert one.interest["dog", "ask"] == 0.15


def test_the_measure_sees_the_records_oldest_first() -> None:
    one = InterestTable("place", TOYS, MODES, CompetenceChange(window=2))
    for after in (0.1, 0.9, 0.4):
        one.update(report("dog", "push", before=0.0, after=after))
    assert one.interest["dog", "push"] == pytest.approx(abs(0.9 - 0.4) / 2)


def test_uniform_goals_draw_kinds_goals_and_modes_alike() -> None:
    spaces = {"place": Box(0, 10), "toy": Choices(["dog", "car"])}
    uniform, rng = UniformGoals(spaces), np.random.default_rng(0)
    uniform.update(report([5.0], after=0.0))
    chosen = [uniform.choose(rng, ["push", "ask", "lift"], None) for _ in range(3000)]
    modes = Counter(mode for _, mode in chosen)
    assert {m: n / 3000 for m, n in modes.items()} == pytest.approx(
        dict.fromkeys(["push", "ask", "lift"], 1 / 3), abs=0.03
    )
    places = [goal.point[0] for goal, _ in chosen if goal.kind == "place"]
    assert len(places) / 3000 == pytest.approx(0.5, abs=0.03)
    assert np.mean(places) == pytest.approx(5, abs=0.3)
    assert np.std(places) == pytest.approx(10 / np.sqrt(12), abs=0.2)
