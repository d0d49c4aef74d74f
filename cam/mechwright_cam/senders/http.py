"""Requests to a machine on the network, without proxies and redirects."""

import json
from http.client import HTTPConnection, HTTPException
from typing import Any

from mechwright.errors import OutputError

SECONDS = 30.0
"""Until an answer has to begin: a card takes a second for 200 kB, and every piece has this time anew."""

LARGEST = 110_000_000
"""Bytes of an answer: a program that is read back, in JSON."""


class Server:
    """A server by host, port and the path before all others."""

    def __init__(self, name: str, host: str, port: int, route: str = "") -> None:
        self._name, self._host, self._port = name, host, port
        self._route = route.rstrip("/")
        shown = f"[{host}]" if ":" in host else host
        self.address = f"{shown}:{port}"

    def ask(
        self, method: str, path: str, body: bytes | None = None, headers: dict[str, str] | None = None
    ) -> tuple[int, bytes]:
        """Status and content of the answer to one request; raises OutputError where none comes."""
        connection = HTTPConnection(self._host, self._port, timeout=SECONDS)
        try:
            connection.request(method, self._route + path, body, headers or {})
            answer = connection.getresponse()
            content = answer.read(LARGEST + 1)
        except TimeoutError:
            raise OutputError(f"{self.address}: {self._name} does not answer within {SECONDS:g} s") from None
        except (OSError, HTTPException, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
            raise OutputError(
                f"{self.address}: {self._name} cannot be reached: {' '.join(reason.split())}"
            ) from error
        finally:
            connection.close()
        if len(content) > LARGEST:
            raise self.error("answers with too much; is it the right address?")
        return answer.status, content

    def ask_json(
        self, method: str, path: str, given: Any = None, headers: dict[str, str] | None = None
    ) -> Any:
        """The answer as data; raises OutputError where it is none, or says that the request failed."""
        body = None if given is None else json.dumps(given).encode()
        kind = {} if given is None else {"Content-Type": "application/json"}
        return self.data(*self.ask(method, path, body, kind | (headers or {})))

    def data(self, status: int, content: bytes) -> Any:
        """An answer as data; raises OutputError where it says that the request failed."""
        try:
            found = json.loads(content)
        except (ValueError, RecursionError):
            found = None
        if status in {401, 403}:
            raise self.error("asks for a name and a password, or refuses them")
        if status >= 400:
            said = found.get("msg") if isinstance(found, dict) else None
            raise self.error(f"refuses it: {said or f'HTTP {status}'}")
        if found is None:
            raise self.error(f"gives no JSON; is it the address of {self._name}?")
        return found

    def error(self, said: str) -> OutputError:
        """An error of this server."""
        return OutputError(f"{self.address}: {self._name} {said}")
