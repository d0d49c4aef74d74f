"""Requirement files: what a synthesis is asked for.

They are laid out as design files are, with the table ``[requirement]`` in the place of ``[parameters]``::

    format = 1
    family = "slider-crank"
    name = "quick-return"

    [requirement]
    kind = "stroke"
    stroke = 120

    [cam]
    work_offset = "G54"

A chain's requirement has its stages as a design has them, which say where the search begins.

``kind`` may be left out where the family knows one only. Other tables, such as ``[cam]``, go into the
designs.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.chains import STAGE, chain_of, chain_params, stage_schema
from mechwright.designs.design import read_head, read_name, read_tables, telling_places
from mechwright.designs.files import read_toml
from mechwright.designs.inches import in_millimetres, told_in
from mechwright.designs.schema import HEAD
from mechwright.designs.tables import read_table, unknown
from mechwright.designs.text import design_text
from mechwright.errors import DesignError
from mechwright.mechanics.chain import Chain
from mechwright.plugins.host import Host
from mechwright.reading import once
from mechwright.shell import file_word


@dataclass(frozen=True)
class Requirement:
    """A requirement file that has been read and found well-formed.

    Parameters
    ----------
    name
        Stem of the names of the designs.
    kind
        A key of ``family.requirements``.
    table
        The table ``[requirement]``, of the kind's model.
    tables
        Each registered table with its value for the designs.
    given
        Name to value of the same tables as the requirement file has them.
    files
        Name to the file that goes along with the designs.
    inputs
        The files that the tables name, by the names they give them.
    digest
        SHA-256 of the bytes of the file ``path``.
    """

    name: str
    family: Family[Any]
    kind: str
    table: Parameters
    tables: tuple[tuple[Table[Any], Any], ...]
    given: Mapping[str, Any]
    files: Mapping[str, Path]
    inputs: Mapping[str, Path]
    path: Path
    digest: str

    def text(self, name: str, params: Parameters) -> str:
        """The file of a design that meets it; other files that go along lie beside it."""
        return design_text(self.family, name, params, self.tables)

    def text_here(self, name: str, params: Parameters) -> str:
        """The same design as a file beside the requirement, whose other files lie where they are."""
        here = [(reader, self.given[reader.name]) for reader, _ in self.tables]
        return design_text(self.family, name, params, here)


@once()
def load_requirement(path: Path, host: Host) -> Requirement:
    """Read a requirement file; raises as ``load`` does, and DesignError for a family without synthesis."""
    content, digest = read_toml(path)
    with telling_places(path, content, host, "requirement"):
        return requirement_of(content, path, digest, host)


def requirement_of(content: Mapping[str, Any], path: Path, digest: str, host: Host) -> Requirement:
    """The requirement that a file ``path`` with this content holds; raises as ``load_requirement`` does."""
    registered = host.of(Table)
    if "parameters" in content and "requirement" not in content:
        raise DesignError(
            f"{path}: parameters: this file is a design, and asks for none; build it by mechwright build "
            f"{file_word(path.name)} -o FOLDER, or write what is asked in a table [requirement]"
        )
    keys = (*HEAD, "requirement", STAGE, *registered)
    family: Family[Any]
    if STAGE in content:
        name, family = read_name(content, path, keys), chain_of(content, path, host)
    else:
        name, family = read_head(content, path, host, keys)
    require_synthesis(family, str(path))
    table = content.get("requirement", {})
    kinds = tuple(family.requirements)
    kind: object = kinds[0] if len(kinds) == 1 else None
    if isinstance(table, dict):
        kind = table.get("kind", kind)
    if kind is None:
        raise DesignError(f"{path}: requirement.kind: is missing; one of: {', '.join(kinds)}")
    if not isinstance(kind, str) or kind not in kinds:
        raise DesignError(f"{path}: requirement.kind: {unknown(str(kind), kinds, 'kind')}")
    model = family.requirements[kind]
    schema = {"requirement": model_schema(model)}
    if isinstance(family, Chain):
        schema[STAGE] = stage_schema(family.families)
    units, content = in_millimetres(content, path, schema, host.all(Table))
    rest = content.get("requirement", {})
    if isinstance(rest, dict):
        rest = {key: value for key, value in rest.items() if key != "kind"}
    with told_in(units):
        given = read_tables(content, path, host)
        asked = read_table(model, rest, str(path), "requirement")
        if isinstance(family, Chain):
            family = Chain(family.families, chain_params(family.families, content, path))
    tables: list[tuple[Table[Any], Any]] = []
    files: dict[str, Path] = {}
    inputs: dict[str, Path] = {}
    for key, value in given.items():
        reader = registered[key].item
        inputs |= reader.inputs(value, path)
        carried, along = reader.carried(value, path)
        tables.append((reader, carried))
        files |= along
    return Requirement(
        name,
        family,
        kind,
        asked,
        tuple(tables),
        given,
        files,
        inputs,
        path,
        digest,
    )


def require_synthesis(family: Family[Any], where: str) -> None:
    """Raise DesignError that begins with ``where`` if the family has no synthesis."""
    if not family.requirements:
        raise DesignError(
            f"{where}: family {family.name} has no synthesis; "
            f"write a design with mechwright new {family.name}"
        )
