"""TOML that somebody else has written, read in a time that grows as its length does.

Readers of TOML take the square of the number of parts of a key, and some the square of a key's length. Keys
that no design has are refused before a reader sees the text.
"""

import re
import tomllib
from collections.abc import Mapping
from typing import Any

from mechwright.designs.toml_hints import toml_hint
from mechwright.errors import DesignError

DEEPEST = 64
"""Parts of a key, ``a.b.c``: no table has five, and what reads them takes the square of their number."""
DEEP, DEEP_LIMIT = 8, 50_000
"""A text of more than so many bytes has no key with more than so many parts: thousands of them take long."""
LONGEST_KEY = 255
"""Characters of a part of a key: what names a value by all of its tables holds it once for each value."""
REWRITTEN_LIMIT = 200_000
"""Bytes of a text that is rewritten with its comments, which takes 20 microseconds for each."""


def _deep(parts: int) -> re.Pattern[str]:
    """Finds the beginning of a key with more parts, where keys can begin."""
    name = r"""(?:[\w-]++|"(?:[^"\\\n]++|\\.)*+"|'[^'\n]*+')"""
    return re.compile(rf"(?:^|[\[{{,])[ \t]*+(?:{name}[ \t]*+\.[ \t]*+){{{parts}}}", re.MULTILINE)


_DEEPEST, _DEEP = _deep(DEEPEST), _deep(DEEP)


def toml_of(text: str, where: object) -> dict[str, Any]:
    """Content of a text; raises DesignError, which begins with ``where``, and names line and column."""
    if said := _too_deep(text):
        raise DesignError(f"{where}: is no valid TOML: {said}")
    try:
        content = tomllib.loads(text)
    except RecursionError as error:
        raise DesignError(f"{where}: is no valid TOML: nested too deep") from error
    except tomllib.TOMLDecodeError as error:
        hint = toml_hint(text, str(error))
        raise DesignError(f"{where}: is no valid TOML: {error}" + (f"; {hint}" if hint else "")) from error
    except ValueError as error:  # Python turns no text of thousands of digits into an integer
        raise _too_many_digits(where, "") from error
    if (key := _long_integer(content, where)) is not None:
        raise _too_many_digits(where, f"{key}: ")
    return content


def require_rewritable(text: str, where: str) -> None:
    """Raise DesignError where rewriting a text with its comments would take long."""
    if len(text) > REWRITTEN_LIMIT:
        raise DesignError(
            f"{where} has {len(text):,} characters; at most {REWRITTEN_LIMIT:,} are rewritten, "
            "so edit it by hand"
        )
    if _DEEP.search(text):
        raise DesignError(f"{where} has a key with more than {DEEP} parts; write it as tables within tables")


def _too_deep(text: str) -> str:
    if _DEEPEST.search(text):
        return f"a key with more than {DEEPEST} parts; nested too deep"
    if len(text) > DEEP_LIMIT and _DEEP.search(text):
        return f"a key with more than {DEEP} parts in more than {DEEP_LIMIT:,} characters; nested too deep"
    return ""


def _too_many_digits(where: object, key: str) -> DesignError:
    return DesignError(
        f"{where}: {key}is no valid TOML: an integer has at most 19 digits (64 bits); write fewer"
    )


def _long_integer(content: Mapping[str, Any], where: object) -> str | None:
    """The key of an integer that is none of TOML's, if any; raises DesignError for a key that is too long."""
    waiting: list[tuple[tuple[Any, ...], Any]] = [((), content)]
    while waiting:
        path, value = waiting.pop()
        if isinstance(value, int):
            if not -(1 << 63) <= value < 1 << 63:
                return _dotted(path)
        elif isinstance(value, Mapping):
            for name, one in value.items():
                if len(name) > LONGEST_KEY:
                    raise DesignError(
                        f"{where}: the key {name[:20]!r}... has {len(name):,} characters; write at most "
                        f"{LONGEST_KEY}"
                    )
                waiting.append(((path, name), one))
        elif isinstance(value, list):
            waiting += ((path, one) for one in value)
    return None


def _dotted(path: tuple[Any, ...]) -> str:
    names: list[str] = []
    while path:
        path, name = path
        names.append(name)
    return ".".join(reversed(names))
