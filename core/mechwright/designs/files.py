"""Reading files that people write: sizes, encodings, and what lies beside a design file."""

import hashlib
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.contracts.inputs import beside as beside
from mechwright.designs.toml_hints import toml_hint
from mechwright.errors import DesignError
from mechwright.reading import INPUT_LIMIT as INPUT_LIMIT
from mechwright.reading import read_bytes as read_bytes

SIZE_LIMIT = 1_000_000
"""Bytes: a design file is some lines; anything larger was given by mistake."""


DEEPEST = 64
"""Parts of a key, ``a.b.c``: no table has five, and what reads them takes the square of their number."""

_DEEP = re.compile(
    rf"""(?:^|[\[{{,])[ \t]*+(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){{{DEEPEST}}}""",
    re.MULTILINE,
)


def read_text(
    path: Path, limit: int = SIZE_LIMIT, *, older: str | None = None, mark: bool = False
) -> tuple[str, str]:
    """Text and SHA-256 of a file; raises OutputError or DesignError that names it.

    The text is UTF-8; where it is not and ``older`` names another encoding, that is taken for a text
    without null bytes. A byte order mark is taken off, unless ``mark`` asks for it.
    """
    data = read_bytes(path, limit)
    return text_of(data, path, older=older, mark=mark), digest_of(data)


def text_of(data: bytes, path: Path, *, older: str | None = None, mark: bool = False) -> str:
    """The text of what a file holds, as :func:`read_text` gives it."""
    try:
        return data.decode("utf-8" if mark else "utf-8-sig")
    except UnicodeDecodeError as error:
        if older is not None and b"\0" not in data:
            return data.decode(older)
        raise DesignError(f"{path}: is no UTF-8 text (byte {error.start}); is it the right file?") from error


def digest_of(content: str | bytes) -> str:
    """SHA-256 of the file that holds a text, or these bytes."""
    return hashlib.sha256(content.encode() if isinstance(content, str) else content).hexdigest()


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Content and SHA-256 of a TOML file; raises DesignError that names file, line and column."""
    text, digest = read_text(path)
    if _DEEP.search(text):
        raise DesignError(f"{path}: is no valid TOML: a key with more than {DEEPEST} parts; nested too deep")
    try:
        content = tomllib.loads(text)
    except RecursionError as error:
        raise DesignError(f"{path}: is no valid TOML: nested too deep") from error
    except tomllib.TOMLDecodeError as error:
        hint = toml_hint(text, str(error))
        raise DesignError(f"{path}: is no valid TOML: {error}" + (f"; {hint}" if hint else "")) from error
    except ValueError as error:  # Python turns no text of thousands of digits into an integer
        raise _too_many_digits(path, "") from error
    if (key := _long_integer(content)) is not None:
        raise _too_many_digits(path, f"{key}: ")
    return content, digest


def _too_many_digits(path: Path, key: str) -> DesignError:
    return DesignError(
        f"{path}: {key}is no valid TOML: an integer has at most 19 digits (64 bits); write fewer"
    )


def _long_integer(content: Mapping[str, Any]) -> str | None:
    """The key of an integer that is none of TOML's, if there is one."""
    waiting: list[tuple[str, Any]] = [("", content)]
    while waiting:
        key, value = waiting.pop()
        if isinstance(value, int):
            if not -(1 << 63) <= value < 1 << 63:
                return key
        elif isinstance(value, Mapping):
            waiting += ((f"{key}.{name}".lstrip("."), one) for name, one in value.items())
        elif isinstance(value, list):
            waiting += ((key, one) for one in value)
    return None
