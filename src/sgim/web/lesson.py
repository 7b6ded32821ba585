"""A person teaches a run: leads the arm, shows takes, answers requests; all of it as letters."""

from __future__ import annotations

import json
import sqlite3
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from sgim.errors import SgimError
from sgim.records import Demonstration
from sgim.runs.journal_file import open_file
from sgim.runs.letters import LetterBox, demonstration_detail
from sgim.spaces import FloatArray
from sgim.teachers import read_demonstrations, write_demonstrations
from sgim.web.protocol import (
    Accept,
    Arrange,
    Asked,
    Assess,
    Assessed,
    Decline,
    Desk,
    Export,
    Exported,
    Extend,
    GoalPoint,
    Import,
    Imported,
    ImportedTake,
    Lead,
    Pose,
    Said,
    Skip,
    Suggest,
)
from sgim.web.scenes import Scene
from sgim.web.takes import Takes

LONGEST_PAUSE = 0.1
"""Of the time between two samples, in s, no more passes in the world."""

MORE_TIME = 120.0
"""What `Extend` asks for, in s."""

Letter = Accept | Decline | Skip | Extend | Suggest | Arrange


class Lesson:
    """What a person does with a run.

    Args:
        path: The run's journal.
        scene: Its world; None if it cannot be led, so that only goals can be suggested.
        who: What the learner is called on the page.
    """

    def __init__(self, path: Path, scene: Scene | None, who: str) -> None:
        self.box = LetterBox(path)
        self.scene = scene
        self.takes = None if scene is None else Takes(scene)
        self.teacher = next(iter(self.box.persons()), "person")
        self._path = path
        self._who = who
        self._time = 0.0
        self._joints = np.zeros(0) if scene is None else scene.home.copy()
        self._followed: dict[str, _Followed] = {}

    # Leading.

    def reset(self, joints: list[float] | None) -> Pose:
        """Begin anew, at home or where the joints are said to be."""
        scene = self._scene()
        wanted: FloatArray = scene.home.copy()
        if joints is not None:
            if len(joints) != len(scene.joints):
                raise SgimError(f"{len(joints)} joints came, expected {len(scene.joints)}")
            wanted = np.clip(np.array(joints), scene.low, scene.high)
        self._joints, self._time = wanted, -np.inf
        scene.reset(wanted)
        return self._pose(-1, [])

    def lead(self, message: Lead) -> Pose:
        """Follow the hand, sample by sample."""
        scene = self._scene()
        width = 4 if message.by == "tip" else 1 + len(scene.joints)
        if any(len(sample) != width for sample in message.samples):
            raise SgimError(f"a sample has not {width} numbers, the time among them")
        rows = []
        for moment, *numbers in message.samples:
            given = np.array(numbers)
            if message.by == "tip":
                self._joints = scene.reach(given, self._joints)
            else:
                self._joints = np.clip(given, scene.low, scene.high)
            passed = min(max(moment - self._time, 0.0), LONGEST_PAUSE)
            self._time = max(self._time, moment)
            scene.advance(self._joints, passed)
            rows.append([moment, *self._joints.tolist()])
        return self._pose(message.number, rows)

    def _pose(self, number: int, rows: list[list[float]]) -> Pose:
        scene, at = self._scene(), self._joints
        stuck = np.flatnonzero((at <= scene.low + 1e-6) | (at >= scene.high - 1e-6)).tolist()
        points, held = np.round(scene.points(), 5), np.round(scene.held(at), 5)
        return Pose(number, rows, points.tolist(), held.tolist(), stuck)

    def _scene(self) -> Scene:
        if self.scene is None:
            raise SgimError("this world has no scene: nothing can be led in it")
        return self.scene

    # Takes.

    def assess(self, message: Assess) -> Assessed:
        """Say what a take is worth."""
        self._scene()
        assert self.takes is not None
        return self.takes.assess(message)

    def exported(self, message: Export) -> Exported:
        """Assessed takes as a file of demonstrations."""
        scene, takes = self._scene(), self.takes
        assert takes is not None
        found = [(name, takes.get(name)) for name in message.takes]
        if missing := [name for name, take in found if take is None]:
            raise SgimError(f"takes {', '.join(missing)} have not been assessed")
        shown = [take.demonstration for _, take in found if take is not None]
        return Exported(
            write_demonstrations(
                shown, scene.task, teacher=self.teacher, comment="drawn on the page of sgim"
            )
        )

    def imported(self, message: Import) -> Imported:
        """Takes from a file of demonstrations."""
        scene = self._scene()
        shown = read_demonstrations(message.text.encode(), scene.task)
        takes = []
        for number, one in enumerate(shown[:50]):
            recorded = one.trajectory
            assert recorded is not None
            order = [recorded.joints.index(joint) for joint in scene.joints]
            factor = np.pi / 180 if (recorded.unit, scene.unit) == ("deg", "rad") else 1.0
            positions = recorded.positions[:, order] * factor
            every = max(1, len(positions) // 2000)
            rows = np.column_stack([recorded.times, positions])[::every].tolist()
            takes.append(ImportedTake(f"{number + 1}", rows))
        return Imported(takes, shown[0].teacher)

    # Letters.

    def send(self, message: Letter, name: str) -> Said:
        """Write a letter; what becomes of it is told by `news`."""
        plan = getattr(message, "plan", None)
        if self.box.has(message.id):  # sent again by a page that has not heard of it
            what = "extend" if not isinstance(message, Accept) else "answer"
            self._followed.setdefault(message.id, _Followed(what, plan, 0))
            return Said(message.id, "sent")
        detail: dict[str, Any] = {}
        raw = None
        match message:
            case Accept():
                what = "demonstrate" if plan is None else "answer"
                shown, raw = self._accepted(message)
                detail = demonstration_detail(shown) | {"seconds": message.seconds}
            case Decline():
                what, detail = "decline", {"reason": message.reason}
            case Skip():
                what = "skip"
            case Extend():
                what, detail = "extend", {"seconds": MORE_TIME}
            case Suggest():
                what, detail = "suggest", {"kind": message.kind, "point": message.point}
            case Arrange():
                what = "available"
                detail = {
                    "status": message.status,
                    "time_limit": min(max(message.time_limit, 5.0), 86400.0),
                    "per_hour": min(max(message.per_hour, 1), 10000),
                }
        self.box.send(
            what, self.teacher, id=message.id, name=name, plan=plan, detail=detail, raw=raw
        )
        self._followed[message.id] = _Followed(what, plan, self._last_row())
        return Said(message.id, "sent")

    def _accepted(self, message: Accept) -> tuple[Demonstration, list[list[float]]]:
        take = None if self.takes is None else self.takes.get(message.take)
        if take is None:
            raise SgimError("this take has not been assessed")
        return take.demonstration, take.raw

    def news(self) -> list[Said]:
        """What has become of letters since the last time."""
        if not self._followed:
            return []
        waiting = [name for name, one in self._followed.items() if not one.taken]
        said = self.box.said(waiting) if waiting else {}
        found = []
        for name, words in said.items():
            one = self._followed[name]
            one.taken = True
            found.append(Said(name, "taken", words))
            if one.what not in ("answer", "demonstrate"):
                del self._followed[name]
        for name, one in list(self._followed.items()):
            if one.taken and (end := self._end_of(one)) is not None:
                del self._followed[name]
                found.append(Said(name, "ended", "", *end))
        return found

    def _last_row(self) -> int:
        with closing(open_file(self._path, append=False, durable=False)) as db:
            return int(db.execute("SELECT coalesce(max(seq), 0) FROM events").fetchone()[0])

    def _end_of(self, one: _Followed) -> tuple[float | None, float | None] | None:
        """Errors before and after the episode that a letter led to, if that has ended."""
        try:
            with closing(open_file(self._path, append=False, durable=False)) as db:
                if one.episode is None:
                    one.episode = _episode(db, one)
                row = db.execute(
                    "SELECT detail FROM events WHERE seq > ? AND event = 'closed' AND episode = ?",
                    (one.after, one.episode),
                ).fetchone()
        except (sqlite3.Error, SgimError):
            return None
        if row is None:
            return None
        facts = json.loads(row[0])
        before, after = (None if facts[k] is None else -facts[k] for k in ("before", "after"))
        return before, after

    # Requests.

    def desk(self, going: bool) -> Desk:
        """What is asked now, and what was arranged."""
        now = time.time()
        person = self.box.persons().get(self.teacher, {})
        return Desk(
            [self._asked(request, now) for request in self.box.requests()],
            person.get("status", "away"),
            person.get("time_limit", 0.0),
            person.get("per_hour", 0),
            person.get("left", 0),
            going,
        )

    def _asked(self, request: dict[str, Any], now: float) -> Asked:
        goal = request["goal"]
        shapes = []
        if goal is not None and self.scene is not None:
            shapes = self.scene.goal(goal["kind"], np.array(goal["point"]))
        return Asked(
            plan=request["plan"],
            teacher=request["teacher"],
            who=self._who,
            mode=request["mode"],
            goal=None if goal is None else GoalPoint(goal["kind"], goal["point"]),
            shapes=shapes,
            error=request["error"],
            gain=request["gain"],
            alone=request["alone"],
            replaces=request["replaces"],
            movements=request["movements"],
            waiting=now - request["asked"],
            left=request["until"] - now,
        )


class _Followed:
    """A letter whose fate is not known yet."""

    def __init__(self, what: str, plan: int | None, after: int) -> None:
        self.what = what
        self.plan = plan
        self.after = after
        self.taken = False
        self.episode: int | None = None


def _episode(db: sqlite3.Connection, one: _Followed) -> int | None:
    """The episode that a demonstration went into."""
    if one.plan is not None:
        statement = "SELECT episode FROM events WHERE event = 'planned' AND plan = ?"
        row = db.execute(f"{statement} ORDER BY seq DESC LIMIT 1", (one.plan,)).fetchone()
    else:
        statement = "SELECT episode FROM events WHERE seq > ? AND event = 'opened' AND detail = ?"
        row = db.execute(f"{statement} ORDER BY seq", (one.after, "demonstration")).fetchone()
    return None if row is None else int(row[0])
