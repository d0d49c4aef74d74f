"""Tables of a design file against their models, and what is said of mistakes in them."""

from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError

from mechwright.contracts.parameters import Parameters
from mechwright.errors import MOST_LINES, DesignError, did_you_mean

T = TypeVar("T", bound=BaseModel)

_MESSAGES = {
    "tuple_type": "should be a list in square brackets",
    "model_type": "should be a table",
    "int_parsing": "should be a whole number",
    "int_from_float": "should be a whole number",
    "int_type": "should be a whole number",
    "float_type": "should be a number",
    "float_parsing": "should be a number",
}
"""Where pydantic speaks of Python's types, by its own name of the error."""

_LONG = 120
"""Characters of a wrong value that a line shows."""

_COUNTED = ("too_short", "too_long")
"""Errors of a list's length."""

_KINDS = frozenset(("bool", "float", "int", "str"))
"""By which pydantic tells the members of a union apart."""

_SHORT = 40
"""Characters of a list or a table that a line shows."""


def read_table(model: type[T], table: object, source: str, where: str, path: Path = Path("design.toml")) -> T:
    """Validate one table; raises DesignError with a line for each wrong key.

    Files that it names lie in or below the folder of the file ``path``.
    """
    if not isinstance(table, Mapping):
        raise DesignError(f"{source}: {where}: is {table!r}; write a table [{where}]")
    try:
        return model.model_validate(dict(table), context={"path": path})
    except ValidationError as error:
        # What nobody reads is not worked out: looking for what was meant takes a while for each key.
        lines = [f"{source}: {line}" for line in islice(_explain(error, model, where), MOST_LINES)]
        if len(lines) == MOST_LINES:
            lines += [f"{source}: {where}: another mistake"] * (error.error_count() - len(lines))
        raise DesignError("\n".join(lines)) from None


def _explain(error: ValidationError, model: type[BaseModel], where: str) -> Iterator[str]:
    items = error.errors(include_url=False)
    wrong = [item["loc"] for item in items]
    unions = Counter(place[:-1] for place in wrong if place and place[-1] in _KINDS)
    for item in items:
        if unions[item["loc"][:-1]] > 1 and item["loc"][-1] in _KINDS:  # a number or a text: told once
            item["loc"] = item["loc"][:-1]
            unions[item["loc"]] = -1
        elif unions[item["loc"][:-1]] < 0:
            continue
        if item["type"] == "too_short" and any(
            len(place) > len(item["loc"]) and place[: len(item["loc"])] == item["loc"] for place in wrong
        ):
            continue  # what is wrong in a list is not counted among its items
        keys = [str(key) for key in item["loc"]]
        place = ".".join([where, *keys])
        if item["type"] == "extra_forbidden":
            table = _table_at(model, keys[:-1])
            also = table.also if issubclass(table, Parameters) else {}
            said = unknown(keys[-1], tuple(table.model_fields), also=also)
            yield f"{'.'.join([where, *keys[:-1]])}: {said}"
        elif item["type"] == "missing":
            yield f"{place}: is missing"
        elif item["type"] in _COUNTED:
            yield f"{place}: {_counted(item['type'], item['ctx'])}"
        else:
            message = _MESSAGES.get(item["type"]) or item["msg"]
            for start in ("Value error, ", "Input ", "String "):
                message = message.removeprefix(start)
            value = _shown(item.get("input"), item["type"])
            if value and keys and not (value.startswith("'") and value in message):
                message = f"{value} {message}"
            yield f"{place}: {message}"


def _counted(error: str, told: Mapping[str, Any]) -> str:
    """How many entries a list has, and how many it takes."""
    has, least, most = told["actual_length"], told.get("min_length"), told.get("max_length")
    entries = "1 entry" if has == 1 else f"{has if has is not None else 'too many'} entries"
    takes = f"{least} at least are needed" if error == "too_short" else f"{most} at most are taken"
    return f"has {entries}; {takes}"


def _shown(value: object, error: str) -> str:
    """A wrong value as a line shows it; empty where the message has it, or where it would fill the line."""
    if error in {"unit", "file"}:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str | int | float):
        shown = repr(value)
        return shown if len(shown) <= _LONG else f"{shown[:_LONG]} ... ({len(shown)} characters)"
    return repr(value) if error.endswith("_type") and len(repr(value)) <= _SHORT else ""


def _table_at(model: type[BaseModel], keys: list[str]) -> type[BaseModel]:
    for key in keys:
        field = model.model_fields.get(key)
        if field is None:
            continue  # the key of a table of tables
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                model = kind
    return model


def unknown(
    key: str, known: tuple[str, ...], what: str = "key", also: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Say that a key is not known, and what was probably meant: as ``also`` has it, or by its letters."""
    said = also.get(key) or did_you_mean(key, known) or f"known: {', '.join(known)}"
    return f"unknown {what} {key!r}; {said}"
