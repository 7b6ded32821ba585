"""What becomes of a take when its page, its connection or its whole browser is lost."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .browsing import Hand, crash, letters, until, with_profile
from .conftest import UPWARD, Site


def ready(context: Any, site: Site) -> Hand:
    """A person before the page in a browser just begun, in control of it."""
    page = context.new_page()
    page.goto(site.served.url)
    hand = Hand(page)
    hand.take_control()
    return hand


def test_a_take_survives_a_connection_that_breaks_in_its_middle(hand: Hand, hockey: Site) -> None:
    hand.begin()
    hand.drag(UPWARD[:7], lift=False)
    hockey.cut()
    hand.wait_text("#status", "connection is lost")
    x, y = hand.tip()
    for i in range(6):
        hand.page.mouse.move(x + 4 * i, y - 8 * i)
    hand.wait_text("#status", "Connected again")
    hand.page.mouse.move(x + 30, y - 60)
    hand.page.mouse.up()
    worth = hand.assessed()
    assert "lasts" in worth
    taken = hand.page.evaluate("JSON.parse(localStorage.getItem('sgim.draft'))")
    times = [row[0] for row in taken["samples"]]
    assert times == sorted(times)
    assert len(taken["raw"]) >= 12
    assert len(taken["samples"]) >= len(taken["raw"])


def test_a_page_that_is_closed_in_a_drag_teaches_nothing_and_keeps_the_take(
    hand: Hand, hockey: Site
) -> None:
    before = len(letters(hockey.journal))
    hand.begin()
    hand.drag(UPWARD, lift=False)
    hand.wait("localStorage.getItem('sgim.draft') !== null")
    hand.page.reload()
    hand.in_control()
    hand.wait("window.sgim.state() === 'assessed'")
    assert len(letters(hockey.journal)) == before


def test_a_browser_that_is_killed_in_a_drag_loses_nothing_given_and_teaches_no_half(
    browser: Any, hand: Hand, hockey: Site, tmp_path: Path
) -> None:
    hand.page.click("#control")
    first = with_profile(browser, tmp_path)
    hand = ready(first, hockey)
    hand.begin()
    hand.drag(UPWARD)
    hand.assessed()
    before = len(letters(hockey.journal))
    hand.page.keyboard.press("ArrowRight")
    until(lambda: len(letters(hockey.journal)) == before + 1, "it was given")
    hand.wait("window.sgim.state() === 'practice'")
    given = letters(hockey.journal)
    hand.begin()
    hand.drag(UPWARD, lift=False)
    crash(first)
    second = with_profile(browser, tmp_path)
    hand = ready(second, hockey)
    assert letters(hockey.journal) == given
    if hand.state() == "practice":
        hand.begin()
        hand.drag(UPWARD)
    hand.assessed()
    hand.page.keyboard.press("ArrowRight")
    until(lambda: len(letters(hockey.journal)) == before + 2, "the next was given")
    hand.page.click("#control")
    second.close()
