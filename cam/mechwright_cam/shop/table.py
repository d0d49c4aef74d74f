"""The table ``[cam]`` of a design file, with the tables ``[cam.part.NAME]`` of single parts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.part import Part
from mechwright.contracts.table import Table
from mechwright.designs.design import Design
from mechwright.designs.files import beside
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright.errors import DesignError
from mechwright_cam.shop.library import library_files
from mechwright_cam.shop.machine import Machine, machine_figures
from mechwright_cam.shop.part_settings import over, says_how, split
from mechwright_cam.shop.settings import CamSettings, PartSettings

_OF_ONE_PART = (
    "",
    "# Any of these for one part only, by the part's name:",
    "# [cam.part.NAME]",
    '# origin = "corner"',
    '# holes.bore-1.thread = "M6"  # or fit = "H7", or screw = "ISO 4762 M5"',
)
S = TypeVar("S", bound=CamSettings)


@dataclass(frozen=True)
class JobSettings:
    """What a design file says of machining."""

    cam: CamSettings = field(default_factory=CamSettings)
    """The table ``[cam]``."""
    parts: Mapping[str, PartSettings] = field(default_factory=dict)
    """Part name to the settings of that part, for each table ``[cam.part.NAME]`` that says how it is cut."""
    tool_library: Path | None = None
    """The design's own tool library; it lies in or below the folder of the file."""
    tables: Mapping[str, PartSettings] = field(default_factory=dict)
    """The same for every such table: edges, marks and holes alone are no reason to cut a part by itself."""

    def of(self, part: str) -> CamSettings:
        """The settings that a part is made with: its own, or those of the whole job."""
        return self.tables.get(part, self.cam)


def settings_of(design: Design) -> JobSettings:
    """What a design says of machining."""
    return design.table(CamTable)


class CamTable(Table[JobSettings]):
    """Reads and writes ``[cam]``."""

    name = "cam"
    settings = CamSettings

    def read(self, content: object, path: Path) -> JobSettings:
        """The settings, with the machine that they name."""
        if not isinstance(content, Mapping):
            return JobSettings(_settings(CamSettings, content, path))
        base, parts = split(content, path)
        cam = _settings(CamSettings, base, path)
        library = beside(path, cam.tool_library, "cam.tool_library") if cam.tool_library else None
        own = {
            name: _settings(PartSettings, table, path, f"cam.part.{name}") for name, table in parts.items()
        }
        cut = {name: table for name, table in own.items() if says_how(content["part"][name])}
        return JobSettings(cam, cut, library, own)

    def text(self, value: JobSettings | None = None) -> list[str]:
        """The table ``[cam]``; the tables of single parts are for each design by itself."""
        if value is None:  # a machine that is named brings its own figures
            return [*table_lines(CamSettings, self.name, open_=(Machine,)), *_OF_ONE_PART]
        return [*table_lines(CamSettings, self.name, value.cam, open_=(BaseModel,)), *_OF_ONE_PART]

    def first(self) -> list[str]:
        """Control, work offset, cutters and machine."""
        return table_lines(CamSettings, "cam", first=True)

    def schema(self) -> dict[str, Any]:
        """The table with those of single parts; a machine may also be given by its name alone."""
        whole, part = model_schema(CamSettings), model_schema(PartSettings)
        known = whole["properties"]["machine"]
        for table in (whole, part):
            table["properties"]["machine"] = {"anyOf": [known, {"type": "string"}]}
        defs = {**part.pop("$defs", {}), **whole.pop("$defs", {}), "part": part}
        whole["properties"]["part"] = {
            "type": "object",
            "additionalProperties": {"$ref": "#/$defs/part"},
            "description": "Tables of single parts, by name.",
        }
        return {**whole, "$defs": defs}

    def parts(self, value: JobSettings, parts: Sequence[Part], path: Path) -> Sequence[Part]:
        """The parts with holes, broken edges, marks: see :mod:`mechwright_cam.shop.requested_features`."""
        from mechwright_cam.shop.requested_features import with_requested_features

        return with_requested_features(value.cam, value.tables, parts, path)

    def laid_over(self, own: object, lent: Mapping[str, Any]) -> object:
        """As tables of single parts lie over it."""
        return over(lent, own) if isinstance(own, Mapping) else own

    def inputs(self, value: JobSettings, path: Path) -> dict[str, Path]:
        """The tool library, and machine files."""
        named = {}
        if value.tool_library is not None:
            first, *more = library_files(value.tool_library)
            named = {value.cam.tool_library: first, **{file.name: file for file in more}}
        for cam in (value.cam, *value.parts.values()):
            if cam.machine.model.endswith(".toml"):
                named[cam.machine.model] = beside(path, cam.machine.model, "cam.machine.model")
        return named

    def carried(self, value: JobSettings, path: Path) -> tuple[JobSettings, dict[str, Path]]:
        """The same settings; the tool library and the machine file go along."""
        if value.tables:
            raise DesignError(
                f"{path}: cam.part: the designs that are found share one [cam]; write "
                f"cam.part.{min(value.tables)} into the one that you take"
            )
        changes: dict[str, object] = {}
        files: dict[str, Path] = {}
        if value.tool_library is not None:
            changes["tool_library"] = value.tool_library.name
            files |= {file.name: file for file in library_files(value.tool_library)}
        if value.cam.machine.model.endswith(".toml"):
            file = beside(path, value.cam.machine.model, "cam.machine.model")
            changes["machine"] = value.cam.machine.model_copy(update={"model": file.name})
            files[file.name] = file
        return JobSettings(value.cam.model_copy(update=changes), {}, value.tool_library), files


def _settings(model: type[S], table: object, path: Path, where: str = "cam") -> S:
    """One table of settings, with the machine that it names; mistakes are told of ``where``."""
    machine = table.get("machine") if isinstance(table, Mapping) else None
    if isinstance(machine, str):
        machine = {"model": machine}
    if isinstance(table, Mapping) and isinstance(machine, Mapping):
        known = machine.get("model")
        if isinstance(known, str) and known:
            table = {**table, "machine": {**machine_figures(known, path), **machine}}
    return read_table(model, table, str(path), where)
