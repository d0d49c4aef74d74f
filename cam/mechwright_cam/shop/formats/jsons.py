"""JSON of other programs, read with limits."""

import json
from pathlib import Path
from typing import Any, NoReturn

from mechwright.errors import DesignError

DIGITS = 20
"""Of a whole number, its sign with them: as many as those of 64 bits have."""


def parsed(text: str, where: Path | str, version: int, cure: str) -> dict[str, Any]:
    """The object that a text holds, of a ``version`` up to the one that is known.

    Raises DesignError with one line: where, what, and for a newer version the ``cure``.
    """
    try:
        data = json.loads(text, parse_constant=_no_number, parse_int=_whole)
    except RecursionError as error:
        raise DesignError(f"{where}: is no valid JSON: nested too deep") from error
    except ValueError as error:
        raise DesignError(f"{where}: is no valid JSON: {error}; write it anew") from error
    if not isinstance(data, dict):
        raise DesignError(f"{where}: is no tool library: it holds no JSON object; is it the right file?")
    found = data.get("version", version)
    if isinstance(found, bool) or not isinstance(found, (int, float)):
        raise DesignError(f"{where}: version {found!r} is no number; write it anew")
    if found > version:
        raise DesignError(f"{where}: is of version {found:g}, and {version} is the newest known; {cure}")
    return data


def _whole(digits: str) -> int:
    if len(digits) > DIGITS:
        raise ValueError(f"a whole number has {len(digits):,} digits; {DIGITS} are the most that are read")
    return int(digits)


def _no_number(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number")
