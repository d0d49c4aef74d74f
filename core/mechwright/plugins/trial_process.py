"""The process in which foreign plugins are tried: it loads one after the other, and says what comes of it."""

import atexit
import json
import os
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib.metadata import EntryPoint
from typing import NoReturn

from mechwright.contracts import guard
from mechwright.contracts.alarm import TimeUpError, in_time
from mechwright.plugins.disturbance import Disturbance
from mechwright.plugins.host import Host, register
from mechwright.plugins.trial import AT_END, DEAF, WHILE

Say = Callable[[int, str, str | None], None]


def attempt(words: Sequence[str], points: Sequence[tuple[str, EntryPoint]], seconds: float) -> NoReturn:
    """Load plugins; lines of standard output say what is being done with which one, and the verdict.

    What one registers to be called at the end is called at once; the rest is left to another process then.
    """
    sys.argv[:] = words
    guard.LOADING = seconds
    said, leave, encoded = os.dup(1), os._exit, json.JSONEncoder().encode
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nowhere, number)

    def say(number: int, when: str, verdict: str | None) -> None:
        try:
            os.write(said, encoded([number, when, verdict]).encode() + b"\n")
        except BaseException:
            leave(DEAF)

    say(-1, WHILE, None)
    for number, (distribution, point) in enumerate(points):
        say(number, WHILE, None)
        if _spoilt(number, distribution, point, say):
            break
    leave(0)


def _spoilt(number: int, distribution: str, point: EntryPoint, say: Say) -> bool:
    """Load a plugin; whether the process is of no more use for others."""
    own, leave, calls = os.getpid(), os._exit, atexit._ncallbacks()
    ground, host, broken = Disturbance(), Host(), ""
    try:
        register(host, distribution, point)
        if not any(host.registered.values()):
            broken = "; ".join(one.reason for one in host.broken)
        disturbed = ground.found()
    except BaseException as error:
        disturbed = f"spoils the interpreter ({type(error).__name__})"
        with suppress(BaseException):
            disturbed = ground.found() or disturbed
    if os.getpid() != own:  # it has forked, and this is the other one
        leave(0)
    if disturbed:
        say(number, WHILE, disturbed)
        return True
    if atexit._ncallbacks() != calls:
        say(number, AT_END, None)
        begun = time.monotonic()
        with suppress(TimeUpError), in_time(guard.LOADING):
            atexit._run_exitfuncs()
        late = time.monotonic() - begun >= guard.LOADING  # atexit itself catches what stops a call
        say(number, AT_END, f"takes more than {guard.LOADING:g} s {AT_END}" if late else broken)
        return True
    say(number, WHILE, broken)
    return False
