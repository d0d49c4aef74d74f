"""Writing design and requirement files: TOML with a comment for every key."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.design import FORMAT


def template(family: Family[Any], name: str, tables: Iterable[Table[Any]]) -> str:
    """A commented design file of a family that builds as it is, with the defaults of the ``tables``."""
    return _file(family, name, table_lines(family.Params, "parameters"), *(table.text() for table in tables))


def requirement_template(family: Family[Any], kind: str, name: str, tables: Iterable[Table[Any]]) -> str:
    """A commented requirement file of a family; what it asks for can be met."""
    asked = table_lines(family.requirements[kind], "requirement")
    head = [asked[0], f"kind = {toml(kind)}", *asked[1:]]
    return _file(family, name, head, *(table.text() for table in tables))


def design_text(
    family: Family[Any], name: str, params: Parameters, tables: Iterable[tuple[Table[Any], Any]] = ()
) -> str:
    """The design file of given parameters, and of tables with their values."""
    texts = (table.text(value) for table, value in tables)
    return _file(family, name, table_lines(type(params), "parameters", params), *texts)


def _file(family: Family[Any], name: str, *tables: list[str]) -> str:
    lines = [
        f"# {family.title}: {family.summary}",
        '# Lengths in mm, angles in degrees, speeds in rev/min; a text may carry another unit: "2 in".',
        f"format = {FORMAT}",
        f"family = {toml(family.name)}",
        f"name = {toml(name)}",
    ]
    for table in tables:
        lines += ["", *table] if table else []
    return "\n".join(lines) + "\n"


def table_lines(model: type[BaseModel], where: str, values: BaseModel | None = None) -> list[str]:
    """A table with the values of an instance, or with the defaults of its fields."""
    lines, tables = [f"[{where}]"], []
    schema = model.model_json_schema()["properties"]
    for key, field in model.model_fields.items():
        value = getattr(values, key) if values is not None else field.get_default(call_default_factory=True)
        if isinstance(value, BaseModel):
            tables += ["", *table_lines(type(value), f"{where}.{key}", value)]
            continue
        text = f"{field.description or ''}{_limits(schema[key])}"
        if value is None:
            lines.append(f"# {key} = ...  # {text}")
        else:
            lines.append(f"{key} = {toml(value)}  # {text}")
    return lines + tables


def _limits(schema: dict[str, Any]) -> str:
    options = [schema, *schema.get("anyOf", [])]
    facts: dict[str, Any] = {}
    for option in options:
        facts = {**option, **facts}
    said = [facts["unit"]] if facts.get("unit") else []
    low = facts.get("minimum", facts.get("exclusiveMinimum"))
    high = facts.get("maximum", facts.get("exclusiveMaximum"))
    if low is not None and high is not None:
        said.append(f"{low:g} to {high:g}")
    if "enum" in facts:
        said.append(" | ".join(str(value) for value in facts["enum"]))
    return f" ({', '.join(said)})" if said else ""


def toml(value: Any) -> str:
    """A value as TOML writes it, tables inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, str):
        return json.dumps(str(value), ensure_ascii=False)
    return repr(value)
