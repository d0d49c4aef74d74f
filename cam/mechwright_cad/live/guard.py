"""Who may talk to the server: the page that it has given out itself, and nobody else on this machine."""

import asyncio
import secrets
from collections.abc import Mapping
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mechwright_cad.live.handover import ENTRY, SHORT, Handover
from mechwright_cad.live.patience import PATIENCE

HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "referrer-policy": "no-referrer",
    "cache-control": "no-store",
    "x-content-type-options": "nosniff",
    "cross-origin-resource-policy": "same-origin",
}
"""Of every answer: the page loads nothing from elsewhere, and nobody shows it in a frame."""

_ONCE = ("host", "origin", "cookie")
"""Headers by which a request is judged: of two a client and this server may each take another one."""
MOST = 2_000_000
"""Bytes of a request."""


class Guard:
    """Refuse whatever does not come from the page itself.

    The address has to begin with the token, or with the place of the browser that has the cookie. ``Host``
    has to be this machine with this port (a name that somebody else has pointed here is refused), and
    ``Origin`` of all that is no GET the same. The entry page, a file, has no origin: its code alone counts.
    """

    def __init__(self, app: ASGIApp, token: str, port: int, handover: Handover) -> None:
        self._app, self._token, self._handover = app, token, handover
        self._hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}
        self._origins = {f"http://{host}" for host in self._hosts}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request; what is no HTTP is turned away."""
        if scope["type"] != "http":
            return
        pairs = [(key.decode("latin-1"), value.decode("latin-1")) for key, value in scope["headers"]]
        headers = dict(pairs)
        if any(sum(key == name for key, _ in pairs) > 1 for name in _ONCE):
            await _refuse(send, 400, b"a header stands twice\n")
            return
        if scope["path"] == f"/{ENTRY}" and scope["method"] == "POST" and headers.get("host") in self._hosts:
            await self._enter(receive, send)
            return
        if not self._known(scope, headers):
            await _refuse(send, 403, b"this address is not known here\n")
            return
        if int(headers.get("content-length", "0") or 0) > MOST:
            await _refuse(send, 413, b"too much\n")
            return
        if scope["method"] != "GET":
            try:
                receive = await asyncio.wait_for(_whole(receive), PATIENCE)
            except TimeoutError:
                await _refuse(send, 408, b"too slow\n")
                return
            except _TooMuchError:
                await _refuse(send, 413, b"too much\n")
                return

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                extra = [(key.encode(), value.encode()) for key, value in HEADERS.items()]
                message = {**message, "headers": [*message["headers"], *extra]}
            await send(message)

        first = scope["path"].split("/")[1]
        await self._app({**scope, "path": scope["path"][len(first) + 1 :]}, receive, guarded)

    async def _enter(self, receive: Receive, send: Send) -> None:
        """The cookie for the code of the entry page."""
        try:
            form = await asyncio.wait_for(_body(receive, SHORT), PATIENCE)
            found = self._handover.admitted(form)
        except (TimeoutError, ValueError, _TooMuchError):
            found = None
        if found is None:
            await _refuse(send, 403, b"this page has been opened already; the terminal has the address\n")
            return
        cookie, page = found
        head = {**HEADERS, "content-type": "text/html; charset=utf-8", "set-cookie": cookie}
        pairs = [(key.encode(), value.encode()) for key, value in head.items()]
        await send({"type": "http.response.start", "status": 200, "headers": pairs})
        await send({"type": "http.response.body", "body": page.encode()})

    def _known(self, scope: Scope, headers: Mapping[str, str]) -> bool:
        given = scope["path"].split("/")[1:2]
        if not given:
            return False
        token = secrets.compare_digest(given[0].encode(), self._token.encode())
        if not token and not self._handover.known(given[0], headers.get("cookie", "")):
            return False
        if headers.get("host") not in self._hosts:
            return False
        foreign: Any = headers.get("origin")
        if scope["method"] == "GET":
            return foreign is None or foreign in self._origins
        return foreign in self._origins


class _TooMuchError(Exception):
    pass


async def _body(receive: Receive, most: int) -> bytes:
    """A body of at most so many bytes; raises _TooMuchError."""
    found, more = b"", True
    while more:
        message = await receive()
        found += message.get("body", b"")
        more = message.get("more_body", False)
        if len(found) > most:
            raise _TooMuchError
    return found


async def _whole(receive: Receive) -> Receive:
    """What gives a body that has been read to its end, then what else comes.

    The length that a client states is no bound, since it need state none.
    """
    parts, size, more = [], 0, True
    while more:
        message = await receive()
        if message["type"] != "http.request":
            parts.append(message)
            break
        size += len(message.get("body", b""))
        if size > MOST:
            raise _TooMuchError
        parts.append(message)
        more = message.get("more_body", False)

    async def again() -> Message:
        return parts.pop(0) if parts else await receive()

    return again


async def _refuse(send: Send, status: int, words: bytes) -> None:
    head = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(words)).encode())]
    if status != 403:
        head.append((b"connection", b"close"))  # what is still to come of the request is not waited for
    await send({"type": "http.response.start", "status": status, "headers": head})
    await send({"type": "http.response.body", "body": words})
