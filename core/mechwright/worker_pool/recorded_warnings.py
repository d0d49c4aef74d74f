"""Warnings of worker processes: each result brings them along, and they are issued once where it arrives."""

import builtins
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from mechwright.contracts.guard import during, now


class RecordedWarning(NamedTuple):
    """A warning that was issued in a worker process."""

    category: str
    text: str
    caller: str
    """The call into a plugin that was under way; empty where none was."""
    file: str
    line: int


_recorded: list[RecordedWarning] = []


def _record(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: object = None,  # noqa: ARG001 - as warnings.showwarning has it
    line: object = None,  # noqa: ARG001
) -> None:
    _recorded.append(RecordedWarning(category.__name__, str(message), now(), Path(filename).name, lineno))


def record_warnings() -> None:
    """Record the warnings of this process, a worker, from now on."""
    warnings.showwarning = _record


def take_warnings() -> list[RecordedWarning]:
    """The warnings that were recorded since the last call."""
    found = _recorded[:]
    del _recorded[: len(found)]
    return found


class WarningRelay:
    """Issues each warning of any number of workers once, as if it had been issued in this process."""

    def __init__(self) -> None:
        self._issued: set[RecordedWarning] = set()

    def issue(self, recorded: Iterable[RecordedWarning]) -> None:
        """Issue those that are new."""
        for one in recorded:
            if one in self._issued:
                continue
            self._issued.add(one)
            with during(one.caller):
                warnings.warn_explicit(one.text, _category(one.category), one.file, one.line, registry={})


def _category(name: str) -> type[Warning]:
    """The built-in class of that name; else a new one, as the module of the original may not be imported."""
    own = getattr(builtins, name, None)
    if isinstance(own, type) and issubclass(own, Warning):
        return own
    return type(name, (UserWarning,), {})
