"""How the browser that the command opens gets in, with no secret on a command line, which all users can read.

Glossary
--------
entry page
    A file that its user alone can read, and whose name the browser is given. It posts the code.
code
    A secret that is good once: for the cookie.
cookie
    A secret that the browser sends with each request to the place, and shows to no script.
place
    The first part of the page's address: no secret, and of no use without the cookie. The browser's history
    has it, and the cookie goes there alone, whatever else answers on this machine.
"""

import html
import os
import secrets
import shutil
import tempfile
import threading
from pathlib import Path
from urllib.parse import parse_qs

ENTRY = "enter"
"""Where the entry page posts its code to."""
COOKIE = "mechwright-live"
SHORT = 1000
"""Bytes of what the entry page posts, at most."""

_PAGE = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<title>Mechwright live</title>
<form method="post" action="{action}">
<input type="hidden" name="code" value="{code}">
<button>Open the page</button>
</form>
<script>document.forms[0].submit();</script>
</html>
"""
_ONWARDS = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url=/{place}/">
<title>Mechwright live</title>
<a href="/{place}/">Open the page</a>
</html>
"""


class Handover:
    """The entry page of one server, and who has come in by it.

    Parameters
    ----------
    server
        Its address, such as ``http://127.0.0.1:8000``.
    """

    def __init__(self, server: str) -> None:
        self._server = server
        self.place = secrets.token_urlsafe(9)
        self._cookie = secrets.token_urlsafe(32)
        self._code = ""
        self._folder: Path | None = None
        self._lock = threading.Lock()

    def entry_page(self) -> Path:
        """Write an entry page with a new code; raises OSError where that cannot be."""
        self.close()
        with self._lock:
            self._folder = Path(tempfile.mkdtemp(prefix="mechwright-live-"))  # for its user alone
            self._code = secrets.token_urlsafe(32)
            path = self._folder / "open.html"
            handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
                action = html.escape(f"{self._server}/{ENTRY}")
                file.write(_PAGE.format(action=action, code=html.escape(self._code)))
            return path

    def admitted(self, form: bytes) -> tuple[str, str] | None:
        """For a form with the code, the cookie to set and the page that leads on; None for any other."""
        given = parse_qs(form.decode("latin-1"), max_num_fields=4).get("code", [""])[0]
        with self._lock:
            if not self._code or not secrets.compare_digest(given.encode(), self._code.encode()):
                return None
            self._code = ""
        self.close()
        cookie = f"{COOKIE}={self._cookie}; Path=/{self.place}/; HttpOnly; SameSite=Strict"
        return cookie, _ONWARDS.format(place=self.place)

    def known(self, place: str, cookies: str) -> bool:
        """Whether a request to a place comes from the browser that has the cookie."""
        own = secrets.compare_digest(place.encode(), self.place.encode())
        given = [text.strip().partition("=") for text in cookies.split(";")]
        return own and any(
            name == COOKIE and secrets.compare_digest(value.encode(), self._cookie.encode())
            for name, _, value in given
        )

    def close(self) -> None:
        """Remove the entry page, whose code is void then."""
        with self._lock:
            folder, self._folder, self._code = self._folder, None, ""
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)
