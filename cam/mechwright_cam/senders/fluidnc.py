"""Programs onto the card of a FluidNC controller, by the requests of its web page.

``POST /upload`` takes a form with ``path``, the size under the file's whole name and ``S``, and the file;
``GET /upload?path=`` lists a folder; ``GET /sd/NAME`` gives a file back (FluidNC's wiki, HTTP REST API;
``FluidNC/src/WebUI/WebUIServer.cpp``, version 4).
"""

import re
import secrets
from typing import Any
from urllib.parse import quote, unquote

from mechwright.errors import DesignError, OutputError
from mechwright_cam.senders.certified import ProgramFile
from mechwright_cam.senders.contract import Target
from mechwright_cam.senders.http import Server

CARD = "sd"
"""The volume that ``/upload`` writes to; the other one holds the settings of the controller."""

_PLAIN = re.compile(r"[A-Za-z0-9._ -]+")
"""Of names of folders on the card."""


class FluidNc(Target):
    """A folder of the card; the root by default."""

    PORT = 80
    controls = frozenset({"grbl"})

    def __init__(self, host: str, port: int, path: str) -> None:
        names = [unquote(name) for name in path.split("/") if name]
        names = names[1:] if names[:1] == [CARD] else names
        if wrong := [name for name in names if not _PLAIN.fullmatch(name) or name in {".", ".."}]:
            raise DesignError(
                f"--to: {wrong[0]!r} is no name of a folder on the card; use letters and digits"
            )
        self._server, self._folder = Server("FluidNC", host, port), "".join(f"/{name}" for name in names)

    def send(self, file: ProgramFile, *, replace: bool) -> str:
        """Upload a file, and read it back."""
        name = f"{self._folder}/{file.name}"
        where = f"{self._server.address}/{CARD}{name}"
        if file.name in self._names():
            if self._stored(name) == file.data:
                return f"{where}: is there already"
            if not replace:
                raise OutputError(f"{where}: is there already, with other content; --force to replace it")
        boundary = f"mechwright-{secrets.token_hex(16)}"
        kind = {"Content-Type": f"multipart/form-data; boundary={boundary}"}
        self._checked(
            *self._server.ask("POST", "/upload", _form(name, file.data, self._folder, boundary), kind)
        )
        if self._stored(name) != file.data:
            raise OutputError(
                f"{where}: FluidNC holds another file than was sent: do not run it; send it again"
            )
        return f"{where}: written"

    def _names(self) -> list[str]:
        found = self._checked(*self._server.ask("GET", f"/upload?path={quote(self._folder or '/')}"))
        files = found.get("files", [])
        return (
            [str(one.get("name")) for one in files if isinstance(one, dict)]
            if isinstance(files, list)
            else []
        )

    def _stored(self, name: str) -> bytes:
        status, content = self._server.ask("GET", quote(f"/{CARD}{name}"))
        return content if status == 200 else b""

    def _checked(self, status: int, content: bytes) -> dict[str, Any]:
        found = self._server.data(status, content)
        said = found.get("status") if isinstance(found, dict) else None
        if said is None:
            raise self._server.error("gives another answer than FluidNC does; is it the right address?")
        if str(said).lower() != "ok":
            raise self._server.error(f"refuses it: {said}")
        return dict(found)


def _form(name: str, data: bytes, folder: str, boundary: str) -> bytes:
    """The form of the web page: path, size, file."""
    fields = [("path", folder or "/"), (f"{name}S", str(len(data)))]
    parts = [
        f'--{boundary}\r\nContent-Disposition: form-data; name="{key}"\r\n\r\n{value}\r\n'
        for key, value in fields
    ]
    parts.append(
        f'--{boundary}\r\nContent-Disposition: form-data; name="myfile[]"; filename="{name}"\r\n'
        "Content-Type: application/octet-stream\r\n\r\n"
    )
    return "".join(parts).encode() + data + f"\r\n--{boundary}--\r\n".encode()
