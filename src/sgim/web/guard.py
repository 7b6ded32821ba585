"""Who may speak to the server: everything that comes passes here first.

A page of another site can send requests to this machine, and a name that an attacker owns can be
made to point to it. So the Host must be one of a few exact names, a websocket must come from one
of their origins, and both need a cookie that only who knows the token of the URL can get.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Awaitable, Callable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Scope, Receive, Send], Awaitable[None]]

HEADERS = {
    "Content-Security-Policy": (
        "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; "
        "object-src 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""What every answer says: load nothing from elsewhere, be framed by nobody, guess no types."""

_HEADERS = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()]


class Guard:
    """An ASGI application that lets through to another only what may pass.

    Args:
        application: What is guarded.
        hosts: The exact values of Host that are answered, such as ``127.0.0.1:7446``.
        port: The server's port, a part of the cookie's name.

    Attributes:
        token: What a URL must have to be given the cookie.
    """

    def __init__(self, application: Application, hosts: set[str], port: int) -> None:
        self.token = secrets.token_urlsafe(32)
        self._application = application
        self._hosts = {host.encode() for host in hosts}
        self._origins = {f"http://{host}".encode() for host in hosts}
        self._cookie = f"sgim_{port}"
        self._secret = secrets.token_urlsafe(32)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, refuse, or let through."""
        if scope["type"] == "lifespan":
            await self._application(scope, receive, send)
            return
        headers: list[tuple[bytes, bytes]] = scope["headers"]
        refusal = self._refusal(scope, headers)
        if refusal is not None:
            await _refuse(scope, send, *refusal)
            return
        if scope["type"] == "http" and (given := _token(scope)) is not None:
            await self._admit(scope, send, given)
            return
        if not self._is_known(headers):
            words = "Open the address that sgim has printed: it has a token, which this one lacks."
            await _refuse(scope, send, 403, words)
            return
        await self._application(scope, receive, _with_headers(send))

    def _refusal(self, scope: Scope, headers: list[tuple[bytes, bytes]]) -> tuple[int, str] | None:
        hosts = [value for name, value in headers if name == b"host"]
        if len(hosts) != 1 or hosts[0] not in self._hosts:
            return 421, "This server does not answer to that name."
        origins = [value for name, value in headers if name == b"origin"]
        ours = len(origins) == 1 and origins[0] in self._origins
        if not ours and (scope["type"] == "websocket" or origins):
            return 403, "Only the page itself may connect."
        if scope["type"] == "http" and scope["method"] not in ("GET", "HEAD"):
            return 405, "Everything that changes something goes over the page's websocket."
        return None

    async def _admit(self, scope: Scope, send: Send, given: str) -> None:
        """Exchange the token for a cookie, and take it out of the address."""
        if scope["path"] != "/" or not hmac.compare_digest(given.encode(), self.token.encode()):
            await _refuse(scope, send, 403, "That token is not this server's: start sgim again.")
            return
        cookie = f"{self._cookie}={self._secret}; HttpOnly; SameSite=Strict; Path=/"
        headers = [(b"location", b"/"), (b"set-cookie", cookie.encode()), *_HEADERS]
        await send({"type": "http.response.start", "status": 303, "headers": headers})
        await send({"type": "http.response.body", "body": b""})

    def _is_known(self, headers: list[tuple[bytes, bytes]]) -> bool:
        text = "; ".join(value.decode("latin-1") for name, value in headers if name == b"cookie")
        try:
            morsel = SimpleCookie(text).get(self._cookie)
        except CookieError:
            return False
        return morsel is not None and hmac.compare_digest(
            morsel.value.encode(), self._secret.encode()
        )


def _token(scope: Scope) -> str | None:
    query = parse_qs(scope["query_string"].decode("latin-1"))
    return query["token"][0] if "token" in query else None


def _with_headers(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", []), *_HEADERS]
        await send(message)

    return sending


async def _refuse(scope: Scope, send: Send, status: int, words: str) -> None:
    kind = "http" if scope["type"] == "http" else "websocket.http"
    headers = [(b"content-type", b"text/plain; charset=utf-8"), *_HEADERS]
    await send({"type": f"{kind}.response.start", "status": status, "headers": headers})
    await send({"type": f"{kind}.response.body", "body": words.encode()})
