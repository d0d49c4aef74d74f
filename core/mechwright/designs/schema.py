"""JSON schemas of design and requirement files, from the models that read them: for editors that know TOML.

An editor with taplo, such as Even Better TOML, completes and checks a file whose first line is
``#:schema ./four-bar.schema.json``.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.part import NAME_PATTERN
from mechwright.contracts.table import Table
from mechwright.errors import DesignError
from mechwright.mechanics.chain import Chain
from mechwright.mechanics.chain.params import MOST_STAGES, StageTable
from mechwright.plugins.host import Host

FORMAT = 1
"""Version of the design file's own layout."""

HEAD = ("format", "family", "name", "units")
"""Keys of every file; what else it may hold are tables."""

DIALECT = "https://json-schema.org/draft/2020-12/schema"

QUANTITY = {"type": "string", "pattern": r"^\s*[+-]?(\d+\.?\d*|\.\d+)"}
"""A number as text, with or without a unit; whether the unit fits, only the program says."""

_KEYWORD = "#:schema"


def schema_line(family: str, *, requirement: bool = False) -> str:
    """The first line of a file of a family, which tells an editor where its schema is."""
    return f"{_KEYWORD} ./{schema_name(family, requirement=requirement)}"


def schema_name(family: str, *, requirement: bool = False) -> str:
    """Name of the file that holds the schema of design files, or of requirement files."""
    return f"{family}-requirement.schema.json" if requirement else f"{family}.schema.json"


def file_schema(host: Host, family: str = "", *, requirement: bool = False) -> dict[str, Any]:
    """The schema of design files, or of requirement files, of one family or of all that are installed.

    Raises
    ------
    PluginError
        The family is not installed.
    DesignError
        It has no synthesis.
    """
    families = every = [host.family(family)] if family else host.all(Family)
    if requirement:
        families = [one for one in families if one.requirements]
        if not families:
            raise DesignError(f"--requirement: family {family} has no synthesis; leave it out")
    defs: dict[str, Any] = {}
    tables = {one.name: _placed(one.schema(), f"table.{one.name}", defs) for one in host.all(Table)}
    names = sorted(one.name for one in families)
    own = "requirement" if requirement else "parameters"
    asked = {
        one.name: _asked(one, defs) if requirement else placed_schema(one.Params, one.name, defs)
        for one in sorted(families, key=lambda one: one.name)
    }
    # Editors complete what stands under properties; what depends on the family they can only check.
    cases = [_case(name, own, table) for name, table in asked.items()]
    chains = not family
    stages: dict[str, Any] = {}
    if chains:
        stages = {"stage": _stages(every, defs)}
    if chains and requirement:
        least = _asked(Chain(()), defs)
        cases.append({"if": {"required": ["stage"]}, "then": {"properties": {own: least}}})
    return {
        "$schema": DIALECT,
        "title": f"mechwright {own if requirement else 'design'}" + (f", {family}" if family else ""),
        "type": "object",
        "properties": {
            "format": {"const": FORMAT, "description": "Version of the layout of the file."},
            "family": {"enum": names, "description": "The family of mechanisms."},
            "name": {
                "type": "string",
                "pattern": f"^(?:{NAME_PATTERN})$",
                "description": "Name of the files.",
            },
            "units": {
                "enum": ["mm", "inch"],
                "description": "Of bare lengths and feeds; cutting speeds are in m or feet per minute.",
            },
            own: asked[family] if family else {"type": "object"},
            **stages,
            **tables,
        },
        **(
            {"anyOf": [{"required": ["family"]}, {"required": ["stage"]}]}
            if chains
            else {"required": ["family"]}
        ),
        "additionalProperties": False,
        **({} if family else {"allOf": cases}),
        "$defs": defs,
    }


def _case(family: str, table: str, schema: dict[str, Any]) -> dict[str, Any]:
    """Of files or stages of a family: what stands in one of their tables."""
    return {
        "if": {"properties": {"family": {"const": family}}, "required": ["family"]},
        "then": {"properties": {table: schema}},
    }


def _needed(key: str) -> dict[str, Any]:
    return {"required": [key]}


def _stages(families: Sequence[Family[Any]], defs: dict[str, Any]) -> dict[str, Any]:
    """The tables ``[[stage]]`` of a chain: each by its family, as a design of its own."""
    names = sorted(one.name for one in families)
    cases = [
        _case(one.name, "parameters", placed_schema(one.Params, one.name, defs))
        for one in sorted(families, key=lambda one: one.name)
    ]
    fields = placed_schema(StageTable, "stage", defs)["properties"]
    return {
        "type": "array",
        "minItems": 2,
        "maxItems": MOST_STAGES,
        "items": {
            "type": "object",
            "properties": {**fields, "family": {"enum": names}, "parameters": {"type": "object"}},
            "required": ["family"],
            "additionalProperties": False,
            "allOf": cases,
        },
    }


def _asked(family: Family[Any], defs: dict[str, Any]) -> dict[str, Any]:
    """The table ``[requirement]``: by its kind."""
    kinds = list(family.requirements)
    cases = []
    for kind, model in family.requirements.items():
        table = placed_schema(model, f"{family.name}.{kind}", defs)
        table["properties"] = {"kind": {"const": kind}, **table["properties"]}
        cases.append(
            table if len(kinds) == 1 else {**table, "required": [*table.get("required", ()), "kind"]}
        )
    return cases[0] if len(cases) == 1 else {"anyOf": cases}


def as_file(schema: Mapping[str, Any]) -> dict[str, Any]:
    """The schema of a file by that of its values: quantities may be texts with a unit."""
    defs: dict[str, Any] = {}
    found = _placed(schema, "file", defs)
    return {"$schema": DIALECT, **found, "$defs": defs}


def placed_schema(model: type[BaseModel], owner: str, defs: dict[str, Any]) -> dict[str, Any]:
    """The schema of a table as files are written; its definitions go to ``defs``, named after the owner."""
    return _placed(model_schema(model), owner, defs)


def _placed(schema: Mapping[str, Any], owner: str, defs: dict[str, Any]) -> dict[str, Any]:
    """A schema as files are written, its definitions moved to ``defs`` under names of the owner."""
    for name, one in schema.get("$defs", {}).items():
        defs[f"{owner}.{name}"] = _written(one, owner)
    found: dict[str, Any] = _written({key: value for key, value in schema.items() if key != "$defs"}, owner)
    return found


def _written(node: Any, owner: str) -> Any:
    """A schema of values as one of what TOML says: quantities also as text, and nothing is null."""
    if isinstance(node, list):
        return [_written(item, owner) for item in node]
    if not isinstance(node, dict):
        return node
    found = {key: _written(value, owner) for key, value in node.items()}
    if isinstance(found.get("$ref"), str):
        found["$ref"] = found["$ref"].replace("#/$defs/", f"#/$defs/{owner}.")
    if "default" in found and found["default"] is None:
        del found["default"]
    if "anyOf" in found:
        found["anyOf"] = [one for one in found["anyOf"] if one != {"type": "null"}]
    if "unit" in found and found.get("type") in {"number", "integer"}:
        return _either(found, QUANTITY)
    if "enum" in found and (others := found.pop("others", None)):
        return _either(found, {"type": "string", "pattern": others})
    return found


def _either(found: dict[str, Any], other: Mapping[str, Any]) -> dict[str, Any]:
    """A schema or another one; what is told of both stands above them."""
    told: dict[str, Any] = {}
    for key in ("description", "title", "default"):
        if key in found:
            told[key] = found.pop(key)
    return {**told, "anyOf": [found, other]}
