"""Files whose bare numbers are in inches: what they say in millimetres, and what is said back to them.

Lengths are in inches there, feeds in inches per minute, cutting speeds in feet per minute. Torques, powers
and masses stay what they are, and a text carries its own unit in any file: ``"6 mm"``.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from mechwright.contracts.table import Table
from mechwright.errors import DesignError

Units = Literal["mm", "inch"]

Schemas = Mapping[str, Mapping[str, Any]]
"""Of tables, by name."""

FACTORS = {"mm": 25.4, "mm/min": 25.4, "mm/s": 25.4, "m/min": 0.3048}
"""A unit of a field to the number of it in what an inch file means by 1."""

_DIGITS = 15
"""Digits that a converted value keeps: the rounding of a factor is none of them."""


def units_of(content: Mapping[str, Any], path: Path) -> Units:
    """The units that a file says; raises DesignError for others than mm and inch."""
    match content.get("units", "mm"):
        case "mm":
            return "mm"
        case "inch":
            return "inch"
        case other:
            raise DesignError(f'{path}: units: is {other!r}; write "mm" or "inch"')


def in_millimetres(
    content: Mapping[str, Any], path: Path, own: Schemas, tables: Iterable[Table[Any]]
) -> tuple[Units, Mapping[str, Any]]:
    """The units of a file, and its content in millimetres, which says no units.

    Its ``tables`` and its ``own`` ones, by name, have schemas that say which of their numbers have a unit.
    Raises DesignError for units that are none.
    """
    units = units_of(content, path)
    if "units" not in content:
        return units, content
    plain = {key: value for key, value in content.items() if key != "units"}
    if units == "mm":
        return units, plain
    schemas = {**{table.name: table.schema() for table in tables if table.name in plain}, **own}
    for name, schema in schemas.items():
        if name in plain:
            plain[name] = converted(plain[name], schema)
    return units, plain


def converted(value: Any, schema: Mapping[str, Any]) -> Any:
    """A value of an inch file in the units of its schema.

    >>> converted({"bore": 0.5, "teeth": 3}, {"properties": {"bore": {"unit": "mm"}, "teeth": {}}})
    {'bore': 12.7, 'teeth': 3}
    """
    return _converted(value, [schema], schema.get("$defs", {}))


def _converted(value: Any, schemas: Iterable[Mapping[str, Any]], defs: Mapping[str, Any]) -> Any:
    """By all of the alternatives that a place has."""
    every = [one for schema in schemas for one in _alternatives(schema, defs)]
    if isinstance(value, (bool, str)):
        return value
    if isinstance(value, (int, float)):
        factors = {FACTORS[one["unit"]] for one in every if one.get("unit") in FACTORS}
        return scaled(value, factors.pop()) if factors else value
    if isinstance(value, Mapping):
        return {key: _converted(one, _of_key(key, every), defs) for key, one in value.items()}
    if isinstance(value, list):
        return [_converted(one, _of_place(place, every), defs) for place, one in enumerate(value)]
    return value


def scaled(value: float, factor: float) -> float:
    """A number in another unit, without a tail of floating point.

    >>> scaled(0.1, 25.4), scaled(0.3, 25.4)
    (2.54, 7.62)
    """
    return float(f"{value * factor:.{_DIGITS}g}")


def _alternatives(schema: Mapping[str, Any], defs: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    if "$ref" in schema:
        yield from _alternatives(defs[schema["$ref"].rpartition("/")[2]], defs)
        return
    yield schema
    for key in ("anyOf", "allOf", "oneOf"):
        for one in schema.get(key, ()):
            yield from _alternatives(one, defs)


def _of_key(key: str, every: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    found = [_value_schema(key, one) for one in every]
    return [one for one in found if isinstance(one, Mapping)]


def _value_schema(key: str, schema: Mapping[str, Any]) -> Any:
    """The schema of a key, of a table by its name, or of a name that matches a pattern.

    >>> _value_schema("A", {"patternProperties": {"^[A-Z]$": {"unit": "mm"}}})
    {'unit': 'mm'}
    """
    if key in schema.get("properties", {}):
        return schema["properties"][key]
    patterns = schema.get("patternProperties", {})
    matching = (value for pattern, value in patterns.items() if re.search(pattern, key))
    return next(matching, schema.get("additionalProperties"))


def _of_place(place: int, every: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    found = []
    for one in every:
        first = one.get("prefixItems", ())
        found.append(first[place] if place < len(first) else one.get("items"))
    return [one for one in found if isinstance(one, Mapping)]


@contextmanager
def told_in(units: Units) -> Iterator[None]:
    """Tell of an inch file that the figures of its mistakes are in millimetres."""
    try:
        yield
    except DesignError as error:
        if units == "mm":
            raise
        lines = (
            f"{line} (this file is in inches; the figures of the message are in mm)"
            for line in str(error).splitlines()
        )
        raise DesignError("\n".join(lines)) from error


def written(change: Mapping[str, Any], units: Units, schemas: Schemas) -> dict[str, Any]:
    """A change as the file is to say it: in an inch file lengths and speeds are texts with their unit.

    ``schemas`` are those of the file's tables.

    >>> cam = {"properties": {"clearance": {"unit": "mm"}, "climb": {}}}
    >>> written({"cam.clearance": 8.0, "cam.climb": True}, "inch", {"cam": cam})
    {'cam.clearance': '8 mm', 'cam.climb': True}
    """
    if units == "mm":
        return dict(change)
    return {path: _with_units(path, value, schemas) for path, value in change.items()}


def _with_units(path: str, value: Any, schemas: Schemas) -> Any:
    table, *keys = path.split(".")
    schema = schemas.get(table, {})
    every, defs = list(_alternatives(schema, schema.get("$defs", {}))), schema.get("$defs", {})
    for key in keys:
        every = [one for found in _of_key(key, every) for one in _alternatives(found, defs)]
    return _texts(value, every, defs)


def _texts(value: Any, every: list[Mapping[str, Any]], defs: Mapping[str, Any]) -> Any:
    if isinstance(value, (list, tuple)):
        placed = (
            (
                one,
                [alternative for found in _of_place(k, every) for alternative in _alternatives(found, defs)],
            )
            for k, one in enumerate(value)
        )
        return [_texts(one, found, defs) for one, found in placed]
    unit = next((str(one["unit"]) for one in every if one.get("unit") in FACTORS), "")
    if not unit or isinstance(value, bool) or not isinstance(value, (int, float)):
        return value
    return f"{value:.{_DIGITS}g} {unit}"
