"""Whether what a table says of itself can be read: its schema by editors and by us, its lines as TOML."""

import tomllib
from collections.abc import Mapping
from typing import Annotated, Any

from mechwright.contracts.declared import shown
from mechwright.contracts.guard import UnsoundError

_INNER: dict[str, tuple[Any, str]] = {
    **dict.fromkeys(("properties", "$defs", "patternProperties"), (Mapping, "schemas by name are")),
    **dict.fromkeys(("anyOf", "allOf", "oneOf", "prefixItems"), (list, "a list of schemas is")),
}
"""Keys of a schema that hold several schemas, to what holds them."""
_ONE = ("items", "additionalProperties", "not")
"""Keys that hold one, which may be True or False as well."""
_DEFS = "#/$defs/"


def _hold_lines(lines: list[str], *_: object) -> None:
    for line in lines:
        if len(line.splitlines()) > 1:
            raise UnsoundError(f"gives {shown(line)} among its lines, which is several")
    try:
        tomllib.loads("\n".join(lines))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise UnsoundError(f"gives lines that are no TOML: {error}") from error


def _hold_schema(schema: dict[str, Any], *_: object) -> None:
    _plain(schema, "it")
    _schema(schema, "it", schema.get("$defs", {}))


Lines = Annotated[list[str], _hold_lines]
"""Lines of a TOML file."""
Schema = Annotated[dict[str, Any], _hold_schema]
"""A schema of JSON."""


def _plain(value: Any, where: str, deep: int = 0) -> None:
    """JSON has texts, numbers, True, False, None, lists, and objects by names; and it ends."""
    if deep > 100:
        raise UnsoundError("gives a schema without an end")
    if isinstance(value, Mapping):
        for key, one in value.items():
            if not isinstance(key, str):
                raise UnsoundError(f"{where} has the key {shown(key)}; a text is wanted")
            _plain(one, f"{where}[{key!r}]", deep + 1)
    elif isinstance(value, list):
        for place, one in enumerate(value):
            _plain(one, f"{where}[{place}]", deep + 1)
    elif value is not None and type(value) not in {str, int, float, bool}:
        raise UnsoundError(f"{where} is {shown(value)}; something of JSON is wanted")


def _schema(schema: Any, where: str, defs: Any) -> None:
    if not isinstance(schema, Mapping):
        raise UnsoundError(f"{where} is {shown(schema)}; a schema is wanted")
    name = schema.get("$ref", _DEFS)
    if not isinstance(name, str) or (name != _DEFS and name.removeprefix(_DEFS) not in defs):
        raise UnsoundError(f"{where} refers to {shown(name)}, which is not among its $defs")
    for key in (key for key in _INNER if key in schema):
        found: Any = schema[key]
        kind, words = _INNER[key]
        if not isinstance(found, kind):
            raise UnsoundError(f"{where}[{key!r}] is {shown(found)}; {words} wanted")
        for place, one in found.items() if kind is Mapping else enumerate(found):
            _schema(one, f"{where}[{key!r}][{place!r}]", defs)
    for key in _ONE:
        if not isinstance(schema.get(key, True), bool):
            _schema(schema[key], f"{where}[{key!r}]", defs)
