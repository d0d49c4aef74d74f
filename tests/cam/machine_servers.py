"""FluidNC and cncjs as their programs are asked: servers of the tests with the answers of the real ones.

FluidNC: wiki.fluidnc.com, HTTP REST API, and ``FluidNC/src/WebUI/WebUIServer.cpp`` of version 4. cncjs 1.11:
``src/server/api``; ``test_send.py`` asks the real one as well, where it is installed.
"""

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from email import message_from_bytes
from email.policy import HTTP
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit


class Card(BaseHTTPRequestHandler):
    """FluidNC with a card."""

    files: dict[str, bytes]
    room: int
    fault: str

    def do_GET(self) -> None:
        path = urlsplit(self.path)
        if path.path == "/upload":
            self.listed(parse_qs(path.query).get("path", ["/"])[0])
        elif (name := unquote(path.path).removeprefix("/sd")) in self.files:
            self.answer(200, self.files[name])
        else:
            self.answer(404, b"<HTML>Unknown page</HTML>")

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if self.path != "/upload" or self.fault == "locked":
            self.answer(404 if self.path != "/upload" else 401, b"Authentication failed")
            return
        head = f"Content-Type: {self.headers['Content-Type']}\r\n\r\n".encode()
        fields: dict[str, bytes] = {}
        name, data = "", b""
        for part in message_from_bytes(head + body, policy=HTTP).iter_parts():
            content = part.get_payload(decode=True)
            assert isinstance(content, bytes)
            if part.get_filename():
                name, data = str(part.get_filename()), content
            else:
                fields[str(part.get_param("name", header="content-disposition"))] = content
        assert list(fields) == ["path", f"{name}S"], "path and size come before the file"
        size = int(fields[f"{name}S"])
        if size > self.room:
            self.answer(200, json.dumps({"status": "Upload failed"}).encode())
            return
        assert size == len(data)
        self.files[name] = data[:-1] if self.fault == "short" else data
        self.listed(fields["path"].decode())

    def listed(self, folder: str) -> None:
        if self.fault == "no card":
            self.answer(200, b'{"status":"No SD card"}')
            return
        start = folder.rstrip("/") + "/"
        names = [one.removeprefix(start) for one in self.files if one.startswith(start)]
        files = [
            {"name": one, "shortname": one, "size": str(len(self.files[start + one])), "datetime": ""}
            for one in names
            if "/" not in one
        ]
        self.answer(
            200, json.dumps({"files": files, "path": folder, "total": "1 GB", "status": "Ok"}).encode()
        )

    def answer(self, status: int, content: bytes) -> None:
        self.send_response(status)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_: object) -> None:
        pass


class Loader(Card):
    """cncjs with machines of some ports."""

    loaded: dict[str, tuple[str, str]]
    user: str

    def do_GET(self) -> None:
        if not self.path.startswith("/api/"):
            self.answer(404, b"<html>Cannot GET</html>")
        elif self.headers["Authorization"] != "Bearer token":
            self.answer(403, b"Forbidden Access")
        elif self.path == "/api/controllers":
            self.said([{"port": port, "ready": True} for port in self.loaded])
        else:
            name, text = self.loaded[parse_qs(urlsplit(self.path).query)["port"][0]]
            self.said({"name": name, "size": len(text), "data": text})

    def do_POST(self) -> None:
        given = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if self.path == "/api/signin":
            right = self.user in {"", f"{given.get('name')}:{given.get('password')}"}
            self.said(
                {"enabled": bool(self.user), "token": "token"} if right else {"msg": "no"},
                200 if right else 401,
            )
        elif given["port"] not in self.loaded:
            self.said({"msg": "Controller not found"}, 400)
        else:
            wait = "\n%wait ; Wait for the planner to empty"
            text = given["gcode"][1:] if self.fault == "short" else given["gcode"]
            self.loaded[given["port"]] = given["name"], text + wait
            self.said({"name": given["name"]})

    def said(self, found: Any, status: int = 200) -> None:
        self.answer(status, json.dumps(found).encode())


@contextmanager
def serving(kind: type[Card], **state: Any) -> Iterator[tuple[type[Card], str]]:
    """The class with the state of its server, and the server's host and port."""
    own = type(kind.__name__, (kind,), {"fault": "", **state})
    with ThreadingHTTPServer(("127.0.0.1", 0), own) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        try:
            yield own, f"127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()
