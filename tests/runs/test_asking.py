"""Persons are asked without being waited for, and what they do is in the journal, once."""

import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sgim
from sgim.environments import ThrowingArm, throwing_teachers
from sgim.errors import JournalError, SettingError, SgimError
from sgim.events import Answered, Available, Demonstrated, Ended, Opened, Suggested
from sgim.records import Goal
from sgim.runs.asking import Asking
from sgim.runs.continuation import keep_journal
from sgim.runs.letters import LetterBox, demonstration_detail
from sgim.teachers import RemoteTeacher

ARM = ThrowingArm()
SHOWER = throwing_teachers()["T1"]


def learner(name: str = "mimicry", seed: int = 3) -> sgim.Learner:
    return sgim.algorithms.make(name, ARM.task, ["person"], seed=seed)


def shown(goal: dict[str, Any] | None = None, number: int = 0) -> dict[str, Any]:
    aim = None if goal is None else Goal(goal["kind"], np.array(goal["point"]))
    demonstration = SHOWER.demonstrate(aim, np.random.default_rng(number))
    assert demonstration is not None
    return demonstration_detail(demonstration)


class Lesson:
    """A learner that is driven by hand, with a clock that stands still."""

    def __init__(self, path: Path, teacher: RemoteTeacher, name: str = "mimicry") -> None:
        self.now = 1000.0
        self.kept = keep_journal(learner(name), path)
        self.learner = self.kept.learner
        self.asking = Asking(
            self.learner, self.kept.journal, {"person": teacher}, lambda: self.now, 0.0
        )
        self.box = LetterBox(path)

    def step(self) -> None:
        """Hear, then make one movement or put one request."""
        self.asking.hear()
        due = [plan for plan in self.learner.pending if not self.asking.waits(plan)]
        plan = due[0] if due else self.learner.ask()
        if self.asking.waits(plan):
            self.asking.put(plan)
        else:
            self.learner.tell(plan, ARM.execute(plan.policy))

    def send(self, what: str, id_: str, **more: Any) -> None:
        self.box.send(what, "person", id=id_, name="Ada", **more)

    def events(self, kind: type) -> list[Any]:
        return [event for event in self.kept.journal.events() if isinstance(event, kind)]

    def steps(self, n: int) -> None:
        for _ in range(n):
            self.step()


@pytest.fixture
def lesson(tmp_path: Path) -> Iterator[Lesson]:
    made = Lesson(tmp_path / "a.sgim", RemoteTeacher(60.0, 100))
    yield made
    made.kept.close()


def test_the_learner_explores_while_a_person_is_asked(lesson: Lesson) -> None:
    lesson.steps(40)
    (request,) = lesson.box.requests()
    assert request["teacher"] == "person"
    assert request["goal"]["kind"] in ARM.task.goal_spaces
    assert request["replaces"] == "autonomous"
    assert lesson.learner.movements == 39
    assert [plan.id for plan in lesson.learner.pending if plan.request] == [request["plan"]]


def test_an_answer_is_learned_from_and_the_next_request_follows(lesson: Lesson) -> None:
    lesson.steps(5)
    (request,) = lesson.box.requests()
    detail = shown(request["goal"]) | {"seconds": 12.5}
    lesson.send("answer", "a", plan=request["plan"], detail=detail)
    assert lesson.box.requests() == [], "who has answered is not asked the same"
    lesson.steps(5)
    (answer,) = lesson.events(Answered)
    assert answer.plan == request["plan"]
    assert answer.seconds == 12.5
    assert np.array_equal(answer.demonstration.policy, detail["policy"])
    assert lesson.box.said(["a"]) == {"a": ""}
    assert lesson.box.requests()[0]["plan"] > request["plan"]


def test_a_request_expires_in_time_and_its_episode_goes_on_alone(lesson: Lesson) -> None:
    lesson.steps(5)
    (request,) = lesson.box.requests()
    lesson.now += 59.0
    lesson.steps(1)
    assert not lesson.events(Ended)
    lesson.now += 2.0
    lesson.steps(2)
    (ended,) = lesson.events(Ended)
    assert (ended.plan, ended.how) == (request["plan"], "expired")
    assert "not answered" in ended.reason


