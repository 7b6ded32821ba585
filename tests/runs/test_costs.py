"""What a run has spent, from its journal."""

from pathlib import Path

import numpy as np

from sgim.events import Answered, Ended, Evaluated, Planned, Told
from sgim.records import Demonstration, Goal, Plan, Request
from sgim.runs import Journal
from sgim.runs.costs import Prices, read_spending
from sgim.spaces import Box
from sgim.task import Task

TASK = Task(Box(0, 1), {"spot": Box(0, 1), "word": Box(0, 1)})
GOAL = Goal("spot", np.array([0.5]))


def movement(number: int) -> Planned:
    return Planned(Plan(number, 0, "mimic", GOAL, np.array([0.5]), None, None))


def request(number: int) -> Planned:
    return Planned(Plan(number, 0, "mimic", GOAL, None, Request("Ada", GOAL, number), None))


def measured(movements: int) -> Evaluated:
    return Evaluated(movements, {"total": 1.0})


def test_time_is_as_recorded_and_at_a_price_where_it_is_not(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    shown = Demonstration({"spot": np.array([0.5])}, policy=np.array([0.5]))
    both = {"spot": np.array([0.1]), "word": np.array([0.2])}
    events = [
        *(measured(0), request(0), Answered(0, shown), movement(1), Told(1, both)),
        measured(1),
        *(movement(2), Told(2, {}, 20.5), movement(3), Ended(3, "failed", "stuck", 7.0)),
        measured(3),
        *(request(4), Answered(4, shown, 100.0), movement(5), Ended(5, "failed", "stuck")),
        *(request(6), Answered(6, None), movement(7), Ended(7, "refused", "too fast")),
        *(request(8), Ended(8, "failed", "no camera"), request(9), Ended(9, "expired", "away")),
        *(movement(10), Ended(10, "lost", "gone", 3.0), movement(11), Told(11, both)),
        measured(5),
    ]
    with Journal.create(path, {}, TASK) as journal:
        for event in events:
            journal.append(event)
    spent = read_spending(path)
    assert spent.movements.tolist() == [0, 1, 1, 3]
    assert spent.requests.tolist() == [0, 1, 1, 2]
    assert spent.asked.tolist() == [0, 1, 1, 3]
    assert spent.seconds.tolist() == [0, 0, 27.5, 130.5]
    assert spent.recorded
    assert spent.cost(Prices(2, 30)).tolist() == [0, 32, 59.5, 196.5]


def test_a_run_without_evaluations_or_events_has_spent_nothing(tmp_path: Path) -> None:
    Journal.create(tmp_path / "a.sgim", {}, TASK).close()
    spent = read_spending(tmp_path / "a.sgim")
    assert spent.cost(Prices()).shape == (0,)
    assert not spent.recorded
