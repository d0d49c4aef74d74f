"""Reading a shop file, and what it lends to the tables of a design file."""

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechwright.contracts.own_materials import OwnMaterial, add_materials
from mechwright.designs.files import beside, read_toml
from mechwright.designs.inches import converted, told_in, units_of
from mechwright.designs.tables import read_table
from mechwright.errors import DesignError, OutputError
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.settings import MachineSettings
from mechwright_cam.shop.holding import SecondSide
from mechwright_cam.shop.library import Library, library_files, load_library, tools_of
from mechwright_cam.shop.machine import machine_figures
from mechwright_cam.shop.part_settings import over
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_cam.shop.workshop import LAYOUT, Workshop

VARIABLE = "MECHWRIGHT_SHOP"
"""Names the shop file of designs that name none."""
ELSEWHERE = {
    "tool_library": "write crib, or [[tool]] tables, into the shop file",
    "machine": "it is the key machine of the shop file",
    "control": "it is the key control of the shop file",
    "part": "tables of parts belong to a design",
    "nest": "nests belong to a design",
}
"""Keys of ``[cam]`` that ``[prefer.cam]`` does not take, and where they belong."""


@dataclass(frozen=True)
class Shop:
    """A shop file that has been read."""

    path: Path
    said: str
    """How the design file names it; empty where the environment does."""
    workshop: Workshop
    library: Library
    files: Mapping[str, Path]
    """Further files that it names, by the names it gives them."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        """In another process its materials are known as well."""
        self.__dict__.update(state)
        add_materials(self.workshop.material)

    @property
    def lends(self) -> dict[str, dict[str, Any]]:
        """Keys of ``[cam]`` and ``[machine]`` for a design that does not say them."""
        shop = self.workshop
        cam: dict[str, Any] = {"post": {"units": shop.units}}
        if shop.control:
            cam["control"] = shop.control
        if shop.machine is not None:
            cam["machine"] = shop.machine.model_dump(exclude_unset=True, exclude={"model"})
        usual: float = SecondSide.model_fields["dowel_diameter"].default
        pins = [pin for pin in shop.pins if 2 <= pin <= 20]
        if pins:
            cam["second_side"] = {"dowel_diameter": min(pins, key=lambda pin: (abs(pin - usual), pin))}
        frame = dict(shop.prefer.machine)
        if plates := self.thicknesses(frame.get("plate_material", FrameKeys().plate_material)):
            frame = {"plates": plates, **frame}
        cut = {"cut": shop.prefer.cut} if shop.prefer.cut else {}
        return {"cam": over(cam, shop.prefer.cam), "machine": frame, **cut}

    def thicknesses(self, material: str) -> list[float]:
        """Thicknesses of the plates of a material that are in hand, mm, from the thinnest on."""
        found = {one for row in self.workshop.stock if row.material == material for one in row.in_hand}
        return sorted(found)


def named_by(environment: Mapping[str, str] = os.environ) -> Path | None:
    """The shop file that the environment names; None if it names none."""
    said = environment.get(VARIABLE, "")
    return Path(said).expanduser() if said else None


def read_shop(path: Path, said: str = "") -> Shop:
    """Read a shop file.

    Raises OutputError where it, or a file it names, cannot be read; DesignError with a line for each thing in
    it that is wrong.
    """
    content = read_toml(path)[0]
    layout = content.get("format", LAYOUT)
    if type(layout) is not int or layout != LAYOUT:
        raise DesignError(f"{path}: format: {layout!r} is not known; this program reads format {LAYOUT}")
    if "tools" in content:
        raise DesignError(f"{path}: unknown key 'tools'; a shop file holds [[tool]] tables")
    units, files = units_of(content, path), dict[str, Path]()
    if units == "inch":
        content = converted(content, schema())
    with told_in(units):
        machine = content.get("machine")
        own = machine if isinstance(machine, Mapping) else {}
        model = machine if isinstance(machine, str) else own.get("model")
        if isinstance(model, str) and model:
            with _named(path, "machine"):
                content = {**content, "machine": {**machine_figures(model, path), **own}}
            if model.endswith(".toml"):
                files[model] = beside(path, model, "machine")
        _add_materials(content, path)
        tools = tuple(_tools(content, path))
        workshop = read_table(Workshop, {**content, "tool": ()}, str(path), "shop")
        _check_preferred(workshop, path)
        base = Library(())
        if workshop.crib:
            crib = beside(path, workshop.crib, "crib")
            with _named(path, "crib"):
                base = load_library(crib)
                first, *more = library_files(crib)
            files |= {workshop.crib: first, **{file.name: file for file in more}}
        elif not tools:
            raise DesignError(f"{path}: holds no tool; add a [[tool]] table, or name a library: crib = FILE")
        try:
            library = base.extended(tools)
        except DesignError as error:
            raise DesignError(f"{path}: {error}") from error
    return Shop(path, said, workshop, library, files)


def _add_materials(content: Mapping[str, Any], path: Path) -> None:
    """Let tools, stock and designs name the shop's own materials."""
    tables = content.get("material", {})
    if not isinstance(tables, Mapping):
        raise DesignError(f"{path}: material: is {tables!r}; write tables [material.NAME]")
    add_materials({})
    read = {
        name: read_table(OwnMaterial, table, str(path), f"material.{name}") for name, table in tables.items()
    }
    try:
        add_materials(read)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from error


