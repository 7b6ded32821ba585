"""A run survives worlds and teachers that misbehave, and says what they did."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sgim import algorithms
from sgim.configurations import MODERN
from sgim.environments import PlanarArm, ThrowingArm
from sgim.environments.benchmark_goals import throwing_goals
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import JournalError, SgimError
from sgim.records import Demonstration
from sgim.runs import Benchmark, Interrupted, Journal, Run, RunError
from sgim.runs.continuation import keep_journal

TASK = ThrowingArm().task


class Faulty(ThrowingArm):
    """Throws as usual, but every so often gives something else."""

    def __init__(self, fault: Any, every: int = 7) -> None:
        super().__init__()
        self.fault, self.every, self.count = fault, every, 0

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        self.count += 1
        if self.count % self.every:
            return super().execute(policy, context, rng)
        if isinstance(self.fault, Exception):
            raise self.fault
        return self.fault

    def execute_batch(self, policies: Any, contexts: Any = None, rngs: Any = None) -> Any:
        return [self.execute(policy) for policy in policies]


def learner(name: str = "sagg-riac", seed: int = 0) -> Any:
    return algorithms.make(name, TASK, "T1", seed=seed)


FAULTS = [
    OSError("the motor is hot"),
    {"throw": [np.nan, 1.0]},
    {"throw": [1.0]},
    {"thrown": [1.0, 2.0]},
    None,
]


@pytest.mark.parametrize("fault", FAULTS, ids=str)
@pytest.mark.parametrize("batch", [1, 8])
@pytest.mark.filterwarnings("ignore:the world failed")
def test_a_trial_that_breaks_teaches_nothing_and_the_run_goes_on(
    tmp_path: Path, fault: Any, batch: int
) -> None:
    path = tmp_path / "a.sgim"
    with Run(learner(), Faulty(fault), journal=path, batch=batch) as run:
        run.go(70)
        assert run.movements == 70
        known = len(run.learner.model.memory)
    assert 55 <= known <= 62  # a batch that raises is executed again one by one
    with Journal.open(path, append=False) as journal:
        ended = list(journal.events(only=["ended"]))
    assert len(ended) == 70 - known
    assert {e.how for e in ended} == {"failed"}  # type: ignore[union-attr]


def test_the_first_failure_is_told_with_its_reason() -> None:
    run = Run(learner(), Faulty(OSError("the motor is hot")))
    with pytest.warns(UserWarning, match="the world failed: OSError: the motor is hot"):
        run.go(20)


@pytest.mark.filterwarnings("ignore:the world failed")
def test_a_world_that_only_fails_stops_the_run_with_nothing_lost(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with Run(learner(), ThrowingArm(), journal=path) as run:
        run.go(20)
    with (
        pytest.raises(RunError, match="failed 10 times in a row, last with OSError: hot"),
        Run(learner(), Faulty(OSError("hot"), every=1), journal=path) as run,
    ):
        run.go(100)
    with Run(learner(), ThrowingArm(), journal=path) as run:
        assert run.movements == 30
        run.go(100)
        assert len(run.learner.model.memory) == 90


class Teacher:
    """Answers with whatever it was given."""

    def __init__(self, answer: Any) -> None:
        self.answer = answer

    def demonstrate(self, goal: Any, rng: Any) -> Any:
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


def test_parts_that_cannot_be_used_are_named() -> None:
    with pytest.raises(SgimError, match="expected an object with task, deterministic"):
        Run(learner(), ThrowingArm)  # type: ignore[arg-type]
    with pytest.raises(SgimError, match="teachers are a list"):
        Run(learner("mimicry"), ThrowingArm(), [Teacher(None)])  # type: ignore[arg-type]
    with pytest.raises(SgimError, match="wrap a function of the goal in ScriptedTeacher"):
        Run(learner("mimicry"), ThrowingArm(), {"T1": lambda goal: None})  # type: ignore[dict-item]
    with pytest.raises(SgimError, match="task is not the world's"):
        Run(learner(), PlanarArm(3))


def test_a_teacher_who_only_fails_stops_the_run() -> None:
    run = Run(learner("mimicry"), ThrowingArm(), {"T1": Teacher(OSError("no connection"))})
    with (
        pytest.warns(UserWarning, match="teacher 'T1' failed"),
        pytest.raises(RunError, match="'T1' failed 10 times in a row"),
    ):
        run.go(200)


def test_a_journal_begins_with_a_learner_that_has_not_acted(tmp_path: Path) -> None:
    used = learner()
    used.ask()
    with pytest.raises(SgimError, match="has acted already"):
        Run(used, ThrowingArm(), journal=tmp_path / "a.sgim")


def test_a_composed_learner_is_told_from_another_on_resume(tmp_path: Path) -> None:
    def composed(seed: int, budget: int = 1) -> Any:
        made = learner(seed=seed)
        made.recipe = None
        (mode,) = made.strategy.modes.values()
        made.strategy.modes = {mode.name: replace(mode, budget=budget)}
        return made

    with Run(composed(7), ThrowingArm(), journal=tmp_path / "a.sgim") as run:
        run.go(5)
    with pytest.raises(JournalError, match="seed is 7 as recorded and 8 here"):
        Run(composed(8), ThrowingArm(), journal=tmp_path / "a.sgim")
    with pytest.raises(JournalError, match=r"modes.autonomous\[1\] is 1 as recorded and 2 here"):
        Run(composed(7, budget=2), ThrowingArm(), journal=tmp_path / "a.sgim")


ANSWERS = [
    OSError("no connection"),
    Demonstration({"thro": [1.0, 2.0]}, np.zeros(14)),
    Demonstration({"throw": [1.0, 2.0]}, np.full(14, np.nan)),
    Demonstration({"throw": [1.0, 2.0]}),
    "like this",
]


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda a: type(a).__name__)
def test_a_teacher_who_gives_nothing_usable_is_told_and_explored_without(answer: Any) -> None:
    run = Run(learner("mimicry"), ThrowingArm(), {"T1": Teacher(answer)})
    with pytest.warns(UserWarning, match="teacher 'T1' failed"):
        run.go(8)
    assert run.movements == 8


def test_a_teacher_who_always_declines_never_stops_a_run() -> None:
    run = Run(learner("mimicry"), ThrowingArm(), {"T1": Teacher(None)})
    run.go(60)
    assert len(run.learner.model.memory) == 60


def test_a_missing_teacher_is_named() -> None:
    with pytest.raises(SgimError, match="the learner asks T1, but the run has no teachers"):
        Run(learner("mimicry"), ThrowingArm())


def test_an_interrupt_ends_the_run_between_two_movements(tmp_path: Path) -> None:
    import os
    import signal

    class Interrupting(ThrowingArm):
        def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
            if run.movements == 25:
                os.kill(os.getpid(), signal.SIGINT)
            return super().execute(policy, context, rng)

    run = Run(learner(), Interrupting(), journal=tmp_path / "a.sgim")
    with run, pytest.raises(Interrupted, match="stopped at 26 of 100 movements"):
        run.go(100)
    with Run(learner(), ThrowingArm(), journal=tmp_path / "a.sgim") as run:
        assert run.movements == 26


def test_a_real_world_never_repeats_what_was_started(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with keep_journal(learner(), path, real=True) as one:
        plan = one.ask()
    with keep_journal(learner(), path, real=True) as again:
        assert again.pending == []
        assert again.ask().id == plan.id + 1
    with Journal.open(path, append=False) as journal:
        (lost,) = journal.events(only=["ended"])
    assert (lost.plan, lost.how) == (plan.id, "lost")  # type: ignore[union-attr]


def test_a_simulated_world_is_given_the_same_plan_again(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with keep_journal(learner(), path) as one:
        plan = one.ask()
    with keep_journal(learner(), path) as again:
        (pending,) = again.pending
        assert pending.id == plan.id
        assert (pending.policy == plan.policy).all()


def test_evaluations_come_at_their_interval_and_at_the_end() -> None:
    world = ThrowingArm()
    benchmark = Benchmark(throwing_goals()[::30], world)
    run = Run(learner(), world, benchmark=benchmark, evaluate_every=30)
    found = run.go(100)
    assert [e.movements for e in found] == [0, 30, 60, 90, 100]
    assert found[0].errors == {"throw": 1.0, "place": 1.0, "total": 1.0}
    assert found[-1].errors["throw"] < 0.3


def test_news_make_a_learner_ask_less_once_its_teachers_repeat_themselves(tmp_path: Path) -> None:
    def requests(news: bool) -> tuple[int, int]:
        config = replace(MODERN, name="mine", news=news)
        made = algorithms.sgim_acts(TASK, ["T1", "T2", "T3"], configuration=config)
        path = tmp_path / f"{news}.sgim"
        with Run(made, ThrowingArm(), throwing_teachers(), journal=path) as run:
            run.go(3000)
        with sqlite3.connect(path) as db:
            rows = db.execute("SELECT event FROM events WHERE event IN ('answered', 'told')")
            events = [row[0] for row in rows]
        half = len(events) // 2
        return events[:half].count("answered"), events[half:].count("answered")

    asked = requests(news=True)
    assert asked[1] < asked[0] / 2
    assert sum(asked) < sum(requests(news=False)) / 2


class Counting(ThrowingArm):
    """Counts the policies executed; breaks at some of them."""

    def __init__(self, breaks: range) -> None:
        super().__init__()
        self.breaks = breaks
        self.seen: list[bytes] = []

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
        self.seen.append(policy.tobytes())
        if len(self.seen) in self.breaks:
            raise OSError("hot")
        return super().execute(policy, context, rng)

    def execute_batch(self, policies: Any, contexts: Any = None, rngs: Any = None) -> Any:
        return [self.execute(policy) for policy in policies]


@pytest.mark.filterwarnings("ignore:the world failed")
def test_a_real_world_makes_no_movement_twice(tmp_path: Path) -> None:
    world = Counting(range(3, 4))
    with Run(learner(), world, journal=tmp_path / "a.sgim", batch=4, real=True) as run:
        run.go(8)
    assert len(set(world.seen)) == len(world.seen)


@pytest.mark.filterwarnings("ignore:the world failed")
def test_what_was_executed_is_told_also_when_the_run_gives_up() -> None:
    run = Run(learner(), Counting(range(1, 100)), batch=16)
    with pytest.raises(RunError, match="10 times in a row"):
        run.go(32)
    assert run.movements == 16
    assert run.learner.pending == []


@pytest.mark.parametrize("batch", [1, 8])
def test_going_on_after_a_stop_asks_for_no_more_than_is_left(batch: int) -> None:
    class Stopping(ThrowingArm):
        stops = True

        def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Any:
            if self.stops:
                raise KeyboardInterrupt
            return super().execute(policy, context, rng)

        def execute_batch(self, policies: Any, contexts: Any = None, rngs: Any = None) -> Any:
            return [self.execute(policy) for policy in policies]

    world = Stopping()
    run = Run(learner(), world, batch=batch)
    with pytest.raises(KeyboardInterrupt):
        run.go(batch)
    world.stops = False
    run.go(batch)
    assert run.movements == batch


def test_a_request_that_is_out_survives_an_adoption(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with keep_journal(learner("emulation"), path, real=True) as one:
        shown = Demonstration({"throw": [5.0, 2.0]}, np.full(14, 0.5))
        one.answer(one.ask(), shown)  # its policy is still out
        assert one.ask().request is not None
    with sqlite3.connect(path) as db:  # as another version would have decided
        db.execute("UPDATE events SET policy = zeroblob(112) WHERE policy NOTNULL")
        db.execute("UPDATE events SET policy = NULL WHERE event = 'answered'")
    db.close()
    kept = keep_journal(learner("emulation"), path, real=True)
    with kept as again:
        assert kept.replayed.difference is not None
        (request,) = again.pending
        plan = again.answer(request, shown)
        assert again.tell(plan, {"throw": [5.0, 2.1]}).cost is not None
