"""Changes of a design file: of its content, and of its text, whose comments and order stay."""

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from typing import Any

from mechwright.contracts.finding import Change
from mechwright.designs.bounded_toml import require_rewritable
from mechwright.errors import DesignError


def changed(content: Mapping[str, Any], change: Change) -> dict[str, Any]:
    """The content of a design file with a change; the given one stays as it is.

    Tables that are missing are made; a number is the place in a list of tables, from 1. Raises
    DesignError where a key leads through something that is no table.

    >>> changed({"parameters": {"bore": 10, "hub": 3}}, {"parameters.bore": 12, "parameters.hub": None})
    {'parameters': {'bore': 12}}
    """
    new = deepcopy(dict(content))
    _apply(new, change)
    return new


def rewritten(text: str, change: Change) -> str:
    r"""The text of a design file with a change: comments, order and what else stands in it stay.

    Raises DesignError where the text is no TOML, or the new one would not say what it should.

    >>> rewritten("[parameters]\nbore = 10  # of the shaft\n", {"parameters.bore": 12})
    '[parameters]\nbore = 12  # of the shaft\n'
    """
    require_rewritable(text, "the change cannot be written into the file: it")
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    try:
        document = tomlkit.parse(text)
        _apply(document, change)
        new = tomlkit.dumps(document)
        if "\r\n" in text:
            new = new.replace("\r\n", "\n").replace("\n", "\r\n")
        require_rewritable(new, "the change cannot be written into the file: with it, it")
        faithful = tomllib.loads(new) == changed(tomllib.loads(text), change)
    except (TOMLKitError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise DesignError(f"the change cannot be written into the file: {error}") from error
    if not faithful:
        raise DesignError(
            f"the change cannot be written into the file as it is laid out; set by hand: {', '.join(change)}"
        )
    return new


def _apply(document: dict[str, Any], change: Change) -> None:
    for path, value in change.items():
        *tables, key = path.split(".")
        table: Any = document
        for name in tables:
            if isinstance(table, list):
                table = entry(table, name, path)
                continue
            if name not in table:
                if value is None:
                    break
                table[name] = {}
            inner = table[name]
            if not isinstance(inner, dict | list):
                raise DesignError(f"{path}: {name} is no table")
            table = inner
        else:
            if value is None:
                table.pop(key, None)
            else:
                table[key] = value


def entry(tables: list[Any], place: str, path: str) -> Any:
    """The table of a list by its place, from 1; raises DesignError where there is none.

    >>> entry([{"start": 3}], "1", "stage.1.start")
    {'start': 3}
    """
    if place.isdecimal() and 1 <= int(place) <= len(tables):
        return tables[int(place) - 1]
    raise DesignError(f"{path}: {place!r} is no place in a list of {len(tables)} tables")


def found_at(content: Mapping[str, Any], path: str) -> tuple[bool, Any]:
    """Whether the content of a file says a dotted key, and its value; None where it does not.

    >>> found_at({"stage": [{"start": 3}]}, "stage.1.start"), found_at({}, "cam.tabs")
    ((True, 3), (False, None))
    """
    here: Any = content
    for name in path.split("."):
        if isinstance(here, list) and name.isdecimal() and 1 <= int(name) <= len(here):
            here = here[int(name) - 1]
        elif isinstance(here, Mapping) and name in here:
            here = here[name]
        else:
            return False, None
    return True, here
