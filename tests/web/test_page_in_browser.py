"""The page in a browser, with a run that has stopped: hockey, led by pointer and by keys."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from sgim.experiments import experiment
from sgim.teachers import load_demonstrations
from sgim.web import serve

from .browsing import VIEWPORT, Hand, letters, until
from .conftest import TABLE, UPWARD, Site


def test_the_token_leaves_the_address_and_scripts_cannot_read_the_cookie(hand: Hand) -> None:
    assert "token" not in hand.page.url
    assert hand.page.evaluate("document.cookie") == ""
    (cookie,) = hand.page.context.cookies()
    assert cookie["httpOnly"]
    assert cookie["sameSite"] == "Strict"


def test_a_page_of_another_site_cannot_connect(browser: Any, hand: Hand, hockey: Site) -> None:
    page = hand.page.context.new_page()
    other = "http://other.example/"
    page.route(other, lambda route: route.fulfill(body="<!doctype html>", content_type="text/html"))
    page.goto(other)
    closed = page.evaluate(
        f"""new Promise(done => {{
            const socket = new WebSocket("ws://{hockey.host}/socket");
            socket.onopen = () => done("open");
            socket.onclose = () => done("closed");
        }})"""
    )
    assert closed == "closed"
    page.close()


def test_a_movement_is_drawn_looked_at_and_kept_as_a_file(hand: Hand, tmp_path: Path) -> None:
    hand.begin()
    hand.sweep([(0.0, -26.0)], 1.5)  # long enough for its replay to be seen
    assert "correspondence error" in hand.assessed()
    before = hand.tip()
    hand.page.keyboard.press("r")
    until(lambda: hand.tip() != before, "the replay moves the mallet")
    hand.page.click("#keep")
    with hand.page.expect_download() as download:
        hand.page.click("#export")
    exported = tmp_path / "mine.json"
    download.value.save_as(exported)
    (shown,) = load_demonstrations(exported, TABLE.task)
    assert shown.trajectory is not None
    assert shown.trajectory.joints == ("x", "y")
    hand.page.set_input_files("#import", exported)
    until(lambda: hand.page.locator("#library li").count() == 2, "two in the library")


def test_a_request_is_answered_with_what_was_drawn(hand: Hand, hockey: Site) -> None:
    hand.page.fill("#person", "Ada")
    hand.page.press("#person", "Tab")
    hand.wait_text("#asked", "asks you")
    hand.page.focus("#stage")
    hand.begin()
    hand.drag(UPWARD)
    assert "you reached" in hand.assessed()
    hand.page.keyboard.press("ArrowRight")
    hand.wait_text("#letters", "sent")
    (answer,) = [letter for letter in letters(hockey.journal) if letter[0] == "answer"]
    detail = json.loads(answer[3])
    assert answer[1] is not None
    assert answer[2] == "Ada"
    assert detail["trajectory"]["joints"] == ["x", "y"]
    assert TABLE.task.check_policy(detail["policy"]) is not None
    hand.wait_text("#asked", "What you show now waits")


def test_nothing_is_drawn_while_nothing_changes(hand: Hand) -> None:
    hand.page.keyboard.press("h")
    drawn = -1

    def still() -> bool:
        nonlocal drawn
        before, drawn = drawn, hand.page.evaluate("window.sgim.drawn()")
        hand.page.wait_for_timeout(400)
        return bool(before == drawn)

    until(still, "the scene is still")


def test_redo_and_trim_can_be_undone(hand: Hand) -> None:
    hand.begin()
    hand.drag(UPWARD)
    first = hand.assessed()
    hand.page.keyboard.press("ArrowLeft")
    hand.wait("window.sgim.state() === 'practice'")
    hand.page.keyboard.press("u")
    hand.wait("window.sgim.state() === 'assessed'")
    assert hand.page.inner_text("#worth") == first


def test_a_second_browser_looks_on_until_the_first_gives_up(
    browser: Any, hand: Hand, hockey: Site
) -> None:
    context = browser.new_context(viewport=VIEWPORT)
    page = context.new_page()
    page.goto(hockey.served.url)
    other = Hand(page)
    other.wait("window.sgim && window.sgim.version() !== null")
    other.wait("document.getElementById('control').disabled")
    page.keyboard.press("Space")
    assert not page.evaluate("window.sgim.control()")
    hand.page.click("#control")
    other.wait("!document.getElementById('control').disabled")
    page.click("#control")
    other.in_control()
    page.click("#control")
    other.wait("!window.sgim.control()")
    context.close()


def test_everything_can_be_done_by_keys(hand: Hand, hockey: Site) -> None:
    keys = hand.page.keyboard
    hand.page.select_option("#tempo", "0.125")
    hand.page.focus("#stage")
    hand.begin()
    keys.down("w")
    hand.wait("window.sgim.joints()[1] > -0.6")
    keys.up("w")
    keys.press("2")
    keys.down("ArrowUp")
    hand.wait("window.sgim.joints()[1] > -0.5")
    keys.up("ArrowUp")
    hand.assessed()
    keys.press("r")
    hand.wait("Number(document.getElementById('seek').value) > 0")
    keys.press("Escape")
    hand.wait("Number(document.getElementById('seek').value) >= 0")
    keys.press("ArrowLeft")
    hand.wait("window.sgim.state() === 'practice'")
    keys.press("u")
    hand.wait("window.sgim.state() === 'assessed'")
    focused = "document.activeElement.id"
    for wanted in ("record", "accept", "keep"):
        hand.page.focus(f"#{wanted}")
        assert hand.page.evaluate(focused) in (wanted, "stage", "")


def test_what_is_said_is_said_to_screen_readers_too(hand: Hand) -> None:
    page = hand.page
    assert page.get_attribute("#status", "aria-live") == "polite"
    unnamed = page.evaluate(
        """[...document.querySelectorAll("button, input, select, canvas")]
            .filter(e => e.offsetParent !== null)
            .filter(e => !(e.innerText || e.title || e.ariaLabel || e.closest("label")?.innerText
                || e.closest("[aria-label]"))).map(e => e.outerHTML)"""
    )
    assert unnamed == []


def test_a_click_on_the_map_replays_the_best_movement_that_is_known(
    browser: Any, tmp_path: Path
) -> None:
    path = tmp_path / "run.sgim"
    with experiment("throwing").start("sgim-acts", path, seed=1, evaluate_every=250) as run:
        run.go(1500)
    with serve(path, port=0) as served:
        context = browser.new_context(viewport=VIEWPORT)
        page = context.new_page()
        page.goto(served.url)
        hand = Hand(page)
        hand.wait_text("#title", "finished")
        hand.wait_text("#strip-legend", "mimic T1")
        hand.wait_text("#modes", "autonomous")
        page.click("#kinds button >> text=throw")
        box = page.locator("#map").bounding_box()
        page.mouse.click(box["x"] + 0.72 * box["width"], box["y"] + 0.4 * box["height"])
        hand.wait_text("#recalled", "Best known: throw")
        hand.wait("Number(document.getElementById('seek').value) > 300")
        hand.picture("watch")
        context.close()


@pytest.mark.parametrize("size", [(390, 780), (1360, 850)])
def test_nothing_sticks_out_at_the_side(hand: Hand, size: tuple[int, int]) -> None:
    hand.page.set_viewport_size({"width": size[0], "height": size[1]})
    for tab in ("#tab-watch", "#tab-teach"):
        hand.page.click(tab)
        wide = hand.page.evaluate("document.documentElement.scrollWidth")
        assert wide <= size[0]


def test_a_touch_leads_the_mallet(browser: Any, hand: Hand, hockey: Site) -> None:
    hand.page.click("#control")
    context = browser.new_context(viewport={"width": 390, "height": 780}, has_touch=True)
    page = context.new_page()
    page.goto(hockey.served.url)
    finger = Hand(page)
    finger.in_control()
    before = page.evaluate("window.sgim.joints()")
    x, y = finger.tip()
    session = context.new_cdp_session(page)
    for kind, points in (
        ("touchStart", [{"x": x, "y": y}]),
        ("touchMove", [{"x": x + 20, "y": y - 30}]),
        ("touchEnd", []),
    ):
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    finger.wait(f"window.sgim.joints()[1] > {before[1]} + 0.05")
    page.click("#control")
    finger.wait("!window.sgim.control()")
    context.close()
