"""A whole lesson in fishing, with ``sgim teach``: asked, drawn, replayed, given, tried, learned."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sgim
from sgim.environments.fishing import FishingRod
from sgim.events import Answered, Closed, Demonstrated, Ended
from sgim.runs.letters import LetterBox

from .browsing import VIEWPORT, Hand, until

STROKES = [(-90.0, -30.0), (-20.0, 100.0)]
"""How the rod's tip is led on the screen: up and to the side, then down to the water."""


class Teaching:
    """A process that runs ``sgim teach``, or a page beside such a run."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "sgim.cli", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        assert self.process.stdout is not None
        self.url = ""
        for line in self.process.stdout:
            if line.startswith("open"):
                self.url = line.split()[1]
                break
        assert self.url, "no address was printed"

    def kill(self) -> None:
        """End it as a power failure would."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait(30)
        assert self.process.stdout is not None
        self.process.stdout.close()

    @property
    def port(self) -> str:
        found = re.search(r":(\d+)/", self.url)
        assert found
        return found[1]


def teach(path: Path, *more: str) -> Teaching:
    return Teaching(
        *("teach", "fishing", "--learner", "sgim-im", "--journal", str(path)),
        *("--movements", "100000", "--pace", "1", "--seed", "1", *more),
    )


def events(path: Path, *kinds: type) -> list[Any]:
    with sgim.Journal.open(path, FishingRod(0.0).task, append=False) as journal:
        return [event for event in journal.events() if isinstance(event, kinds)]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "lesson.sgim"


def visit(browser: Any, url: str, context: Any = None) -> Hand:
    context = context or browser.new_context(viewport=VIEWPORT)
    page = context.new_page()
    page.goto(url)
    hand = Hand(page)
    hand.take_control()
    return hand


def draw(hand: Hand) -> str:
    """Record a movement, again until the float comes down and the learner's copy is near."""
    for _ in range(6):
        hand.begin()
        hand.sweep(STROKES, 4.0)
        worth = hand.assessed()
        places = re.findall(r"float \((\S+), (\S+)\)", worth)
        if len(places) == 2 and np.ptp(np.array(places, dtype=float), axis=0).max() < 0.08:
            return worth
        hand.page.keyboard.press("ArrowLeft")
    raise AssertionError(worth)


def test_a_whole_lesson(browser: Any, path: Path) -> None:
    lesson = teach(path, "--port", "0")
    try:
        hand = visit(browser, lesson.url)
        hand.wait_text("#asked", "asks you")
        hand.picture("teach-request")
        worth = draw(hand)
        assert "correspondence error" in worth
        hand.picture("teach-take")
        hand.page.keyboard.press("ArrowRight")
        said = hand.wait_text("#letters", "learned: error")
        before, after = (float(x) for x in re.findall(r"([\d.]+) %", said)[:2])
        assert after < before, said
        (answer,) = events(path, Answered)
        task = FishingRod(0.0).task
        assert task.primitive is not None
        fitted, _ = task.primitive.fit(answer.demonstration.trajectory)
        assert np.allclose(fitted, answer.demonstration.policy)
        tried = sgim.open(path, task).model.memory.policies  # type: ignore[attr-defined]
        assert any(np.allclose(policy, fitted) for policy in tried), "it was not mimicked"
        shown = answer.demonstration.outcome["float"]
        (closed,) = [
            event
            for event in events(path, Closed)
            if event.pursued is not None and np.allclose(event.pursued.point, shown)
        ]
        assert closed.after > closed.before

        hand.picture("teach-learned")
        hand.picture("teach-phone", (390, 800))

        # What is not answered expires, and the learner explores meanwhile.
        hand.page.fill("#time-limit", "5")
        hand.page.press("#time-limit", "Tab")
        until(lambda: events(path, Ended), "a request expires")
        assert {ended.how for ended in events(path, Ended)} == {"expired"}
        hand.page.click('[data-status="away"]')
        hand.wait_text("#asked", "away")
        hand.page.click("#tab-watch")
        hand.wait_text("#requests-line", "answered 1")
        hand.wait_text("#requests-line", "not answered")
        hand.page.context.close()
    finally:
        lesson.kill()


def test_a_server_that_is_killed_in_a_take_loses_nothing_and_teaches_no_half_of_it(
    browser: Any, path: Path
) -> None:
    lesson = teach(path, "--port", "0")
    beside = Teaching("watch", str(path), "--teach", "--port", "0")
    context = browser.new_context(viewport=VIEWPORT)
    try:
        hand = visit(browser, beside.url, context)
        hand.wait_text("#asked", "asks you")
        hand.begin()
        hand.drag([(-10.0 * i, -3.0 * i) for i in range(8)], lift=False)
        beside.kill()
        hand.wait_text("#status", "connection is lost")
        hand.page.mouse.up()
        beside = Teaching("watch", str(path), "--teach", "--port", beside.port)
        hand.page.keyboard.press("Space")
        assert not events(path, Answered, Demonstrated)
        hand.wait("localStorage.getItem('sgim.draft') !== null")
        hand.page.close()  # it would be back, and in control, before the other
        again = visit(browser, beside.url, context)
        again.wait("window.sgim.state() === 'assessed'")
        again.page.keyboard.press("ArrowLeft")
        draw(again)
        beside.kill()
        again.page.keyboard.press("ArrowRight")
        assert not LetterBox(path).said(["none"])
        beside = Teaching("watch", str(path), "--teach", "--port", beside.port)
        again.page.close()
        last = visit(browser, beside.url, context)
        until(lambda: events(path, Answered, Demonstrated), "what was given arrives")
        last.page.close()
        assert len(events(path, Answered, Demonstrated)) == 1
    finally:
        context.close()
        beside.kill()
        lesson.kill()


def test_a_run_that_is_killed_in_a_request_goes_on_with_it(browser: Any, path: Path) -> None:
    lesson = teach(path, "--port", "0")
    context = browser.new_context(viewport=VIEWPORT)
    try:
        hand = visit(browser, lesson.url, context)
        hand.wait_text("#asked", "asks you")
        (request,) = LetterBox(path).requests()
        lesson.kill()
        hand.page.close()
        lesson = teach(path, "--port", lesson.port)
        hand = visit(browser, lesson.url, context)
        hand.wait_text("#asked", "asks you")
        (again,) = LetterBox(path).requests()
        assert again["plan"] == request["plan"]
        draw(hand)
        hand.page.keyboard.press("ArrowRight")
        until(lambda: events(path, Answered), "the answer arrives")
        lesson.kill()
        lesson = teach(path, "--port", "0")
        until(lambda: LetterBox(path).persons(), "the run goes on")
        assert len(events(path, Answered)) == 1
        assert all(r["plan"] != request["plan"] for r in LetterBox(path).requests())
    finally:
        context.close()
        lesson.kill()
