"""Writing design and requirement files: TOML with a comment for every key."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from mechwright.contracts.family import Family
from mechwright.contracts.inputs import InputFile
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters, first_fields
from mechwright.contracts.table import Table
from mechwright.designs.schema import FORMAT, schema_line
from mechwright.mechanics.chain import Chain, ChainParams, StageTable


def template(
    family: Family[Any],
    name: str,
    tables: Iterable[Table[Any]],
    *,
    short: bool = False,
    draft: Parameters | None = None,
) -> str:
    """A commented design file of a family that builds as it is, with the defaults of the ``tables``.

    The ``short`` form has the keys that one sets first, and what a ``draft`` sets.
    """
    values = draft if draft is not None and draft.model_fields_set else None
    own = table_lines(family.Params, "parameters", values, first=short)
    rest = [table.first() if short else table.text() for table in tables]
    return _new(family, name, own, rest, f"new {family.name}", short=short)


def requirement_template(
    family: Family[Any], kind: str, name: str, tables: Iterable[Table[Any]], *, short: bool = False
) -> str:
    """A commented requirement file of a family; what it asks for can be met."""
    asked = table_lines(family.requirements[kind], "requirement", first=short)
    head = [asked[0], f"kind = {toml(kind)}", *asked[1:]]
    rest = [table.first() if short else table.text() for table in tables]
    command = f"new {family.name} --requirement {kind}"
    return _new(family, name, head, rest, command, short=short, requirement=True)


def _new(
    family: Family[Any],
    name: str,
    own: list[str],
    rest: list[list[str]],
    command: str,
    *,
    short: bool,
    requirement: bool = False,
) -> str:
    text = _file(family, name, own, *rest)
    more = f"\n# These are the keys that one sets first; mechwright {command} --all writes all of them.\n"
    return f"{schema_line(family.name, requirement=requirement)}\n{text}{more if short else ''}"


def design_text(
    family: Family[Any], name: str, params: Parameters, tables: Iterable[tuple[Table[Any], Any]] = ()
) -> str:
    """The design file of given parameters, and of tables with their values."""
    tables = list(tables)
    head = [line for table, value in tables for line in table.head(value)]
    texts = (table.text(value) for table, value in tables)
    if isinstance(params, ChainParams):
        stages = [_stage_lines(stage) for stage in params.stage]
        return _file(family, name, *stages, *texts, head=head)
    return _file(family, name, table_lines(type(params), "parameters", params), *texts, head=head)


def _stage_lines(stage: StageTable) -> list[str]:
    """A table of a chain, then its parameters; what the file did not say of its place is left out."""
    own = table_lines(StageTable, "stage", stage, open_=(StageTable,))
    kept = [line for line in own[1 : own.index("")] if not line.startswith("#")]
    return [
        "[[stage]]",
        *kept,
        "",
        *table_lines(type(stage.parameters), "stage.parameters", stage.parameters),
    ]


def _file(family: Family[Any], name: str, *tables: list[str], head: Iterable[str] = ()) -> str:
    lines = [
        f"# {family.title}: {family.summary}",
        '# Lengths in mm, angles in degrees, speeds in rev/min; a text may carry another unit: "2 in".',
        f"format = {FORMAT}",
        *([] if isinstance(family, Chain) else [f"family = {toml(family.name)}"]),
        f"name = {toml(name)}",
        *head,
    ]
    for table in tables:
        lines += ["", *table] if table else []
    return "\n".join(lines) + "\n"


def table_lines(
    model: type[BaseModel],
    where: str,
    values: BaseModel | None = None,
    *,
    first: bool = False,
    open_: tuple[type[BaseModel], ...] = (),
) -> list[str]:
    """A table with the values of an instance, or with the defaults of its fields; or just the ``first``.

    Keys that an instance of ``open_`` models was not given stand as comments, so that what is written later,
    such as the name of a machine, is not barred by defaults that nobody asked for; so do fields that follow
    from others where they are left out.
    """
    lines, tables = [f"[{where}]"], []
    schema = model_schema(model)["properties"]
    stated = frozenset() if values is None else values.model_fields_set
    shown = first_fields(model) if first else tuple(model.model_fields)
    unused = values.unused_fields() if isinstance(values, Parameters) else ()
    chosen = [
        key for key in model.model_fields if (key in shown or (first and key in stated)) and key not in unused
    ]
    for key in chosen:
        field = model.model_fields[key]
        value = getattr(values, key) if values is not None else field.get_default(call_default_factory=True)
        if isinstance(value, BaseModel):
            short = first and key not in stated
            tables += ["", *table_lines(type(value), f"{where}.{key}", value, first=short, open_=open_)]
            continue
        if isinstance(value, dict) and any(isinstance(one, BaseModel) for one in value.values()):
            tables += ["", f"[{where}.{key}]  # {field.description}"]
            tables += [f"{bare_key(name)} = {_inline(one)}" for name, one in value.items()]
            continue
        text = f"{field.description or ''}{_limits(schema[key])}"
        if value is None:
            lines.append(f"# {key} = ...  # {text}")
        else:
            fitted = bool(schema[key].get("fitted"))
            left_out = (
                fitted
                if values is None
                else (fitted or isinstance(values, open_)) and key not in values.model_fields_set
            )
            lines.append(f"{'# ' if left_out else ''}{key} = {toml(value)}  # {text}")
    return lines + tables


def _inline(table: BaseModel) -> str:
    """A table of a table by name, in one line."""
    given = table.model_dump(exclude_none=True)
    return "{ " + ", ".join(f"{bare_key(key)} = {toml(value)}" for key, value in given.items()) + " }"


def bare_key(key: str) -> str:
    """A key without quotes, where TOML takes it so."""
    return key if key.isascii() and key.replace("-", "_").isidentifier() else json.dumps(key)


def _limits(schema: dict[str, Any]) -> str:
    options = [schema, *schema.get("anyOf", [])]
    facts: dict[str, Any] = {}
    for option in options:
        facts = {**option, **facts}
    said = [facts["unit"]] if facts.get("unit") else []
    said += _bounds(facts)
    if "enum" in facts:
        said.append(" | ".join(str(value) for value in facts["enum"]))
    return f" ({', '.join(said)})" if said else ""


def _bounds(facts: Mapping[str, Any]) -> list[str]:
    """The bounds of a field in words; one that is excluded is printed as such.

    >>> _bounds({"minimum": 0, "maximum": 5}), _bounds({"exclusiveMinimum": 0, "exclusiveMaximum": 180})
    (['0 to 5'], ['above 0, below 180'])
    """
    low, over = facts.get("minimum"), facts.get("exclusiveMinimum")
    high, under = facts.get("maximum"), facts.get("exclusiveMaximum")
    if low is not None and high is not None:
        return [f"{low:g} to {high:g}"]
    words = (("at least", low), ("above", over), ("at most", high), ("below", under))
    said = ", ".join(f"{word} {value:g}" for word, value in words if value is not None)
    return [said] if said else []


def toml(value: Any) -> str:
    """A value as TOML writes it, tables inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, BaseModel):
        return toml(value.model_dump(exclude_none=True))
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, str | InputFile):
        return json.dumps(str(value), ensure_ascii=False)
    return repr(value)
