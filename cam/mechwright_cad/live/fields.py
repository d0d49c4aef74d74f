"""The fields of a page: every key of a design's tables, with its bounds, unit, choices and value."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters, first_fields
from mechwright.contracts.table import Table
from mechwright.designs.change import found_at
from mechwright.designs.design import Design
from mechwright.designs.requirement import Requirement

REACH = 4.0
"""A slider goes up to so many times its value, where its bound is farther."""

WHOLE = 10.0
"""Bounds no farther than this are a slider's own whatever the value: it has some 400 steps, so that a ratio
or a fit can be set to a few hundredths all the way."""


def fields_of(design: Design) -> list[dict[str, Any]]:
    """Every key that the page shows, in the order of the file that ``new --all`` writes.

    Each has its dotted ``key``, its ``kind`` (``number``, ``whole``, ``switch``, ``choice``, ``text`` or
    ``data``), ``value`` as the design has it, ``default``, ``unit``, ``about``, whether one sets it
    ``first``, whether the file says it (``given``), and, of numbers, ``low``, ``high``, whether these are
    ``open`` and the ``reach`` of a slider.
    """
    found = [
        field
        for path, table in design.own_tables.items()
        for field in _of_model(type(table), table, path, design.content, first=True)
    ]
    return found + _of_tables(design.readers, design.tables, design.content)


def fields_of_requirement(asked: Requirement, content: Mapping[str, Any]) -> list[dict[str, Any]]:
    """As :func:`fields_of`, of a requirement whose file holds ``content``."""
    found = list(_of_model(type(asked.table), asked.table, "requirement", content, first=True))
    return found + _of_tables([reader for reader, _ in asked.tables], asked.given, content)


def _of_tables(
    readers: Sequence[Table[Any]], tables: Mapping[str, Any], content: Mapping[str, Any]
) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    for reader in sorted(readers, key=lambda one: one.name):
        model = reader.settings
        if model is not None:
            value = tables[reader.name]
            known = value if isinstance(value, model) else None
            found += _of_model(model, known, reader.name, content, first=False)
    return found


def _of_model(
    model: type[BaseModel],
    value: BaseModel | None,
    where: str,
    content: Mapping[str, Any],
    *,
    first: bool,
    whole: bool = False,
) -> Iterator[dict[str, Any]]:
    """Fields of a table and of those in it; of a ``whole`` one each is among the ``first``."""
    schema = model_schema(model)
    shared = schema.get("$defs", {})
    chosen = () if not first else tuple(model.model_fields) if whole else first_fields(model)
    unused = value.unused_fields() if isinstance(value, Parameters) else ()
    for name, field in model.model_fields.items():
        if name in unused:
            continue
        own = getattr(value, name) if value is not None else field.get_default(call_default_factory=True)
        key = f"{where}.{name}"
        if isinstance(own, BaseModel):
            marked = isinstance(field.json_schema_extra, dict) and bool(field.json_schema_extra.get("first"))
            yield from _of_model(
                type(own), own, key, content, first=first and name in chosen, whole=whole or marked
            )
            continue
        if isinstance(own, dict) and any(isinstance(one, BaseModel) for one in own.values()):
            for inner, one in own.items():
                yield from _of_model(type(one), one, f"{key}.{inner}", content, first=first)
            continue
        facts = _facts(schema["properties"][name], shared)
        default = None if field.is_required() else field.get_default(call_default_factory=True)
        yield {
            "key": key,
            "kind": _kind(facts, own),
            "value": plain(own),
            "default": plain(default),
            "about": (field.description or "").replace("``", ""),
            "unit": facts.get("unit", ""),
            "first": name in chosen,
            "given": _given(content, key),
            **_bounds(facts, own),
            **({"choices": facts["enum"]} if "enum" in facts else {}),
        }


def _facts(schema: Mapping[str, Any], shared: Mapping[str, Any]) -> dict[str, Any]:
    """What the schema says of a value that is not left out."""
    found: dict[str, Any] = {}
    for one in (*schema.get("anyOf", ()), *schema.get("allOf", ()), schema):
        if "$ref" in one:
            one = shared.get(one["$ref"].rpartition("/")[2], {})
        if one.get("type") != "null":
            found |= {key: value for key, value in one.items() if key not in {"anyOf", "allOf"}}
    if "const" in found:
        found["enum"] = [found["const"]]
    return found


def _kind(facts: Mapping[str, Any], value: object) -> str:
    if "enum" in facts:
        return "choice"
    kinds = {"boolean": "switch", "integer": "whole", "number": "number", "string": "text"}
    kind = kinds.get(str(facts.get("type")), "data")
    return "data" if isinstance(value, (list, tuple, dict)) else kind


def _bounds(facts: Mapping[str, Any], value: object) -> dict[str, Any]:
    low, over = facts.get("minimum"), facts.get("exclusiveMinimum")
    high, under = facts.get("maximum"), facts.get("exclusiveMaximum")
    found: dict[str, Any] = {
        "low": over if low is None else low,
        "high": under if high is None else high,
        "open": [low is None and over is not None, high is None and under is not None],
    }
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        least, most = found["low"], found["high"]
        far = max(REACH * abs(value or most or least or 0.0), WHOLE)
        found["reach"] = [
            -far if least is None else max(least, -far),
            far if most is None else min(most, far),
        ]
    return found


def _given(content: Mapping[str, Any], key: str) -> bool:
    return found_at(content, key)[0]


def plain(value: Any) -> Any:
    """A value as JSON holds it: tables as objects, tuples as lists."""
    if isinstance(value, BaseModel):
        return {name: plain(getattr(value, name)) for name in type(value).model_fields}
    if isinstance(value, Mapping):
        return {str(name): plain(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (bool, int, float)) or value is None:
        return value
    return str(value)
