"""What others write into their files and programs: ``python tests/promised_names.py`` lists it anew.

Commands and their options, keys of design files, and codes of rules, as docs/deprecation.md promises them.
"""

import json
import sys
from pathlib import Path
from typing import Any

import typer
from rule_page import leaves

from mechwright import Family
from mechwright.cli.app import make_app
from mechwright.designs.schema import file_schema
from mechwright.plugins.host import host

LIST = Path(__file__).parent / "data" / "promised_names.json"


def names() -> dict[str, list[str]]:
    """Kind to the names that are promised."""
    found = host()
    group = typer.main.get_command(make_app())
    commands = getattr(group, "commands")  # noqa: B009 - typer has the type of a single command
    options = {
        f"{name} {option}"
        for name, command in commands.items()
        for parameter in command.params
        for option in parameter.opts
        if option.startswith("--")
    }
    families = [family.name for family in found.all(Family)]
    keys = {f"{family}: {key}" for family in families for key in _keys(file_schema(found, family))}
    shared = set.intersection(
        *({key.partition(": ")[2] for key in keys if key.startswith(f"{one}: ")} for one in families)
    )
    own = {key for key in keys if key.partition(": ")[2] not in shared}
    codes = {code for family in found.all(Family) for rule in leaves(family.rules()) for code in rule.codes}
    return {
        "codes": sorted(codes),
        "commands": sorted({*commands, *options}),
        "families": sorted(families),
        "keys": sorted(shared | own),
    }


def _keys(schema: dict[str, Any]) -> set[str]:
    """Keys of the tables of a file, with dots, without those of lists and free tables."""
    found: set[str] = set()

    def look(node: Any, path: str, seen: tuple[str, ...]) -> None:
        reference = node.get("$ref", "").removeprefix("#/$defs/")
        if reference:
            if reference not in seen:
                look(schema["$defs"][reference], path, (*seen, reference))
            return
        for key, value in node.get("properties", {}).items():
            found.add(f"{path}{key}")
            look(value, f"{path}{key}.", seen)
        for one in (*node.get("anyOf", ()), *node.get("allOf", ())):
            look(one, path, seen)

    look(schema, "", ())
    return found


if __name__ == "__main__":
    LIST.write_text(json.dumps(names(), indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(f"{LIST}: written\n")
