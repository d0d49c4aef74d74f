"""What the command line says when something fails: one line each, also for a fault that nobody expected."""

import os
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mechwright.cli.streams import plain, say
from mechwright.contracts.guard import described, now
from mechwright.errors import MechwrightError, PluginFaultError, UserNote, shortened

TRACEBACK = "MECHWRIGHT_TRACEBACK"
"""Environment variable; if it is not empty, an unexpected fault prints its traceback as well."""

MOST_WARNINGS = 100
"""Warnings of Python's that a command says: one in a loop would hide what else is said."""
_warned: list[str] = []
"""Those that were said, and a mark for each that was not."""
_NO_ROOM = "failed to map segment"
"""What the loader says of a library for which there is no memory."""


def lines(error: BaseException) -> list[str]:
    """Say what went wrong; a character that is not printable, which could steer a terminal, is escaped."""
    said = str(error) if isinstance(error, MechwrightError) else shortened(_unexpected(error))
    shown = [plain(line) for line in said.splitlines()]
    if os.environ.get(TRACEBACK) and (
        isinstance(error, PluginFaultError) or not isinstance(error, MechwrightError)
    ):
        shown += "".join(traceback.format_exception(error)).splitlines()
    return shown


def warned(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: object = None,  # noqa: ARG001 - as warnings.showwarning has it
    line: object = None,  # noqa: ARG001
) -> None:
    """Say a warning of Python's in a line, with the call into a plugin that is under way."""
    if len(_warned) >= MOST_WARNINGS:
        if len(_warned) == MOST_WARNINGS:
            say("mechwright: warning: there are more warnings, which are omitted")
        _warned.append("")
        return
    if category.__name__ == UserNote.__name__:  # that of a worker is a class of the same name
        told = plain(shortened(f"mechwright: warning: {' '.join(str(message).split())}"))
        if told not in _warned:
            _warned.append(told)
            say(told)
        return
    who = now() or "this program"
    said = plain(shortened(" ".join(f"{category.__name__}: {message}".split())))
    _warned.append(f"mechwright: warning: {who}: {said} ({Path(filename).name}, line {lineno})")
    say(_warned[-1])


@contextmanager
def errors_in_lines() -> Iterator[None]:
    """Say each error that nobody catches in a line: of what is deleted or collected, and of threads.

    Such errors end nothing. Python prints a traceback each time.
    """
    _warned.clear()
    before, told = (sys.unraisablehook, threading.excepthook), set[str]()

    def say_once(error: BaseException | None, what: str) -> None:
        if error is None or isinstance(error, SystemExit):
            return
        who = f"{now()}: " if now() else ""
        line = plain(shortened(f"mechwright: warning: {who}{what}: {described(error)}"))
        if line not in told:
            told.add(line)
            say(line)

    sys.unraisablehook = lambda args: say_once(args.exc_value, "an error that ends nothing")
    threading.excepthook = lambda args: say_once(
        args.exc_value, f"the thread {args.thread.name if args.thread else ''!r} ended by an error"
    )
    try:
        yield
    finally:
        sys.unraisablehook, threading.excepthook = before


def _unexpected(error: BaseException) -> str:
    if isinstance(error, MemoryError) or (isinstance(error, ImportError) and _NO_ROOM in str(error)):
        return "there is not enough memory for this; nothing was written"
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename or 'output'}: {error.strerror}"
    return f"{_owner(error)} failed: {described(error)}; please report it, with what {TRACEBACK}=1 shows"


def _owner(error: BaseException) -> str:
    """The plugin whose code was running, innermost first; the program itself if it was none."""
    from mechwright.plugins.host import host

    found = host()
    owners: dict[str, str] = {
        type(entry.item).__module__.partition(".")[0]: entry.item.registered_by
        for entries in found.registered.values()
        for entry in entries.values()
    }
    modules = [
        str(frame.f_globals.get("__name__", "")) for frame, _ in traceback.walk_tb(error.__traceback__)
    ]
    for module in reversed(modules):
        owner = owners.get(module.partition(".")[0])
        if owner is not None:
            return owner
    return "this program"
