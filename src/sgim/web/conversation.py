"""What the server does about each message of a page."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from typing import Any, TypeVar

import numpy as np

from sgim.errors import SgimError
from sgim.web import protocol
from sgim.web.lesson import Lesson
from sgim.web.memories import Repertoire
from sgim.web.messages import text_of
from sgim.web.pages import Page, Pages
from sgim.web.protocol import (
    Accept,
    Arrange,
    Assess,
    Control,
    Decline,
    Desk,
    Export,
    Extend,
    FromPage,
    FromServer,
    GoalPoint,
    Hello,
    Import,
    Joint,
    Lead,
    Recall,
    Recalled,
    Refused,
    Reset,
    Said,
    Skip,
    Suggest,
    Welcome,
)
from sgim.web.scenes import Scene, scene_of
from sgim.web.watching import Watched

T = TypeVar("T")


class Conversation:
    """Answers pages.

    Args:
        pages: All pages.
        watched: The runs.
        lesson: How one is taught; None to only watch.
        worker: Where what takes long is computed, one thing after the other.

    Attributes:
        desk: What is asked now, as it was last read.
    """

    def __init__(
        self, pages: Pages, watched: Sequence[Watched], lesson: Lesson | None, worker: Executor
    ) -> None:
        self.desk: Desk | None = None
        self._pages = pages
        self._watched = watched
        self._lesson = lesson
        self._worker = worker
        self._repertoires: dict[int, Repertoire] = {}
        self._scenes: dict[str, Scene | None] = {}

    async def hear(self, page: Page, message: FromPage) -> None:
        """Act on a message, and answer it."""
        try:
            if isinstance(message, Hello):
                await self._greet(page, message)
            elif not page.name:
                page.post(text_of(Refused("say hello first")))
            else:
                await self._act(page, message)
        except (SgimError, KeyError, ValueError) as error:
            page.post(text_of(Refused(f"{error}")))

    async def _greet(self, page: Page, message: Hello) -> None:
        if message.version != protocol.VERSION:
            raise SgimError("this page is of another version of sgim: load it again")
        if not message.page:
            raise SgimError("the page has no name")
        page.post(text_of(await self._run(self._welcome)))
        self._pages.greet(page, message.page, message.name)
        for watched in self._watched:
            page.post(text_of(await self._run(watched.facts)))
            for outcomes in watched.outcomes(all_=True):
                page.post(text_of(outcomes))
        if self.desk is not None:
            page.post(text_of(self.desk))

    def _welcome(self) -> Welcome:
        lesson = self._lesson
        scene = lesson.scene if lesson is not None else self._scene(0)
        joints = []
        if scene is not None:
            columns = (scene.low.tolist(), scene.high.tolist(), scene.home.tolist())
            joints = [Joint(*row) for row in zip(scene.joints, *columns, strict=True)]
        return Welcome(
            protocol.VERSION,
            lesson is not None,
            "" if lesson is None else lesson.teacher,
            None if scene is None else scene.describe(),
            joints,
            "" if scene is None else scene.unit,
            0.0 if scene is None else scene.shortest,
            0.0 if scene is None else scene.longest,
        )

    def _scene(self, run: int) -> Scene | None:
        name = str(self._watched[run].header.get("experiment") or "")
        if name not in self._scenes:
            try:
                self._scenes[name] = scene_of(name)
            except SgimError:  # a package is missing: the run can still be watched
                self._scenes[name] = None
        return self._scenes[name]

    async def _act(self, page: Page, message: FromPage) -> None:
        if isinstance(message, Control):
            if not self._pages.control(page, message.take):
                page.post(text_of(Refused("somebody else is in control")))
            return
        if isinstance(message, Recall):
            page.post(text_of(await self._run(self._recalled, message)))
            return
        lesson = self._lesson
        if lesson is None:
            raise SgimError("this page only watches; to teach, use sgim teach")
        if not self._pages.controls(page):
            raise SgimError("another page is in control, or none: take control first")
        page.post(text_of(await self._taught(lesson, page, message)))

    async def _taught(self, lesson: Lesson, page: Page, message: FromPage) -> FromServer:
        match message:
            case Reset():
                return lesson.reset(message.joints)
            case Lead():
                return lesson.lead(message)
            case Assess():
                return await self._run(lesson.assess, message)
            case Export():
                return await self._run(lesson.exported, message)
            case Import():
                return await self._run(lesson.imported, message)
            case Accept() | Decline() | Skip() | Extend() | Suggest() | Arrange():
                try:
                    return await self._run(lesson.send, message, page.person)
                except SgimError as error:
                    return Said(message.id, "refused", f"{error}")
        raise SgimError("this message is not for a lesson")

    def _recalled(self, message: Recall) -> Recalled:
        """The best movement of a run for a goal."""
        goal = GoalPoint(message.kind, message.point)
        try:
            if not 0 <= message.run < len(self._watched):
                raise SgimError(f"there is no run {message.run}")
            watched = self._watched[message.run]
            if message.run not in self._repertoires:
                recipe = watched.header.get("recipe") or {}
                made = Repertoire(watched.path, watched.task, recipe)
                self._repertoires[message.run] = made
            learner = self._repertoires[message.run].learner()
            solution = learner.solve(message.kind, np.array(message.point))
        except (SgimError, ValueError) as error:
            return Recalled(message.run, goal, f"{error}", [], None, None, [])
        scene = self._scene(message.run)
        movement = None if scene is None else scene.movement(solution.policy).plain()
        shapes = [] if scene is None else scene.goal(message.kind, np.array(message.point))
        expected = np.asarray(solution.expected).tolist()
        return Recalled(message.run, goal, "", expected, solution.cost, movement, shapes)

    async def _run(self, function: Callable[..., T], *arguments: Any) -> T:
        return await asyncio.get_running_loop().run_in_executor(self._worker, function, *arguments)