def test_what_comes_too_late_is_taken_as_shown_unasked(lesson: Lesson) -> None:
    lesson.steps(5)
    (request,) = lesson.box.requests()
    lesson.now += 61.0
    lesson.steps(1)
    lesson.send("answer", "late", plan=request["plan"], detail=shown(request["goal"]))
    lesson.steps(2)
    assert len(lesson.events(Demonstrated)) == 1
    assert "unasked" in lesson.box.said(["late"])["late"]


def test_more_time_can_be_asked_for(lesson: Lesson) -> None:
    lesson.steps(5)
    (request,) = lesson.box.requests()
    lesson.now += 50.0
    lesson.send("extend", "e", plan=request["plan"], detail={"seconds": 60.0})
    lesson.steps(1)
    lesson.now += 50.0
    lesson.steps(1)
    assert lesson.box.requests()[0]["plan"] == request["plan"]


def test_declining_and_skipping_leave_the_episode_to_the_learner(lesson: Lesson) -> None:
    lesson.steps(5)
    (first,) = lesson.box.requests()
    lesson.send("decline", "d", plan=first["plan"], detail={"reason": "too far"})
    lesson.steps(60)
    (second,) = lesson.box.requests()
    lesson.send("skip", "s", plan=second["plan"])
    lesson.steps(5)
    (answer,) = lesson.events(Answered)
    assert answer.demonstration is None
    assert [e.how for e in lesson.events(Ended)] == ["expired"]


def test_a_budget_spent_means_no_request_until_the_hour_has_passed(tmp_path: Path) -> None:
    lesson = Lesson(tmp_path / "b.sgim", RemoteTeacher(5.0, per_hour=2))
    for _ in range(30):
        lesson.steps(2)
        lesson.now += 3.0
    assert len({plan for (plan,) in lesson.kept.journal.query("SELECT plan FROM requests")}) == 2
    assert lesson.box.persons()["person"]["left"] == 0
    lesson.now += 3600.0
    lesson.steps(30)
    assert len(lesson.box.requests()) == 1
    lesson.kept.close()


def test_away_lets_requests_expire_at_once_and_busy_keeps_them(lesson: Lesson) -> None:
    lesson.steps(5)
    lesson.send("available", "b", detail={"status": "busy"})
    lesson.steps(3)
    (request,) = lesson.box.requests()
    lesson.send("available", "w", detail={"status": "away", "time_limit": 30.0, "per_hour": 7})
    lesson.steps(60)
    assert lesson.box.requests() == []
    assert lesson.events(Ended)[0].plan == request["plan"]
    assert lesson.box.persons()["person"] == {
        "status": "away",
        "time_limit": 30.0,
        "per_hour": 7,
        "left": 6,
    }
    lesson.send("available", "n", detail={"status": "now"})
    lesson.steps(30)
    assert len(lesson.box.requests()) == 1


def test_a_shorter_time_limit_holds_for_what_is_asked_already(lesson: Lesson) -> None:
    lesson.steps(5)
    lesson.send("available", "s", detail={"status": "now", "time_limit": 10.0})
    lesson.steps(1)
    lesson.now += 11.0
    lesson.steps(1)
    assert [ended.how for ended in lesson.events(Ended)] == ["expired"]


def test_demonstrations_and_goals_come_unasked(lesson: Lesson) -> None:
    lesson.send("demonstrate", "d", detail=shown())
    lesson.send("suggest", "g", detail={"kind": "throw", "point": [5.0, 2.0]})
    lesson.steps(40)
    assert len(lesson.events(Demonstrated)) == len(lesson.events(Suggested)) == 1
    causes = Counter(event.cause for event in lesson.events(Opened))
    assert causes["demonstration"] == causes["suggestion"] == 1


