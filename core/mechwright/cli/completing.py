"""What shells complete: names that are installed, and files. Whatever takes long to import waits."""

import os
from collections.abc import Callable, Container, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.fields import FieldInfo

DEEP = 3
"""Folders into which completion looks for design files: what lies deeper is typed."""
MOST = 200
"""Files that are offered."""
LINE = ("COMP_WORDS", "_TYPER_COMPLETE_ARGS")
"""Environment variables that hold the line: of bash, and of zsh and fish."""
KINDS_OF_CURVES = ("spline", "spline3", "arc", "polyline")


def families(incomplete: str) -> list[tuple[str, str]]:
    """Families with their titles."""
    from mechwright.contracts.family import Family
    from mechwright.plugins.host import host

    return [(one.name, one.title) for one in host().all(Family) if one.name.startswith(incomplete)]


def requirement_kinds(incomplete: str) -> list[str]:
    """What the family on the line can be asked for."""
    from mechwright.contracts.family import Family
    from mechwright.plugins.host import host

    # Of a line that ends with an option typer hands over no arguments; the shell's own words have them.
    words = " ".join(os.environ.get(name, "") for name in LINE).split()
    return _begun(
        (kind for one in host().all(Family) if one.name in words for kind in one.requirements), incomplete
    )


def installed(kind: str, incomplete: str) -> list[str]:
    """Names of what is installed of a kind, as ``mechwright families`` calls it: ``"control"``."""
    from mechwright.plugins.host import host

    names = (name for contract, items in host().registered.items() if contract.kind == kind for name in items)
    return _begun(names, incomplete)


def controls(incomplete: str) -> list[str]:
    """Controls of machines."""
    return installed("control", incomplete)


def formats(incomplete: str) -> list[str]:
    """File formats, in a list with commas."""
    before, comma, last = incomplete.rpartition(",")
    given = before.split(",")
    return [f"{before}{comma}{name}" for name in installed("exporter", last) if name not in given]


def curves(incomplete: str) -> list[str]:
    """Kinds of curves in drawings."""
    return _begun(KINDS_OF_CURVES, incomplete)


def stages(incomplete: str) -> list[str]:
    """How far a design has to build."""
    from mechwright.contracts.finding import Stage

    return _begun(tuple(Stage), incomplete)


def design_files(incomplete: str) -> list[str]:
    """TOML files, here and in the folders that the line has begun."""
    return _files(incomplete, lambda path: _holds(path, requirement=False))


def requirement_files(incomplete: str) -> list[str]:
    """TOML files that hold a requirement."""
    return _files(incomplete, lambda path: _holds(path, requirement=True))


def any_files(incomplete: str) -> list[str]:
    """Design files and requirement files."""
    return sorted(design_files(incomplete) + requirement_files(incomplete))


def files_ending(incomplete: str, suffixes: Container[str]) -> list[str]:
    """Files whose names end so, with the dot."""
    return _files(incomplete, lambda path: path.suffix.lower() in suffixes and path.is_file())


def keys(model: "type[BaseModel]", incomplete: str, without: Container[str] = ()) -> list[tuple[str, str]]:
    """Keys of a table and tables in it, ``hold.tabs=``, with what they are; after ``=`` what it may be."""
    key, said, _ = incomplete.partition("=")
    found: list[tuple[str, str]] = []
    for path, field, facts in _fields(model, ""):
        if path.partition(".")[0] in without:
            continue
        if said and path == key:
            chosen = facts.get("enum", ["true", "false"] if facts.get("type") == "boolean" else [])
            found += [(f"{key}={one}", "") for one in chosen]
        elif not said:
            found.append((f"{path}=", (field.description or "").replace("``", "")))
    return sorted(one for one in found if one[0].startswith(incomplete))


def _fields(model: "type[BaseModel]", before: str) -> "Iterator[tuple[str, FieldInfo, dict[str, Any]]]":
    from pydantic import BaseModel

    from mechwright.contracts.model_schema import model_schema

    schema = model_schema(model)["properties"]
    for name, field in model.model_fields.items():
        kind = field.annotation
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            yield from _fields(kind, f"{before}{name}.")
        else:
            yield f"{before}{name}", field, schema[name]


def part_names(ctx: typer.Context, incomplete: str) -> list[str]:
    """The parts of the design on the line."""
    design = ctx.params.get("design")
    if not design:
        return []
    from mechwright.errors import MechwrightError
    from mechwright.scripting.opening import load

    try:
        return _begun(load(design).parts.names, incomplete)
    except MechwrightError:
        return []


def _begun(names: Iterable[str], incomplete: str) -> list[str]:
    return sorted(name for name in names if name.startswith(incomplete))


def _files(incomplete: str, fits: Callable[[Path], bool]) -> list[str]:
    """Paths that begin so, as they are typed; a folder that is named whole or in part is looked into."""
    folder, _, begun = incomplete.rpartition("/")
    root = Path(f"{folder}/" if folder or incomplete.startswith("/") else ".")
    waiting, found = [(root, 0)], list[str]()
    while waiting and len(found) < MOST:
        place, depth = waiting.pop(0)
        try:
            entries = sorted(place.iterdir())
        except OSError:
            continue
        for entry in entries:
            if entry.name.startswith(".") or (depth == 0 and not entry.name.startswith(begun)):
                continue
            if fits(entry):
                found.append(str(entry))
            elif depth < DEEP and (begun or depth or folder) and entry.is_dir():
                waiting.append((entry, depth + 1))
    return found[:MOST]


def _holds(path: Path, *, requirement: bool) -> bool:
    """Whether a file looks like one of ours, of the kind that is wanted."""
    if path.suffix != ".toml":
        return False
    from mechwright.designs.files import read_text
    from mechwright.errors import MechwrightError

    try:
        text = read_text(path)[0]
    except MechwrightError:
        return False
    lines = [line.strip() for line in text.splitlines()]
    asked = any(line.startswith("[requirement") for line in lines)
    return any(line.startswith("family") for line in lines) and asked == requirement
