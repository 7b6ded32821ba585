"""Who may speak to the server: only a page of its own, in a browser that was given the token."""

import asyncio
import socket
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
import websockets
from websockets.exceptions import InvalidStatus

from sgim.errors import SgimError
from sgim.web import serve

from .conftest import Site


def refused(site: Site, **given: object) -> int:
    """The status with which a websocket is refused; 101 if it is not."""

    async def connect() -> int:
        options: dict[str, object] = {
            "origin": site.base,
            "additional_headers": site.headers(),
            **given,
        }
        try:
            async with websockets.connect(f"ws://{site.host}/socket", **options):  # type: ignore[arg-type]
                return 101
        except InvalidStatus as error:
            return error.response.status_code

    return asyncio.run(connect())


def test_the_token_is_exchanged_for_a_cookie_and_leaves_the_address(site: Site) -> None:
    answer = httpx.get(site.served.url)
    assert answer.status_code == 303
    assert answer.headers["location"] == "/"
    cookie = answer.headers["set-cookie"]
    port = site.host.rpartition(":")[2]
    assert cookie.startswith(f"sgim_{port}=")
    assert {"HttpOnly", "SameSite=Strict", "Path=/"} <= {p.strip() for p in cookie.split(";")}
    assert urlsplit(site.served.url).query.partition("=")[2] not in cookie


def test_the_page_is_served_to_who_has_the_cookie(site: Site) -> None:
    answer = httpx.get(f"{site.base}/", cookies=site.cookies())
    assert answer.status_code == 200
    assert "<title>sgim" in answer.text


@pytest.mark.parametrize("path", ["/", "/page.js", "/page.css", "/nothing"])
def test_nothing_is_served_without_the_cookie(site: Site, path: str) -> None:
    assert httpx.get(f"{site.base}{path}").status_code == 403
    port = site.host.rpartition(":")[2]
    for name in (f"sgim_{port}", "sgim_1", "sgim"):
        wrong = httpx.get(f"{site.base}{path}", cookies={name: "guessed"})
        assert wrong.status_code == 403


@pytest.mark.parametrize("token", ["", "wrong", "é", "x" * 500])
def test_a_wrong_token_is_refused(site: Site, token: str) -> None:
    answer = httpx.get(f"{site.base}/", params={"token": token})
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:7446", "127.0.0.1", "127.0.0.1:1", "LOCALHOST", ""]
)
def test_another_host_is_misdirected(site: Site, host: str) -> None:
    answer = httpx.get(f"{site.base}/", headers={"Host": host}, cookies=site.cookies())
    assert answer.status_code == 421


def test_two_hosts_or_none_are_misdirected(site: Site) -> None:
    where = (urlsplit(site.base).hostname, urlsplit(site.base).port)
    for lines in ("", f"Host: {site.host}\r\nHost: {site.host}\r\n"):
        with socket.create_connection(where, timeout=5) as raw:
            raw.sendall(f"GET / HTTP/1.1\r\n{lines}Connection: close\r\n\r\n".encode())
            assert raw.recv(100).split()[1] in (b"421", b"400")


def test_localhost_is_a_name_of_it_too(site: Site) -> None:
    port = site.host.rpartition(":")[2]
    headers = {"Host": f"localhost:{port}"}
    assert httpx.get(f"{site.base}/", headers=headers, cookies=site.cookies()).status_code == 200


def test_the_page_itself_may_connect(site: Site) -> None:
    assert refused(site) == 101


@pytest.mark.parametrize(
    "origin",
    [None, "null", "http://evil.example", "https://127.0.0.1", "http://127.0.0.1.evil.example"],
)
def test_a_websocket_of_another_origin_or_of_none_is_refused(
    site: Site, origin: str | None
) -> None:
    assert refused(site, origin=origin) == 403


def test_a_websocket_of_another_port_s_page_is_refused(site: Site) -> None:
    assert refused(site, origin="http://127.0.0.1:1") == 403


def test_a_websocket_without_the_cookie_is_refused(site: Site) -> None:
    assert refused(site, additional_headers={}) == 403
    port = site.host.rpartition(":")[2]
    assert refused(site, additional_headers={"Cookie": f"sgim_{port}=guessed"}) == 403


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS"])
def test_nothing_is_changed_by_a_request(site: Site, method: str) -> None:
    mine = httpx.request(method, f"{site.base}/", cookies=site.cookies())
    assert mine.status_code == 405
    origin = {"Origin": "http://evil.example"}
    other = httpx.request(method, f"{site.base}/", cookies=site.cookies(), headers=origin)
    assert other.status_code == 403


@pytest.mark.parametrize("path", ["/", "/page.js", "/nothing"])
def test_every_answer_forbids_what_is_not_the_page_s_own(site: Site, path: str) -> None:
    for cookies in (site.cookies(), {}):
        headers = httpx.get(f"{site.base}{path}", cookies=cookies).headers
        policy = headers["content-security-policy"]
        assert "default-src 'self'" in policy
        assert "frame-ancestors 'none'" in policy
        assert "unsafe" not in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"


@pytest.mark.parametrize(
    "path", ["/../pyproject.toml", "/..%2f..%2fsecrets", "//etc/passwd", "/static/../__init__.py"]
)
def test_no_path_of_a_request_is_opened(site: Site, path: str) -> None:
    where = (urlsplit(site.base).hostname, urlsplit(site.base).port)
    with socket.create_connection(where, timeout=5) as raw:
        head = f"GET {path} HTTP/1.1\r\nHost: {site.host}\r\nConnection: close\r\n"
        raw.sendall(f"{head}Cookie: {site.headers()['Cookie']}\r\n\r\n".encode())
        assert raw.recv(100).split()[1] == b"404"


def test_only_loopback_is_listened_on_unless_told(site: Site) -> None:
    assert urlsplit(site.served.url).hostname == "127.0.0.1"


def test_to_be_exposed_is_said_loudly(
    journal: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for many in ("0.0.0.0", "::", "224.0.0.1", "example.org"):
        with pytest.raises(SgimError, match="address"):
            serve(journal, port=0, expose=many)
    with pytest.raises(SgimError, match="cannot listen"):
        serve(journal, port=0, expose="192.0.2.1")  # for documentation: no machine has it
    assert "WARNING" in capsys.readouterr().err


def test_a_port_that_is_taken_is_named(journal: Path, site: Site) -> None:
    with pytest.raises(SgimError, match="cannot listen"):
        serve(journal, port=int(site.host.rpartition(":")[2]))
