"""Lists the keys of ``[cam]``: ``python docs/cam_keys.py`` writes the tables of ``docs/cam-table.md``."""

import re
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple, get_args, get_origin

from pydantic import BaseModel

from mechwright.contracts.model_schema import model_schema
from mechwright_cam.shop.settings import CamSettings

PAGE = Path(__file__).parent / "cam-table.md"
BEGIN, END = "<!-- keys -->\n", "<!-- end of keys -->\n"
NAMED = {"more": "OFFSET"}
"""How the sub-tables of a key are named, where that is not by tool."""
AXIS = re.compile(r"(.*(?:\.|_))([xyz])")
"""Keys of which there is one for each axis."""


class Key(NamedTuple):
    """A key of ``[cam]``."""

    name: str
    default: str
    meaning: str


def keys(model: type[BaseModel], prefix: str = "") -> Iterator[Key]:
    """Every key of a table and of the tables in it, with its default and unit."""
    schema = model_schema(model)["properties"]
    for name, field in model.model_fields.items():
        default = field.get_default(call_default_factory=True)
        for kind in get_args(field.annotation):  # tables by name, and one that may be omitted
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                by_name = f"{NAMED.get(name, 'TOOL')}." if get_origin(field.annotation) is dict else ""
                yield from keys(kind, f"{prefix}{name}.{by_name}")
        if isinstance(default, BaseModel):
            yield from keys(type(default), f"{prefix}{name}.")
        else:
            yield Key(prefix + name, _shown(default, schema[name]), field.description or "")


def page() -> str:
    """The page with its tables as the settings declare them."""
    text = PAGE.read_text(encoding="utf-8")
    return text.partition(BEGIN)[0] + BEGIN + tables() + END + text.partition(END)[2]


def tables() -> str:
    """A table for each table of ``[cam]``."""
    text = []
    by_table: dict[str, list[Key]] = {}
    for key in keys(CamSettings):
        by_table.setdefault(key.name.rpartition(".")[0], []).append(key)
    for table, found in by_table.items():
        title = f"cam.{table}" if table else "cam"
        text.append(f"\n### `[{title}]`\n\n| key | default | meaning |\n| --- | --- | --- |\n")
        text += [f"| {one.name} | {one.default} | {one.meaning} |\n" for one in _by_axis(found)]
    return "".join(text) + "\n"


def _by_axis(found: list[Key]) -> Iterator[Key]:
    """The same with one row for keys that differ in their axis alone."""
    for like, several in groupby(found, lambda key: _without_axis(key)):
        rows = list(several)
        names = ", ".join(f"`{one.name.rpartition('.')[2]}`" for one in rows)
        axes = ", ".join(one.name[-1].upper() for one in rows)
        yield Key(names, like.default, like.meaning.replace("#", axes) if len(rows) > 1 else rows[0].meaning)


def _without_axis(key: Key) -> Key:
    axis = AXIS.fullmatch("." + key.name.rpartition(".")[2])
    if axis is None or key.default not in {"", "(mm)"} or f"achine {axis[2].upper()}" not in key.meaning:
        return key
    return Key(axis[1], key.default, re.sub(rf"\b{axis[2].upper()}\b", "#", key.meaning, count=1))


def _shown(default: Any, schema: dict[str, Any]) -> str:
    facts = [schema, *schema.get("anyOf", [])]
    unit = next((one["unit"] for one in facts if one.get("unit")), "")
    choices = next((one["enum"] for one in facts if "enum" in one), ())
    unset = default is None or default in ("", (), {})
    others = ", ".join(str(one) for one in choices if one != default)
    if unset:
        return f"({others or unit})" if others or unit else ""
    return f"{_value(default)} {unit.replace('*', ' ')}".strip() + (f" ({others})" if others else "")


def _value(default: Any) -> str:
    if isinstance(default, bool):
        return str(default).lower()
    return f"{default:g}" if isinstance(default, int | float) else str(default)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
