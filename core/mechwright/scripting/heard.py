"""Warnings of Python's in workers, which have no terminal: they come with the tables, and are said once."""

import builtins
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from mechwright.contracts.guard import during, now


class Heard(NamedTuple):
    """A warning, as a worker heard it."""

    category: str
    text: str
    who: str
    """The call into a plugin that was under way; empty where none was."""
    file: str
    line: int


_heard: list[Heard] = []


def _noted(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: object = None,  # noqa: ARG001 - as warnings.showwarning has it
    line: object = None,  # noqa: ARG001
) -> None:
    _heard.append(Heard(category.__name__, str(message), now(), Path(filename).name, lineno))


def listen() -> None:
    """Note warnings in this process, a worker's, from now on."""
    warnings.showwarning = _noted


def taken() -> list[Heard]:
    """What was heard since this was asked last."""
    found = _heard[:]
    del _heard[: len(found)]
    return found


class Teller:
    """Says each warning of any number of workers once, as if it had been heard here."""

    def __init__(self) -> None:
        self._said: set[Heard] = set()

    def tell(self, heard: Iterable[Heard]) -> None:
        """Warn of what is new."""
        for one in heard:
            if one in self._said:
                continue
            self._said.add(one)
            with during(one.who):
                warnings.warn_explicit(one.text, _category(one.category), one.file, one.line, registry={})


def _category(name: str) -> type[Warning]:
    """Python's own of that name; of anybody else's, whose module need not be there, one that is called so."""
    own = getattr(builtins, name, None)
    if isinstance(own, type) and issubclass(own, Warning):
        return own
    return type(name, (UserWarning,), {})
