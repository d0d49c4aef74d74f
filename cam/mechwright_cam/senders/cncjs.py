"""Programs into cncjs, by its REST interface.

``POST api/signin`` gives a token, ``GET api/controllers`` the machines whose ports are open, ``POST
api/gcode`` loads a program of one of them and ``GET api/gcode`` gives it back (cncjs 1.10 and 1.11,
``src/server/app.js``).
"""

import json
import os
import re
from typing import Any
from urllib.parse import quote

from mechwright.errors import DesignError, OutputError
from mechwright_cam.senders.certified import ProgramFile
from mechwright_cam.senders.contract import Target
from mechwright_cam.senders.http import Server

USER = "MECHWRIGHT_CNCJS"
"""Environment variable with ``NAME:PASSWORD``, where cncjs has users: a command line is seen by others."""

_WAIT = re.compile(r"(\n%wait\b[^\n]*)?")
"""What cncjs writes behind a program."""


class Cncjs(Target):
    """A machine that cncjs has open."""

    PORT = 8000
    controls = frozenset({"grbl"})
    single = True

    def __init__(self, host: str, port: int, route: str, machine: str) -> None:
        self._server, self._machine = Server("cncjs", host, port, route), machine

    def send(self, file: ProgramFile, *, replace: bool) -> str:
        """Load a program; one of another name is replaced with ``replace`` alone."""
        token = self._token()
        machine = self._open(token)
        where = f"/api/gcode?port={quote(machine, safe='')}"
        loaded = self._asked("GET", where, token)
        name, text = loaded.get("name") or "", file.data.decode("ascii")
        if name == file.name and _is(loaded, text):
            return f"{self._server.address}: {file.name} is loaded already on {machine}"
        if name and not replace:
            raise OutputError(
                f"{self._server.address}: {name} is loaded on {machine}; "
                "unload it there, or --force to replace it"
            )
        self._asked("POST", "/api/gcode", token, {"port": machine, "name": file.name, "gcode": text})
        if not _is(self._asked("GET", where, token), text):
            raise self._server.error(f"gives back another program than {file.name}: unload it there")
        return f"{self._server.address}: {file.name} loaded on {machine}"

    def _token(self) -> str:
        user = os.environ.get(USER, "")
        name, colon, password = user.partition(":")
        if user and not colon:
            raise DesignError(f"{USER}: write NAME:PASSWORD")
        given = {"name": name, "password": password} if user else {}
        kind = {"Content-Type": "application/json"}
        status, content = self._server.ask("POST", "/api/signin", json.dumps(given).encode(), kind)
        if status == 401:
            raise self._server.error(f"refuses name and password: set {USER}=NAME:PASSWORD")
        found = self._server.data(status, content)
        token = found.get("token") if isinstance(found, dict) else None
        if not isinstance(token, str):
            raise self._server.error("gives no token; is it the address of cncjs?")
        return token

    def _open(self, token: str) -> str:
        """The port of the machine that is meant."""
        found = self._asked("GET", "/api/controllers", token, whole=True)
        if not isinstance(found, list):
            raise self._server.error("gives no list of machines; is it the address of cncjs?")
        ports = [str(one["port"]) for one in found if isinstance(one, dict) and one.get("port")]
        if not ports:
            raise self._server.error("has no machine open: open its port there first")
        if self._machine and self._machine not in ports:
            raise self._server.error(f"has {self._machine} not open; open are: {', '.join(ports)}")
        if not self._machine and len(ports) > 1:
            raise self._server.error(f"has several machines open; add --port with one of: {', '.join(ports)}")
        return self._machine or ports[0]

    def _asked(self, method: str, path: str, token: str, given: Any = None, *, whole: bool = False) -> Any:
        found = self._server.ask_json(method, path, given, {"Authorization": f"Bearer {token}"})
        if not whole and not isinstance(found, dict):
            raise self._server.error("gives another answer than cncjs does; is it the right address?")
        return found


def _is(loaded: dict[str, Any], text: str) -> bool:
    """Whether a program is loaded: cncjs itself adds a line that waits for the end of the last move."""
    data = loaded.get("data")
    return isinstance(data, str) and data.startswith(text) and _WAIT.fullmatch(data, len(text)) is not None
