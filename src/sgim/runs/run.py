"""A run: drives a learner in a world with its teachers, keeps the journal, and resumes."""

from __future__ import annotations

import math
import time
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from sgim.environments.base import MinimalEnvironment
from sgim.errors import JournalError, SgimError
from sgim.events import Evaluated, Session
from sgim.learner import Learner
from sgim.records import Outcome, Plan
from sgim.runs.asking import Asking
from sgim.runs.benchmark import Measures
from sgim.runs.checks import check_world, checked_teachers
from sgim.runs.continuation import keep_journal, session_facts
from sgim.runs.interrupt import InterruptWish
from sgim.runs.journal import Journal
from sgim.runs.observer import Observer
from sgim.runs.pace import Pace
from sgim.runs.replay import Replayed, iterate_trials
from sgim.runs.telling import answer_together, tell_together
from sgim.runs.world import Executed, World
from sgim.streams import Streams
from sgim.teachers import RemoteTeacher, Teacher


class RunError(SgimError):
    """The world or a teacher keeps failing; what was learned is in the journal."""


class Interrupted(SgimError):  # noqa: N818 - not an error of the run
    """The user asked the run to stop; everything told is in the journal."""


class Run:
    """One learner in one world.

    A journal that exists already is resumed: its events are folded into the learner, which must
    be made as the recorded one was and have done nothing yet.

    Args:
        learner: The learner.
        environment: The world.
        teachers: Name → teacher, for every teacher that the learner's modes ask. A
            `RemoteTeacher` is not waited for; what they do comes through the journal.
        journal: Path of the journal; None to keep none.
        benchmark: Measures the repertoire; None to measure nothing.
        evaluate_every: Movements between evaluations.
        batch: Plans to carry out side by side.
        real: Whether the world is a real one: every event is on disk before the next thing
            happens, what was started and never told is lost and not repeated, and decisions
            that come out differently after a change of the library are adopted at once.
        adopt: Whether to adopt such decisions in a simulated world too, instead of refusing.
        about: What else to write in the journal's header, such as the experiment's name.

    Attributes:
        evaluations: All evaluations so far.
        seconds: Time spent in `go` by this process.
        difference: The first decision that came out differently on resume and was adopted.

    Raises:
        SgimError: If a teacher is missing.
        JournalError: If the journal cannot be used, or is of another run.
        MismatchError: If a decision comes out differently on resume, and is not adopted.
    """

    most_failures = 10
    """How many times in a row the world, or a teacher, may fail before the run stops."""

    def __init__(
        self,
        learner: Learner,
        environment: MinimalEnvironment,
        teachers: Mapping[str, Teacher | RemoteTeacher] | None = None,
        *,
        journal: str | Path | None = None,
        benchmark: Measures | None = None,
        evaluate_every: int = 1000,
        batch: int = 1,
        real: bool = False,
        adopt: bool = False,
        about: Mapping[str, Any] | None = None,
    ) -> None:
        self.teachers, persons = checked_teachers(teachers, learner)
        check_world(environment, learner)
        if persons and journal is None:
            raise SgimError(
                f"what {', '.join(persons)} will answer is kept in the journal; pass journal=PATH"
            )
        if evaluate_every < 1 or batch < 1:
            raise SgimError(f"evaluate_every={evaluate_every} and batch={batch} must be 1 or more")
        self.environment = environment
        self.world = World(environment, self.teachers, Streams(learner.seed), real=real)
        self.benchmark = benchmark
        self.evaluate_every = evaluate_every
        self.batch = batch
        self.real = real
        self._failures: Counter[str] = Counter()
        self.seconds = 0.0
        replayed = Replayed(learner)
        self.journal: Journal | None = None
        if journal is not None:
            header = {**(about or {}), "evaluate_every": evaluate_every, "batch": batch}
            kept = keep_journal(learner, journal, real=real, adopt=adopt, about=header)
            self.journal, replayed = kept.journal, kept.replayed
            self.world.show_recorded(self.journal)
        self.learner = replayed.learner
        if environment.deterministic:
            self.learner.declare_deterministic()
        self.evaluations = replayed.evaluations
        self.difference = replayed.difference
        self._unfinished_round: tuple[int, int] | None = None
        if replayed.round_size:
            self._unfinished_round = (replayed.round_start, replayed.round_size)
        self._asking: Asking | None = None
        if persons and self.journal is not None:
            self._asking = Asking(self.learner, self.journal, persons)

    @property
    def movements(self) -> int:
        """Movements made so far."""
        return self.learner.movements

    @property
    def asks_persons(self) -> bool:
        """Whether some of its teachers are persons who answer later."""
        return self._asking is not None

    def warm_start(self, journal: str | Path) -> int:
        """Let the learner observe all trials of another run, before its own first.

        Returns:
            How many trials were observed.

        Raises:
            JournalError: If the other journal cannot be read, or is of another task.
            SgimError: If this run has begun already.
        """
        if self.learner.ledger.next_plan:
            raise SgimError("a warm start comes before the first movement, but this run has begun")
        count = 0
        with Journal.open(journal, self.learner.task, append=False) as other:
            for trial in iterate_trials(other.events()):
                self.learner.observe(trial)
                count += 1
        return count

    def go(
        self, movements: int, observer: Observer | None = None, *, pace: float = math.inf
    ) -> list[Evaluated]:
        """Go on until there have been so many movements in all.

        Args:
            movements: In all, those before a resume included.
            observer: Shows how it goes; None for silence.
            pace: Movements a second, at most, so that a person can keep up.

        Returns:
            All evaluations so far.

        Raises:
            Interrupted: If the user stopped it; everything told is in the journal.
            RunError: If world or teachers fail too often in a row; the same holds.
        """
        measured = {} if self.benchmark is None else {"benchmark": self.benchmark.describe()}
        world = {"deterministic": bool(self.environment.deterministic)}
        self._record(Session(session_facts(target=movements, **world, **measured)))
        if observer is not None:
            observer.started(self, movements)
        begun = time.monotonic()
        try:
            with InterruptWish() as wish:
                if self.movements % self.evaluate_every == 0:
                    self._evaluate(observer)
                self._continue(movements, observer, wish, Pace(pace))
                self._evaluate(observer)
        finally:
            self.seconds += time.monotonic() - begun
            if self.journal is not None:
                self.journal.commit()
            if observer is not None:
                observer.ended(self)
        return self.evaluations

    def _continue(
        self, target: int, observer: Observer | None, wish: InterruptWish, pace: Pace
    ) -> None:
        if self._due() and self.movements < target:
            start, asked = self._unfinished_round or (0, 0)
            self._unfinished_round, missing = None, 0
            if asked and start == self.movements:
                missing = max(0, min(self.batch, target - start) - asked)
            self._round(missing, observer)
        shown = time.monotonic()
        while self.movements < target:
            if wish.stop:
                raise Interrupted(f"stopped at {self.movements} of {target} movements")
            if self._asking is not None:
                self._asking.hear()
            if not pace.is_time(self.movements):
                continue
            due = len(self._due())
            self._round(max(0, min(self.batch, target - self.movements) - due), observer)
            if observer is not None and time.monotonic() - shown > 0.1:
                observer.moved(self)
                shown = time.monotonic()

    def _round(self, n: int, observer: Observer | None) -> None:
        """Ask for n plans, and carry out all that are out."""
        learner, world = self.learner, self.world
        first = learner.ledger.next_plan
        if n == 1 and not self._due():
            plan = learner.ask(world.contexts(first, 1)[0])
            if plan.request is not None:
                if self._put(plan):
                    return
                plan = self._answered(plan)
            self._tell(plan, world.execute(plan), observer)
            return
        if self._asking is not None:  # one by one: who is asked is not asked again
            for context in world.contexts(first, max(n, 0)):
                self._put(learner.ask(context))
        elif n > 0:
            learner.ask_batch(n, world.contexts(first, n))
        requests = [plan for plan in self._due() if plan.request is not None]
        if len(requests) > 1 and answer_together(learner, requests, world):
            for plan in requests:
                self._failures[_teacher_of(plan)] = 0
        else:
            for plan in requests:
                self._answered(plan)
        plans = self._due()
        executed = list(zip(plans, world.execute_all(plans), strict=True))
        given_up: RunError | None = None
        while executed:
            due = self.evaluate_every - self.movements % self.evaluate_every
            if outcomes := tell_together(learner, executed[:due]):
                self._told(outcomes, observer)
            else:
                try:
                    self._tell(*executed[0], observer)
                except RunError as error:  # the movements behind it have been made, too
                    given_up = given_up or error
            del executed[: len(outcomes) or 1]
        if given_up is not None:
            raise given_up

    def _due(self) -> list[Plan]:
        """The plans that are out, but for those that wait for a person."""
        pending, asking = self.learner.pending, self._asking
        return pending if asking is None else [p for p in pending if not asking.waits(p)]

    def _put(self, plan: Plan) -> bool:
        """Put a request to a person, if it is one, to be heard of later."""
        if self._asking is None or not self._asking.waits(plan):
            return False
        self._asking.put(plan)
        return True

    def _answered(self, plan: Plan) -> Plan:
        teacher = _teacher_of(plan)
        try:
            following = self.learner.answer(plan, self.world.demonstration(plan))
            self._failures[teacher] = 0
        except JournalError:
            raise
        except Exception as error:
            following = self.learner.answer(plan, None)
            self._failed(teacher, error)
        return following

    def _tell(self, plan: Plan, outcome: Executed, observer: Observer | None) -> None:
        if isinstance(outcome, Exception):
            self._failed("the world", outcome, plan)
        else:
            try:
                self.learner.tell(plan, outcome)
            except JournalError:
                raise
            except SgimError as error:
                self._failed("the world", error, plan)
            else:
                self._told([outcome], observer)
                return
        self._evaluate_if_due(observer)

    def _told(self, outcomes: Sequence[Outcome], observer: Observer | None) -> None:
        self._failures["the world"] = 0
        self.world.observed(outcomes)
        self._evaluate_if_due(observer)

    def _evaluate_if_due(self, observer: Observer | None) -> None:
        if self.learner.movements % self.evaluate_every == 0:
            self._evaluate(observer)

    def _failed(self, who: str, error: Exception, plan: Plan | None = None) -> None:
        """Note a failure; give up after too many in a row."""
        if plan is not None:
            self.learner.fail(plan, f"{type(error).__name__}: {error}")
        if self._failures[who] == 0:
            warnings.warn(f"{who} failed: {type(error).__name__}: {error}", stacklevel=3)
        self._failures[who] += 1
        if self._failures[who] >= self.most_failures:
            raise RunError(
                f"{who} failed {self._failures[who]} times in a row, last with "
                f"{type(error).__name__}: {error}. Nothing told is lost; mend it and resume."
            ) from error

    def _evaluate(self, observer: Observer | None) -> None:
        if self.benchmark is None:
            return
        if self.evaluations and self.evaluations[-1].movements >= self.movements:
            return
        errors = self.benchmark.evaluate(self.learner, self.world.streams, self.movements)
        evaluation = Evaluated(self.movements, errors)
        self._record(evaluation)
        self.evaluations.append(evaluation)
        if observer is not None:
            observer.evaluated(self, evaluation)

    def _record(self, event: Evaluated | Session) -> None:
        if self.journal is not None:
            self.journal.append(event)

    def close(self) -> None:
        """Close the journal; it then opens also where nobody may write."""
        self.learner.record = None
        if self.journal is not None:
            self.journal.close()

    def __enter__(self) -> Run:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _teacher_of(plan: Plan) -> str:
    assert plan.request is not None
    return f"teacher {plan.request.teacher!r}"
