"""The keys of a design file that a search may change: what kind each is, its bounds, its value now."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters, value_at
from mechwright.designs.change import changed, found_at
from mechwright.designs.design import Design
from mechwright.units import convert

_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*")


@dataclass(frozen=True, eq=False)
class Key:
    """A key of a design file.

    Parameters
    ----------
    path
        Dotted, with the table: ``"parameters.four_bar.input"``.
    kind
        ``"number"``, ``"integer"``, ``"choice"``, or ``"other"`` for lists and free texts.
    low, high
        Bounds of a number, both allowed; infinite where there are none.
    choices
        Of a choice, true and false among them.
    default
        The value where the file leaves the key out, as the shop lends it or else the family's or the table's
        own; None where that means that there is none.
    unit
        Of a number.
    first
        Whether it is one that people set first: what the mechanism is for, and not how it is made.
    given
        Whether it says what is at hand, such as the travel of a mill: no change of it is a remedy.
    fitted
        Whether its default follows from other keys: it is what follows now, None where the file says it.
    lender
        The table that lends the default, such as ``"shop"``; empty where none does.
    usual
        The table's own default of a key that is lent one; None where the program has none.
    """

    path: str
    kind: str
    low: float = -math.inf
    high: float = math.inf
    choices: tuple[Any, ...] = ()
    default: Any = None
    unit: str = ""
    first: bool = False
    given: bool = False
    fitted: bool = False
    lender: str = ""
    usual: Any = None

    @property
    def name(self) -> str:
        """As findings and people say it: without ``parameters``."""
        return self.path.removeprefix("parameters.")

    @property
    def numeric(self) -> bool:
        """Whether its values are numbers."""
        return self.kind in {"number", "integer"}

    def stands_in(self, content: Mapping[str, Any]) -> bool:
        """Whether the content of a design file says it."""
        return found_at(content, self.path)[0]

    def now(self, content: Mapping[str, Any]) -> Any:
        """Its value in the content of a design file: of a number the magnitude in its unit."""
        stands, value = found_at(content, self.path)
        if not stands:
            return self.default
        if self.numeric and isinstance(value, str):
            return convert(value, self.unit)
        return value


def keys_of(design: Design) -> dict[str, Key]:
    """Every key of the tables of a design, by its path, in the order of the tables' fields."""
    found = [
        _as_fitted(design, key, path, table)
        for path, table in design.own_tables.items()
        for key in _keys_of_table(table, path)
    ]
    for reader in design.readers:
        if reader.settings is not None:
            found += _keys(reader.settings, reader.name)
    lent = [
        (reader.name, table, keys)
        for reader in design.readers
        if reader.lender
        for table, keys in reader.lends(design.tables[reader.name]).items()
    ]
    return {key.path: _as_lent(design, key, lent) for key in found}


def _keys_of_table(table: BaseModel, path: str) -> Iterator[Key]:
    """The keys of a table and of those that it has by their names, without unused fields."""
    unused = table.unused_fields() if isinstance(table, Parameters) else ()
    depth = path.count(".") + 1
    yield from (key for key in _keys(type(table), path) if key.path.split(".")[depth] not in unused)
    for field in type(table).model_fields:
        value = getattr(table, field)
        if isinstance(value, dict):
            for name, inner in value.items():
                if isinstance(inner, BaseModel):
                    yield from _keys_of_table(inner, f"{path}.{field}.{name}")


def _as_fitted(design: Design, key: Key, path: str, table: BaseModel) -> Key:
    """A key with the default that follows from the others; what would follow in its place is not known."""
    if not key.fitted:
        return key
    said = key.stands_in(design.content)
    return replace(key, default=None if said else value_at(table, key.path.removeprefix(f"{path}.")))


def _as_lent(design: Design, key: Key, lent: Iterable[tuple[str, str, Mapping[str, Any]]]) -> Key:
    """A key with the default that another table lends it: what is so where the file leaves it out."""
    for lender, name, keys in lent:
        if key.path.partition(".")[0] != name or not found_at({name: keys}, key.path)[0]:
            continue
        own = changed(design.content, {key.path: None}).get(name, {})
        over = next((one.laid_over(own, keys) for one in design.readers if one.name == name), own)
        stands, value = found_at({name: over}, key.path)
        if stands:
            return replace(key, default=value, lender=lender, usual=key.default)
    return key


def named(words: str, keys: Mapping[str, Key]) -> list[Key]:
    """The keys whose names stand in the words of a finding, in their order."""
    by_name = {key.name: key for key in keys.values() if "_" in key.name or "." in key.name}
    by_name |= {key.name: key for key in keys.values() if key.path == f"parameters.{key.name}"}
    found = [by_name.get(word.rstrip(".")) for word in _WORD.findall(words)]
    return list(dict.fromkeys(key for key in found if key is not None))


def meant(words: str, keys: Mapping[str, Key]) -> list[Key]:
    """The keys of tables whose last names stand in the words, such as ``cam.hold.tabs`` for tabs."""
    said = set(_WORD.findall(words))
    return [key for path, key in keys.items() if path.rpartition(".")[2] in said]


@cache
def _keys(model: type[BaseModel], table: str) -> tuple[Key, ...]:
    """Keys of a table; a schema takes a tenth of a second, and every bench asks for the same ones."""
    schema = model_schema(model)
    return tuple(_of(schema, schema.get("$defs", {}), table))


def _of(schema: Mapping[str, Any], definitions: Mapping[str, Any], where: str) -> Iterator[Key]:
    for name, field in schema.get("properties", {}).items():
        path = f"{where}.{name}"
        if "$ref" in field:
            inner = definitions[field["$ref"].rpartition("/")[2]]
            yield from _of(inner, definitions, path)
        else:
            yield _key(path, field)


def _key(path: str, field: Mapping[str, Any]) -> Key:
    first, given, fitted = (bool(field.get(name)) for name in ("first", "given", "fitted"))
    return replace(_plain(path, field), first=first, given=given, fitted=fitted)


def _plain(path: str, field: Mapping[str, Any]) -> Key:
    default = field.get("default")
    facts: dict[str, Any] = {}
    for option in (field, *field.get("anyOf", ())):
        if option.get("type") != "null":
            facts = {**option, **facts}
    kind = facts.get("type")
    if "enum" in facts:
        return Key(path, "choice", choices=tuple(facts["enum"]), default=default)
    if kind == "boolean":
        return Key(path, "choice", choices=(True, False), default=default)
    if kind not in {"number", "integer"}:
        return Key(path, "other", default=default)
    low, high = _bound(facts, "minimum", -math.inf), _bound(facts, "maximum", math.inf)
    return Key(path, kind, low, high, default=default, unit=str(facts.get("unit", "")))


def _bound(facts: Mapping[str, Any], closed: str, none: float) -> float:
    """The last value that is allowed; where the bound itself is left out, one step inside."""
    if closed in facts:
        return float(facts[closed])
    left_out = facts.get(f"exclusive{closed.capitalize()}")
    if left_out is None:
        return none
    step = 1.0 if facts.get("type") == "integer" else max(abs(left_out), 1.0) * 1e-3
    return float(left_out) + math.copysign(step, -none)


def thickness_keys(design: Design, thickness: float) -> list[str]:
    """Paths of the keys that give a thickness of this value, mm."""
    return [
        key.path
        for key in keys_of(design).values()
        if "thickness" in key.path and key.numeric and key.now(design.content) == thickness
    ]
