"""Writing design and requirement files: TOML with a comment for every key."""

import json
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.design.design import FORMAT
from mechwright_cam.shop.settings import CamSettings

_OF_ONE_PART = (
    "",
    "# Any of these for one part only, by the part's name:",
    "# [cam.part.NAME]",
    '# origin = "corner"',
)


def template(family: Family[Any], name: str) -> str:
    """A commented design file of a family that builds as it is."""
    return _file(family, name, _lines(family.Params, "parameters"), _lines(CamSettings, "cam"))


def requirement_template(family: Family[Any], kind: str, name: str) -> str:
    """A commented requirement file of a family; what it asks for can be met."""
    table = _lines(family.requirements[kind], "requirement")
    return _file(family, name, [table[0], f"kind = {_toml(kind)}", *table[1:]], _lines(CamSettings, "cam"))


def design_text(family: Family[Any], name: str, params: Parameters, cam: CamSettings) -> str:
    """The design file of given parameters and settings."""
    return _file(family, name, _lines(type(params), "parameters", params), _lines(type(cam), "cam", cam))


def _file(family: Family[Any], name: str, *tables: list[str]) -> str:
    lines = [
        f"# {family.title}: {family.summary}",
        '# Lengths in mm, angles in degrees, speeds in rev/min; a text may carry another unit: "2 in".',
        f"format = {FORMAT}",
        f"family = {_toml(family.name)}",
        f"name = {_toml(name)}",
    ]
    for table in tables:
        lines += ["", *table]
    return "\n".join([*lines, *_OF_ONE_PART]) + "\n"


def _lines(model: type[BaseModel], where: str, values: BaseModel | None = None) -> list[str]:
    """A table with the values of an instance, or with the defaults of its fields."""
    lines, tables = [f"[{where}]"], []
    schema = model.model_json_schema()["properties"]
    for key, field in model.model_fields.items():
        value = getattr(values, key) if values is not None else field.get_default(call_default_factory=True)
        if isinstance(value, BaseModel):
            tables += ["", *_lines(type(value), f"{where}.{key}", value)]
            continue
        text = f"{field.description or ''}{_limits(schema[key])}"
        if value is None:
            lines.append(f"# {key} = ...  # {text}")
        else:
            lines.append(f"{key} = {_toml(value)}  # {text}")
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


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, str):
        return json.dumps(str(value), ensure_ascii=False)
    return repr(value)
