"""Where programs go, as a user writes it."""

import re
from pathlib import Path
from urllib.parse import urlsplit

from mechwright.errors import DesignError
from mechwright_cam.senders.cncjs import Cncjs
from mechwright_cam.senders.contract import Target
from mechwright_cam.senders.fluidnc import FluidNc
from mechwright_cam.senders.folder import WatchedFolder

READERS = {"cncjs", "fluidnc"}
"""Schemes of addresses; anything else is a folder."""

_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+.-]+)://")
"""Of at least two letters: one letter is a drive of Windows."""


def target(words: str, port: str = "") -> Target:
    """The target of ``FOLDER``, ``cncjs://HOST:PORT`` or ``fluidnc://HOST/FOLDER``.

    Parameters
    ----------
    words
        What the user has written.
    port
        Of cncjs: the serial port of the machine, needed where several are open.

    Raises
    ------
    DesignError
        The address has another scheme, no host or a port that is no number.
    """
    match = _SCHEME.match(words)
    scheme = match[1].lower() if match else ""
    if port and scheme != "cncjs":
        raise DesignError("--port: only with --to cncjs://HOST; leave it out")
    if not scheme:
        return WatchedFolder(Path(words))
    if scheme not in READERS:
        raise DesignError(
            f"--to: {scheme}:// is not known; write FOLDER, cncjs://HOST:8000 or fluidnc://HOST"
        )
    try:
        address = urlsplit(words)
        host, number = address.hostname, address.port
    except ValueError as error:
        raise DesignError(f"--to: {words}: {error}; write {scheme}://HOST or {scheme}://HOST:PORT") from None
    if not host or address.query or address.fragment or address.username is not None:
        raise DesignError(
            f"--to: {words}: write {scheme}://HOST or {scheme}://HOST:PORT, and a path behind it"
        )
    if scheme == "cncjs":
        return Cncjs(host, number or Cncjs.PORT, address.path, port)
    return FluidNc(host, number or FluidNc.PORT, address.path)
