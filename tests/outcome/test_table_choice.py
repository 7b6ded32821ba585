"""The table of labels and modes: every pair once first, and both ways to pick (algorithm 2.2.3)."""

import numpy as np
import pytest

from sgim.outcome import CompetenceChange, EpisodeReport, InterestTable, Record
from sgim.records import Goal
from sgim.spaces import Choices
from sgim.testing import check_interest_map

TOYS = Choices(["dog", "car", "cubes"])
MODES = {"push": 1.0, "ask": 1.0}


def made(**settings: object) -> InterestTable:
    measure = CompetenceChange(window=8, whole=True)
    return InterestTable("toy", TOYS, MODES, measure, each_first=True, **settings)  # type: ignore[arg-type]


def report(toy: str, mode: str, before: float, after: float) -> EpisodeReport:
    goal = Goal("toy", toy)
    return EpisodeReport(0, mode, goal, goal, None, before, after, 1)


@pytest.mark.parametrize("pick", ["proportional", "argmax"])
def test_such_tables_keep_the_promises_of_interest_maps(pick: str) -> None:
    check_interest_map(lambda: made(pick=pick), {"toy": TOYS}, list(MODES))


def test_every_pair_is_tried_once_before_any_is_preferred() -> None:
    for seed in range(5):
        table, rng, tried = made(uniform=0.0), np.random.default_rng(seed), []
        for _ in range(6):
            goal, mode = table.choose(rng, list(MODES), None)
            tried.append((goal.point, mode))
            table.update(report(goal.point, mode, 0.0, 5.0 if goal.point == "cubes" else 0.0))
        assert sorted(tried) == sorted((toy, mode) for toy in TOYS.labels for mode in MODES)
        assert table.choose(rng, list(MODES), None)[0].point == "cubes"


def test_pairs_of_modes_that_are_not_possible_now_do_not_hold_up_the_others() -> None:
    table, rng = made(uniform=0.0), np.random.default_rng(0)
    for toy in TOYS.labels:
        table.update(report(toy, "push", 0.0, 1.0 if toy == "car" else 0.0))
    assert {table.choose(rng, ["push"], None)[0].point for _ in range(20)} == {"car"}
    assert {table.choose(rng, list(MODES), None)[1] for _ in range(20)} == {"ask"}


def test_one_episode_is_enough_to_show_progress() -> None:
    table = made()
    table.update(report("dog", "push", -1.0, 3.0))
    assert table.interest["dog", "push"] == pytest.approx(4 / 8)


def test_interest_is_divided_by_the_window_however_few_records_there_are() -> None:
    records = [Record((), 0.0, c) for c in (0.0, 1.0, 2.0, 5.0)]
    assert CompetenceChange(window=8).interest(records) == pytest.approx(6 / 4)
    assert CompetenceChange(window=8, whole=True).interest(records) == pytest.approx(6 / 8)
    assert CompetenceChange(window=4, whole=True).interest(records) == pytest.approx(6 / 4)


def test_the_most_interesting_pair_is_taken_or_drawn_most_often() -> None:
    drawn, taken = made(uniform=0.0), made(uniform=0.0, pick="argmax")
    for table in (drawn, taken):
        for toy, gain in (("dog", 0.0), ("car", 2.0), ("cubes", 4.0)):
            for mode in MODES:
                table.update(report(toy, mode, 0.0, gain))
    rng = np.random.default_rng(0)
    assert {taken.choose(rng, list(MODES), None)[0].point for _ in range(50)} == {"cubes"}
    often = [drawn.choose(rng, list(MODES), None)[0].point for _ in range(600)]
    assert often.count("cubes") == pytest.approx(400, abs=45)
    assert often.count("dog") == 0
