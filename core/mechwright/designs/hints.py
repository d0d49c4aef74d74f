"""What was probably meant by a mistake in a file that people write, and on which line it stands."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.table import Table
from mechwright.designs.schema import HEAD
from mechwright.plugins.host import Host

_LIST = "known: "
"""How it is said that no key is like an unknown one."""

_TABLE = re.compile(r"\s*\[\s*([^\[\]]+?)\s*\]\s*(?:#.*)?$")
_KEY = re.compile(r"""\s*(["']?)([\w.-]+)\1\s*=""")
_STAGE = re.compile(r"stage\.\d+")
_DECIMAL = re.compile(r"^(.*?: )([\w.-]+)(: .* write a point for the decimal comma: .*)$")
_UNKNOWN = re.compile(r"^(.*?: )(?:([\w.-]+): )?unknown key '([^']+)'; (.*)$")


def placed(message: str, text: str, known: Mapping[str, list[str]]) -> str:
    """The message of a file's mistakes, each unknown key with its line, and the table that it belongs to.

    Parameters
    ----------
    message
        Lines, each of one mistake.
    text
        The file.
    known
        Key to the tables that have it.
    """
    said = []
    for line in message.splitlines():
        found = _UNKNOWN.match(line)
        if found is None:
            said.append(_comma(line, text))
            continue
        source, where, key, rest = found[1], found[2] or "", found[3], found[4]
        number = line_of(text, where, key)
        at = f"line {number}: " if number else ""
        # A stage has the keys of a stage alone: what else a key of that name may mean is far from it.
        tables = () if _STAGE.fullmatch(where) else known.get(key, ())
        belongs = [table for table in tables if table != where]
        if belongs and (rest.startswith(_LIST) or not all("." in table for table in belongs)):
            rest = f"it stands in {_named(where)} and belongs to {' or '.join(map(_named, belongs))}"
        said.append(f"{source}{at}{f'{where}: ' if where else ''}unknown key '{key}'; {rest}")
    return "\n".join(said)


def _named(table: str) -> str:
    return f"[{table}]" if table else "the head of the file"


def _comma(line: str, text: str) -> str:
    """The line of a decimal comma in a text."""
    found = _DECIMAL.match(line)
    number = line_of(text, *found[2].rpartition(".")[::2]) if found else 0
    return f"{found[1]}line {number}: {found[2]}{found[3]}" if found and number else line


def line_of(text: str, table: str, key: str) -> int:
    r"""The line on which a key of a table stands; 0 where it is not found, as in a table on one line.

    >>> line_of("a = 1\n[cam]\nb = 2\n", "cam", "b")
    3
    """
    here = ""
    for number, line in enumerate(text.splitlines(), start=1):
        if header := _TABLE.match(line):
            here = re.sub(r"""["'\s]""", "", header[1])
            if here == f"{table}.{key}".lstrip("."):
                return number
        elif found := _KEY.match(line):
            whole = f"{here}.{found[2]}".lstrip(".")
            if whole == f"{table}.{key}".lstrip("."):
                return number
    return 0


def homes(host: Host, content: Mapping[str, Any], own: str) -> dict[str, list[str]]:
    """Key to the tables of a file that have it, as far as its family is known.

    ``own`` is ``parameters`` or ``requirement``.
    """
    found: dict[str, list[str]] = {key: [""] for key in HEAD}
    for name, schema in schemas_of(host, content, own).items():
        for table, key in _keys(schema, schema.get("$defs", {}), name):
            found.setdefault(key, []).append(table)
    if own == "requirement":
        found.setdefault("kind", []).append(own)
    return found


def schemas_of(host: Host, content: Mapping[str, Any], own: str) -> dict[str, dict[str, Any]]:
    """Name of each table of a file to its schema; ``own`` only as far as its family is known."""
    schemas = {table.name: table.schema() for table in host.all(Table)}
    family = host.of(Family).get(str(content.get("family")))
    if family is not None:
        asked = content.get(own, {})
        kind = asked.get("kind", content.get("kind")) if isinstance(asked, Mapping) else None
        model = family.item.Params if own == "parameters" else family.item.requirements.get(str(kind))
        if model is not None:
            schemas = {own: model_schema(model), **schemas}
    return schemas


def _keys(schema: Mapping[str, Any], defs: Mapping[str, Any], where: str) -> Iterator[tuple[str, str]]:
    """Tables and their keys."""
    for key, field in schema.get("properties", {}).items():
        yield where, key
        for option in (field, *field.get("anyOf", ()), *field.get("allOf", ())):
            name = str(option.get("$ref", "")).removeprefix("#/$defs/")
            if name in defs:
                yield from _keys(defs[name], defs, f"{where}.{key}")
