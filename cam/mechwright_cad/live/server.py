"""The server of one design, for this machine alone."""

import asyncio
import contextlib
import json
import secrets
import socket
from collections.abc import Awaitable, Callable, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from mechwright.contracts.guard import abandon
from mechwright.designs.files import read_toml
from mechwright.errors import DesignError, MechwrightError, OutputError
from mechwright.output.templates import templates
from mechwright.plugins.host import Host
from mechwright_cad.live.following import Answering, Following
from mechwright_cad.live.guard import Guard
from mechwright_cad.live.handover import Handover
from mechwright_cad.live.patience import MANY, Impatient
from mechwright_cad.live.session import Session
from mechwright_cad.live.wishing import Wishing
from mechwright_cad.viewer import ANIMATION, VIEWER

HOST = "127.0.0.1"
LOOK = 0.4
"""Seconds between two looks at the file."""
WAIT = 20.0
"""Seconds after which a page that waits for news is told that there are none."""

AT_A_TIME = 40
"""Answers that are worked on together: quick ones pass by those that take long."""
GRACE = 1
"""Seconds that answers have which are under way when the server is ended; some would take minutes."""

_SITE = Path(__file__).parent / "site"


class Server:
    """The pages and answers of a file; see :func:`serve`."""

    def __init__(self, path: Path, host: Host, port: int, token: str) -> None:
        self.handover = Handover(f"http://{HOST}:{port}")
        self.shown = shown(path, host)
        self._workers = ThreadPoolExecutor(AT_A_TIME)
        routes = [
            Route("/", _file("text/html; charset=utf-8", _page)),
            Route("/live.js", _file("text/javascript; charset=utf-8", _script)),
            Route("/live.css", _file("text/css; charset=utf-8", _style)),
            Route("/news", self._news),
            *(Route(f"/{name}", _state(state)) for name, state in self.shown.states.items()),
            *(
                Route(f"/{name}", _answer(ask, self._workers), methods=["POST"])
                for name, ask in self.shown.asks.items()
            ),
        ]
        self.app = Guard(Starlette(routes=routes, lifespan=None), token, port, self.handover)

    async def _news(self, request: Request) -> Response:
        """The digest of the file as soon as it is another than the one the page knows."""
        known, digest = request.query_params.get("known", ""), ""
        for _ in range(round(WAIT / LOOK)):
            digest = await run_in_threadpool(self.shown.digest)
            if digest != known or await request.is_disconnected():
                break
            await asyncio.sleep(LOOK)
        return JSONResponse({"digest": digest})

    def close(self) -> None:
        """End what was begun for the page; answers that are under way are nobody's any more."""
        self.handover.close()
        self._workers.shutdown(wait=False, cancel_futures=True)
        self.shown.close()


def shown(path: Path, host: Host) -> Following:
    """A design file or a requirement file, by what is in it; raises OutputError where it cannot be read."""
    return Wishing(path, host) if "requirement" in read_toml(path)[0] else Session(path, host)


def _state(state: Callable[[], Mapping[str, Any]]) -> Callable[[Request], Awaitable[Response]]:
    async def respond(_: Request) -> Response:
        return JSONResponse(dict(state()))

    return respond


def _answer(ask: Answering, workers: Executor) -> Callable[[Request], Awaitable[Response]]:
    async def respond(request: Request) -> Response:
        try:
            body = json.loads(await request.body())
            if not isinstance(body, dict):
                raise DesignError("the page sent no question")
            found = await asyncio.get_running_loop().run_in_executor(workers, ask, body)
        except MechwrightError as error:
            found = {"error": str(error)}
        except ClientDisconnect:
            return Response(status_code=400)
        except (ValueError, RecursionError):
            return JSONResponse({"error": "the page sent no JSON"}, status_code=400)
        except Exception as error:
            found = {"error": f"{type(error).__name__}: {error}; please report it"}
        return Response(json.dumps(found, allow_nan=False), media_type="application/json")

    return respond


def _file(kind: str, content: Callable[[], str]) -> Callable[[Request], Awaitable[Response]]:
    async def respond(_: Request) -> Response:
        return Response(content(), headers={"content-type": kind})

    return respond


def _page() -> str:
    return templates(_SITE, ANIMATION, VIEWER).get_template("live.html").render()


def _script() -> str:
    return templates(_SITE, ANIMATION, VIEWER).get_template("live.js").render()


def _style() -> str:
    sheets = (ANIMATION / "page.css", VIEWER / "viewer.css", _SITE / "live.css")
    return "".join(sheet.read_text(encoding="utf-8") for sheet in sheets)


def bound(port: int) -> socket.socket:
    """A socket on this machine alone, on any free one if ``port`` is 0; raises OutputError if taken."""
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((HOST, port))
        found.listen()
    except (OSError, OverflowError) as error:
        found.close()
        reason = getattr(error, "strerror", None) or error
        raise OutputError(
            f"--port {port}: cannot be had: {reason}; without --port a free one is taken"
        ) from error
    return found


def serve(path: Path, host: Host, port: int, ready: Callable[[str, Handover], None]) -> None:
    """Serve the page of a design until it is interrupted; ``ready`` gets the address, and the other way in.

    Raises
    ------
    OutputError
        The port is taken.
    MechwrightError
        The design file cannot be read.
    """
    with contextlib.closing(bound(port)) as taken:
        number, token = taken.getsockname()[1], secrets.token_urlsafe(32)
        server = Server(path, host, number, token)
        settings = uvicorn.Config(
            server.app,
            log_level="critical",  # of answers that are broken off it would print tracebacks
            timeout_graceful_shutdown=GRACE,
            access_log=False,
            server_header=False,
            lifespan="off",
            ws="none",
            http=Impatient,
            limit_concurrency=MANY,
        )
        try:
            server.shown.described({})  # what is wrong with the file is told before anything is served
            ready(f"http://{HOST}:{number}/{token}/", server.handover)
            with contextlib.suppress(KeyboardInterrupt):
                uvicorn.Server(settings).run(sockets=[taken])
        finally:
            server.close()
            abandon()
