"""A run's dealings with the persons who teach it: whom to ask when, and what comes back."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from sgim.errors import JournalError, SgimError
from sgim.learner import Learner
from sgim.records import Plan
from sgim.runs.journal import Journal
from sgim.runs.letters import SCHEMA, Letter, demonstration_of, letter_of, select_letters
from sgim.runs.reasons import reasons
from sgim.runs.rows import to_json
from sgim.teachers import RemoteTeacher

HOUR = 3600.0
LISTENING = 0.02
"""Least time in s between two looks at the letters."""


@dataclass
class _Desk:
    """What is known of one person.

    Attributes:
        teacher: The settings.
        status: ``now``, ``busy`` (not to be asked anything new) or ``away`` (nor to be waited for).
        asked: When they were asked within the last hour.
        until: The plan that is out → when it expires.
    """

    teacher: RemoteTeacher
    status: str = "now"
    asked: deque[float] = field(default_factory=deque)
    until: dict[int, float] = field(default_factory=dict)

    def left(self, now: float) -> int:
        """How many requests are left in this hour."""
        while self.asked and self.asked[0] <= now - HOUR:
            self.asked.popleft()
        return max(0, self.teacher.per_hour - len(self.asked))


class Asking:
    """Asks persons without waiting for them, and takes up their letters.

    One request at a time is put to each person, while they are there and their budget lasts;
    the learner is told when that changes, so that it does not choose to ask in vain.

    Args:
        learner: The learner, whose ``pending`` requests of a resumed run are put again.
        journal: The run's journal, open for writing.
        teachers: Name → settings, of the persons among the run's teachers.
        clock: Seconds since 1970.
        listening: Least time in s between two looks at the letters.
    """

    def __init__(
        self,
        learner: Learner,
        journal: Journal,
        teachers: Mapping[str, RemoteTeacher],
        clock: Callable[[], float] = time.time,
        listening: float = LISTENING,
    ) -> None:
        self._learner = learner
        self._journal = journal
        self._clock = clock
        self._listening = listening
        self._looked = 0.0
        self._unseen = False
        self._said: dict[str, str] = {}
        self._desks = {name: _Desk(teacher) for name, teacher in teachers.items()}
        if not self._desks:
            return
        for statement in SCHEMA:
            journal.query(statement)
        self._write("UPDATE requests SET until = 0")
        self._restore()
        for plan in learner.pending:
            if self.waits(plan):
                self.put(plan)
        self._say_who_is_there()
        journal.commit(synced=True)

    def __bool__(self) -> bool:
        """Whether there is anybody to ask."""
        return bool(self._desks)

    def waits(self, plan: Plan) -> bool:
        """Whether a plan is a request to a person, who answers later."""
        return plan.request is not None and plan.request.teacher in self._desks

    def put(self, plan: Plan) -> None:
        """Put a request to the person; what comes of it is heard later."""
        assert plan.request is not None
        teacher = plan.request.teacher
        desk, now = self._desks[teacher], self._clock()
        already = self._journal.query("SELECT asked FROM requests WHERE plan = ?", plan.id)
        asked = float(already[0][0]) if already else now
        if not already:
            desk.asked.append(now)
        desk.until[plan.id] = now + desk.teacher.time_limit
        self._write(
            "INSERT OR REPLACE INTO requests VALUES (?, ?, ?, ?, ?)",
            *(plan.id, teacher, asked, desk.until[plan.id]),
            to_json(reasons(self._learner, plan)),
        )
        self._say_who_is_there()
        self._journal.commit()

    def hear(self) -> None:
        """Take up the letters that have come; let requests expire that nobody answers."""
        if not self._desks or time.monotonic() - self._looked < self._listening:
            return
        self._looked = time.monotonic()
        rows = self._journal.query(select_letters("number NOT IN (SELECT letter FROM taken)"))
        for letter in map(letter_of, rows):
            self._take(letter)
        now = self._clock()
        for desk in self._desks.values():
            for number, until in list(desk.until.items()):
                if desk.status == "away" or until <= now:
                    reason = "the teacher is away" if desk.status == "away" else "not answered"
                    self._settle(number)
                    self._learner.expire(self._plan(number), f"{reason} in time")
        self._say_who_is_there()
        if self._unseen:
            self._journal.commit()
            self._unseen = False

    def _write(self, statement: str, *values: Any) -> None:
        """Have a statement executed with the next commit, before the page is to see it."""
        self._journal.beside(statement, *values)
        self._unseen = True

    def _take(self, letter: Letter) -> None:
        """Take up a letter; what comes of it is committed together with the note of it."""
        note = "INSERT OR REPLACE INTO taken VALUES (?, ?)"
        self._write(note, letter.number, "")
        try:
            said = self._act_on(letter)
        except JournalError:
            raise
        except (SgimError, KeyError, TypeError, ValueError) as error:
            said = f"{error}"
        if said:
            self._write(note, letter.number, said)
        self._journal.commit(synced=True)

    def _act_on(self, letter: Letter) -> str:
        """Do what a letter says.

        Returns:
            What else is to be said about it.
        """
        desk, learner = self._desks.get(letter.teacher), self._learner
        if desk is None:
            return f"this run does not ask {letter.teacher!r}"
        waiting = letter.plan is not None and letter.plan in desk.until
        match letter.what:
            case "answer" if waiting:
                plan, shown = self._plan(letter.plan), demonstration_of(letter)
                learner.answer(plan, shown, seconds=letter.detail.get("seconds"))
                self._settle(plan.id)
            case "answer" | "demonstrate":
                learner.demonstrate(demonstration_of(letter))
                if letter.what == "answer":
                    return "the request was over, so it was taken as shown unasked"
            case "decline" | "skip" if waiting:
                plan, seconds = self._plan(letter.plan), letter.detail.get("seconds")
                self._settle(plan.id)
                if letter.what == "decline":
                    learner.answer(plan, None, seconds=seconds)
                else:
                    learner.expire(plan, "skipped by the teacher", seconds=seconds)
            case "decline" | "skip" | "extend" if not waiting:
                return "the request was over"
            case "extend":
                assert letter.plan is not None
                desk.until[letter.plan] = self._clock() + float(letter.detail["seconds"])
                self._write(
                    "UPDATE requests SET until = ? WHERE plan = ?",
                    *(desk.until[letter.plan], letter.plan),
                )
            case "suggest":
                learner.suggest(letter.detail["kind"], letter.detail["point"])
            case "available":
                self._arrange(desk, letter.detail)
            case other:
                return f"this release does not know what {other!r} means"
        return ""

    def _plan(self, number: int | None) -> Plan:
        return next(plan for plan in self._learner.pending if plan.id == number)

    def _settle(self, number: int) -> None:
        for desk in self._desks.values():
            desk.until.pop(number, None)
        self._write("UPDATE requests SET until = 0 WHERE plan = ?", number)

    def _arrange(self, desk: _Desk, detail: Mapping[str, Any]) -> None:
        if detail["status"] not in ("now", "busy", "away"):
            raise SgimError(f"status is {detail['status']!r}, expected now, busy or away")
        desk.status = detail["status"]
        desk.teacher = replace(
            desk.teacher,
            time_limit=float(detail.get("time_limit", desk.teacher.time_limit)),
            per_hour=int(detail.get("per_hour", desk.teacher.per_hour)),
        )
        latest = self._clock() + desk.teacher.time_limit
        for plan in [plan for plan, until in desk.until.items() if until > latest]:
            desk.until[plan] = latest
            self._write("UPDATE requests SET until = ? WHERE plan = ?", latest, plan)

    def _say_who_is_there(self) -> None:
        """Tell the learner who can be asked now, and the page how each person stands."""
        now = self._clock()
        for name, desk in self._desks.items():
            left = desk.left(now)
            free = desk.status == "now" and left > 0 and not desk.until
            if free != (name not in self._learner.absent):
                self._learner.set_available(name, free)
            said = {
                "status": desk.status,
                "time_limit": desk.teacher.time_limit,
                "per_hour": desk.teacher.per_hour,
                "left": left,
            }
            text = to_json(said)
            if self._said.get(name) != text:
                self._said[name] = text
                self._write("INSERT OR REPLACE INTO persons VALUES (?, ?)", name, text)

    def _restore(self) -> None:
        """Go on as it was arranged before a resume."""
        arranged = self._journal.query(
            select_letters("what = 'available' AND number IN (SELECT letter FROM taken)")
        )
        for letter in map(letter_of, arranged):
            if letter.teacher in self._desks:
                self._arrange(self._desks[letter.teacher], letter.detail)
        since = self._clock() - HOUR
        recent = "SELECT teacher, asked FROM requests WHERE asked > ? ORDER BY asked"
        for teacher, asked in self._journal.query(recent, since):
            if teacher in self._desks:
                self._desks[teacher].asked.append(float(asked))


__all__ = ["Asking"]
