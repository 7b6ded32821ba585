"""What comes over the websocket: malformed, oversized, too much, out of turn."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed

from sgim.web.flood import Allowance
from sgim.web.messages import MessageError, parse
from sgim.web.pages import GRACE, Page, Pages
from sgim.web.protocol import Hello, Lead

from .conftest import Client, Site

HELLO = {"what": "hello", "version": 1, "page": "p", "name": "Ada"}
LEAD = {"what": "lead", "number": 1, "by": "tip", "samples": [[0.0, 1.0, 1.0, 0.0]]}


def run(page: Callable[[Client], Awaitable[Any]], site: Site, name: str) -> Any:
    async def talk() -> Any:
        async with site.page(name) as client:
            return await page(client)

    return asyncio.run(talk())


def test_messages_come_as_they_were_sent() -> None:
    assert parse(json.dumps(HELLO)) == Hello(1, "p", "Ada")
    assert parse(json.dumps(LEAD)) == Lead(1, "tip", [[0.0, 1.0, 1.0, 0.0]])


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"what": "nothing"}, "what"),
        ({"what": ["hello"]}, "what"),
        ({"more": 1}, "fields"),
        ({"samples": [[float("nan"), 0, 0, 0]]}, "finite"),
        ({"samples": [[float("inf"), 0, 0, 0]]}, "finite"),
        ({"samples": [["1", 0, 0, 0]]}, "number"),
        ({"samples": [[True, 0, 0, 0]]}, "number"),
        ({"samples": [[1e300, 0, 0, 0]]}, "number"),
        ({"samples": [[0.0] * 65]}, "list"),
        ({"samples": [[0.0] * 4] * 301}, "list"),
        ({"samples": {"0": 1}}, "list"),
        ({"number": 1.5}, "whole"),
        ({"by": "teleport"}, "one of"),
        ({"number": None}, "number"),
    ],
)
def test_a_malformed_message_is_refused(change: dict[str, Any], says: str) -> None:
    with pytest.raises(MessageError, match=says):
        parse(json.dumps(LEAD | change))


@pytest.mark.parametrize(
    "text",
    ["", "[]", "null", "1", "{", '{"what"', "[" * 100_000, '{"what": "hello", "version": 1e999}'],
)
def test_what_is_no_message_is_refused(text: str) -> None:
    with pytest.raises(MessageError):
        parse(text)


@pytest.mark.parametrize(
    "text", ["nonsense", json.dumps(LEAD | {"samples": "x"}), json.dumps({"what": "quit"})]
)
def test_who_sends_nonsense_is_disconnected(site: Site, text: str) -> None:
    async def talk(client: Client) -> int | None:
        await client.socket.send(text)
        with pytest.raises(ConnectionClosed) as closed:
            await client.get("never")
        return closed.value.rcvd.code if closed.value.rcvd else None

    assert run(talk, site, "nonsense") == 1008


def test_an_oversized_message_is_refused_unread(site: Site) -> None:
    async def talk(client: Client) -> int | None:
        await client.socket.send("x" * (2 << 20))
        with pytest.raises(ConnectionClosed) as closed:
            await client.get("never")
        return closed.value.rcvd.code if closed.value.rcvd else None

    assert run(talk, site, "large") == 1009


def test_bytes_are_refused(site: Site) -> None:
    async def talk(client: Client) -> None:
        await client.socket.send(b"\x80\x04")
        with pytest.raises(ConnectionClosed):
            await client.get("never")

    run(talk, site, "bytes")


def test_a_flood_is_cut_off(site: Site) -> None:
    async def flood(client: Client) -> None:
        for _ in range(20_000):
            await client.send(what="control", take=False)
        await client.get("never")

    with pytest.raises(ConnectionClosed):
        run(flood, site, "flood")

    async def works(client: Client) -> None:
        await client.get("runfacts")

    run(works, site, "another")


def test_an_allowance_is_filled_again_by_time() -> None:
    now = 0.0
    allowance = Allowance(messages=10, bytes_=1000, seconds=2, clock=lambda: now)
    assert all(allowance.admits(10) for _ in range(20))
    assert not allowance.admits(10)
    now += 0.5
    assert allowance.admits(10)
    assert not Allowance(10, 1000, 2, lambda: now).admits(2001)


def test_another_version_is_asked_to_load_again(site: Site) -> None:
    async def talk(client: Client) -> str:
        await client.send(**HELLO | {"version": 0})
        refused = await client.get("refused")
        return str(refused["words"])

    assert "load it again" in run(talk, site, "old")


def test_only_one_page_is_in_control(site: Site) -> None:
    async def talk() -> None:
        async with site.page("one", "Ada") as one, site.page("two", "Bob") as two:
            await one.send(what="control", take=True)
            await one.get("role", lambda role: role["mine"])
            await two.send(what="control", take=True)
            assert "in control" in (await two.get("refused"))["words"]
            for message in (LEAD, {"what": "reset", "joints": None}, {"what": "skip", **SKIP}):
                await two.send(**message)
                assert "control" in (await two.get("refused"))["words"]
            await one.send(**LEAD)
            assert (await one.get("pose"))["number"] == 1
            await one.send(what="control", take=False)
            await two.get("role", lambda role: not role["holder"])
            await two.send(what="control", take=True)
            await two.get("role", lambda role: role["mine"])
            await two.send(what="control", take=False)

    asyncio.run(talk())


SKIP = {"id": "s", "plan": 1}


def test_leading_obeys_the_limits_whatever_comes(site: Site) -> None:
    async def talk(client: Client) -> None:
        await client.send(what="control", take=True)
        await client.send(**LEAD | {"by": "joints", "samples": [[0.0, 1e6], [0.1, -1e6]]})
        pose = await client.get("pose")
        limits = [abs(row[1]) for row in pose["joints"]]
        assert max(limits) < 13
        assert pose["stuck"] == [0]
        await client.send(**LEAD | {"samples": [[0.0, 1.0]]})
        assert "numbers" in (await client.get("refused"))["words"]
        await client.send(what="reset", joints=[0.0, 0.0])
        assert "joints" in (await client.get("refused"))["words"]
        await client.send(what="control", take=False)

    run(talk, site, "limits")


def test_control_is_kept_for_a_while_for_a_page_that_was_lost() -> None:
    now = 0.0
    pages = Pages(lambda: now)
    one, two, again = Page(), Page(), Page()
    for page, name in ((one, "one"), (two, "two")):
        pages.add(page)
        pages.greet(page, name, name)
    assert pages.control(one, True)
    pages.remove(one)
    assert not pages.control(two, True)
    now += GRACE / 2
    pages.add(again)
    pages.greet(again, "one", "one")
    assert pages.controls(again)
    pages.remove(again)
    now += GRACE
    pages.release()
    said = [json.loads(two.queue.get_nowait() or "{}") for _ in range(two.queue.qsize())]
    assert [role["holder"] for role in said[-2:]] == ["one", ""]
    assert pages.control(two, True)


def test_a_page_that_does_not_read_is_given_up() -> None:
    pages, page = Pages(), Page()
    pages.add(page)
    pages.greet(page, "slow", "Ada")
    for _ in range(1000):
        page.post("text")
    assert page.lost