@contextmanager
def _named(path: Path, key: str) -> Iterator[None]:
    """A file that cannot be read is told with the key of the shop file that names it."""
    try:
        yield
    except OutputError as error:
        raise OutputError(f"{path}: {key}: {error}") from error


def schema() -> dict[str, Any]:
    """The JSON schema of a shop file."""
    found = Workshop.model_json_schema()
    properties = found["properties"]
    properties["machine"] = {"anyOf": [properties["machine"], {"type": "string"}]}
    # What is preferred are tables of design files, with keys and units of theirs.
    for name, model in (("cam", CamSettings), ("machine", MachineSettings)):
        inner = model.model_json_schema(ref_template=f"#/$defs/{name}.{{model}}")
        defs = inner.pop("$defs", {})
        found["$defs"] |= {f"{name}.{key}": value for key, value in defs.items()}
        found["$defs"]["Prefer"]["properties"][name] = inner
    return found


def _tools(content: Mapping[str, Any], path: Path) -> list[Tool]:
    """The ``[[tool]]`` tables, each with the diameter of its holder."""
    holders, rows = content.get("holder", {}), content.get("tool", [])
    if not isinstance(rows, list):
        raise DesignError(f"{path}: tool: is {rows!r}; write [[tool]] tables")
    made = []
    for row in rows:
        name = row.get("holder") if isinstance(row, Mapping) else None
        if name is not None and isinstance(holders, Mapping):
            held = holders.get(name)
            if not isinstance(held, Mapping):
                known = ", ".join(holders) or "none is there"
                raise DesignError(
                    f"{path}: tool {row.get('name')!r}: no holder {name!r}; add a table [holder.{name}] "
                    f"(known: {known})"
                )
            if "diameter" in held:
                row = {"holder_diameter": held["diameter"], **row}
        made.append(row)
    return list(tools_of(made, path).values()) if made else []


def _check_preferred(workshop: Workshop, path: Path) -> None:
    """Raise DesignError where what is preferred is no key of its table."""
    for key, remedy in ELSEWHERE.items():
        if key in workshop.prefer.cam:
            raise DesignError(f"{path}: prefer.cam.{key}: has no place there; {remedy}")
    read_table(CamSettings, workshop.prefer.cam, str(path), "prefer.cam")
    read_table(MachineSettings, workshop.prefer.machine, str(path), "prefer.machine")