def test_an_unusable_letter_says_why_and_changes_nothing(lesson: Lesson) -> None:
    lesson.steps(5)
    (request,) = lesson.box.requests()
    broken = shown() | {"policy": [1.0, 2.0]}
    lesson.send("answer", "x", plan=request["plan"], detail=broken)
    lesson.send("suggest", "y", detail={"kind": "thow", "point": [5.0, 2.0]})
    lesson.send("demonstrate", "z", detail={})
    lesson.steps(3)
    said = lesson.box.said(["x", "y", "z"])
    assert "shape" in said["x"]
    assert "Did you mean 'throw'" in said["y"]
    assert "outcome" in said["z"]
    assert not lesson.events(Answered)


def test_a_letter_sent_twice_counts_once(lesson: Lesson) -> None:
    for _ in range(3):
        lesson.send("demonstrate", "same", detail=shown())
        lesson.steps(2)
    assert len(lesson.events(Demonstrated)) == 1


def test_who_is_asked_nothing_more_is_absent_to_the_learner(lesson: Lesson) -> None:
    lesson.steps(10)
    assert lesson.learner.absent == {"person"}
    assert [event.yes for event in lesson.events(Available)] == [False]


# With a run.


def run(path: Path, **more: Any) -> sgim.Run:
    return sgim.Run(learner(), ARM, {"person": RemoteTeacher(60.0)}, journal=path, **more)


def test_a_resume_asks_nothing_twice_and_goes_on_with_what_waited(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with run(path) as first:
        first.go(20)
        (request,) = LetterBox(path).requests()
    box = LetterBox(path)
    detail = shown(request["goal"])
    box.send("answer", "person", id="a", name="Ada", plan=request["plan"], detail=detail)
    with run(path) as second:
        second.go(60)
        answers = [e for e in second.journal.events() if isinstance(e, Answered)]  # type: ignore[union-attr]
        asked = [plan for (plan,) in second.journal.query("SELECT plan FROM requests")]  # type: ignore[union-attr]
    assert [answer.plan for answer in answers] == [request["plan"]]
    assert len(asked) == len(set(asked)) == 2


def test_a_run_resumed_without_news_goes_on_as_one_that_never_stopped(tmp_path: Path) -> None:
    whole, parts = tmp_path / "whole.sgim", tmp_path / "parts.sgim"
    with run(whole) as one:
        one.go(60)
    for target in (20, 41, 60):
        with run(parts) as some:
            some.go(target)
    told = [[event for event in _trials(path)] for path in (whole, parts)]
    assert told[0] == told[1]
    assert len(told[0]) == 60


def _trials(path: Path) -> list[tuple[Any, ...]]:
    with sgim.Journal.open(path, ARM.task, append=False) as journal:
        return journal.columns("told", "plan", "kind", "point")


def test_batches_go_on_while_a_person_is_asked(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with run(path, batch=8) as going:
        going.go(64)
        assert going.movements == 64
        assert len(LetterBox(path).requests()) == 1


def test_a_run_with_a_person_needs_a_journal() -> None:
    with pytest.raises(SgimError, match="journal=PATH"):
        sgim.Run(learner(), ARM, {"person": RemoteTeacher()})


def test_a_journal_whose_run_asks_nobody_has_no_letter_box(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with sgim.Run(sgim.algorithms.make("random", ARM.task), ARM, journal=path) as alone:
        alone.go(3)
    with pytest.raises(JournalError, match="asks nobody"):
        LetterBox(path)
    with pytest.raises(JournalError, match="no journal"):
        LetterBox(tmp_path / "b.sgim")


def test_settings_of_a_person_are_checked() -> None:
    with pytest.raises(SettingError, match="time_limit"):
        RemoteTeacher(time_limit=0.0)
    with pytest.raises(SettingError, match="per_hour"):
        RemoteTeacher(per_hour=0)


def test_everything_a_person_did_is_kept_with_their_name(lesson: Lesson) -> None:
    lesson.send("demonstrate", "d", detail=shown(), raw=[[0.0, 1.0], [0.1, 1.2]])
    lesson.steps(2)
    rows = lesson.kept.journal.query("SELECT name, raw FROM letters JOIN taken ON letter = number")
    assert [(name, json.loads(raw)) for name, raw in rows] == [("Ada", [[0.0, 1.0], [0.1, 1.2]])]
