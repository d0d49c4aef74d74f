"""Design files: TOML text in, a checked design out.

A design file is data. It names a family, gives its parameters and says how the parts are made::

    format = 1
    family = "elliptic-gears"
    name = "elliptic-pair"

    [parameters]
    eccentricity = 0.4

    [cam]
    work_offset = "G54"
"""

import difflib
import hashlib
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import check_name
from mechwright.errors import DesignError, OutputError, PluginError
from mechwright.plugins.host import Host
from mechwright_cam.shop.machine import MACHINES, Machine
from mechwright_cam.shop.part_settings import split
from mechwright_cam.shop.settings import CamSettings

T = TypeVar("T", bound=BaseModel)

FORMAT = 1
"""Version of the design file's own layout."""

SIZE_LIMIT = 1_000_000
"""Bytes: a design file is some lines; anything larger was given by mistake."""

_MESSAGES = {
    "tuple_type": "should be a list in square brackets",
    "model_type": "should be a table",
    "int_parsing": "should be a whole number",
    "int_from_float": "should be a whole number",
    "int_type": "should be a whole number",
}
"""Where pydantic speaks of Python's types, by its own name of the error."""

_KEYS = ("format", "family", "name", "parameters", "cam")


@dataclass(frozen=True)
class Design:
    """A design file that has been read and found well-formed.

    Parameters
    ----------
    name
        Of the design; also a file name.
    family
        The family that it names.
    params
        The table ``[parameters]``.
    cam
        The table ``[cam]``.
    path
        The file.
    digest
        SHA-256 of its bytes.
    part_cam
        Part name to the settings of that part, for each table ``[cam.part.NAME]``.
    """

    name: str
    family: Family[Any]
    params: Parameters
    cam: CamSettings
    path: Path
    digest: str
    part_cam: Mapping[str, CamSettings] = field(default_factory=dict)

    def cam_of(self, part: str) -> CamSettings:
        """The settings that a part is made with: its own, or those of the whole job."""
        return self.part_cam.get(part, self.cam)

    @property
    def tool_library(self) -> Path | None:
        """The design's own tool library; it lies in or below the design file's folder."""
        return tool_library(self.path, self.cam)


def tool_library(path: Path, cam: CamSettings) -> Path | None:
    """The tool library that the file ``path`` names; raises DesignError if it leads out of its folder."""
    return beside(path, cam.tool_library, "cam.tool_library") if cam.tool_library else None


def machine_file(path: Path, cam: CamSettings) -> Path | None:
    """The machine file that the file ``path`` names, None if it names a machine or none."""
    model = cam.machine.model
    return beside(path, model, "cam.machine.model") if model.endswith(".toml") else None


def beside(path: Path, name: str, key: str) -> Path:
    """A file in or below the folder of the design file ``path``; raises DesignError if it leads out of it."""
    folder = path.resolve().parent
    try:
        found = (folder / name).resolve()
    except (OSError, ValueError, RuntimeError) as error:  # a loop of links, or a null byte
        raise DesignError(f"{path}: {key}: {name!r} is no file: {error}") from error
    if not found.is_relative_to(folder):
        raise DesignError(
            f"{path}: {key}: {name!r} leads out of the folder of the design file; put the file beside it"
        )
    return found


def read_cam(content: Mapping[str, Any], path: Path, where: str = "cam") -> CamSettings:
    """The table ``[cam]`` of a file, with the machine that it names; mistakes are told of ``where``.

    Raises
    ------
    OutputError
        The machine file cannot be read.
    DesignError
        A key is wrong, or the machine is not known; the known ones are listed.
    """
    table = content.get("cam", {})
    machine = table.get("machine") if isinstance(table, Mapping) else None
    if isinstance(machine, str):
        machine = {"model": machine}
    if isinstance(machine, Mapping) and isinstance(machine.get("model"), str) and machine["model"]:
        known = _machine(machine["model"], path)
        table = {**table, "machine": {**known, **machine}}
    return read_table(CamSettings, table, str(path), where)


def _machine(model: str, path: Path) -> dict[str, Any]:
    """The figures of a built-in machine, or of a machine file beside ``path``."""
    if model.endswith(".toml"):
        file = beside(path, model, "cam.machine.model")
        figures = read_toml(file)[0]
        if "model" in figures:
            raise DesignError(f"{file}: model: a machine file stands for itself; write its figures")
        read_table(Machine, figures, str(file), "machine")  # mistakes are told with the file's name
        return figures
    machines = read_toml(MACHINES)[0]
    if model not in machines:
        raise DesignError(
            f"{path}: cam.machine.model: {unknown(model, tuple(machines), 'machine')}; or name a .toml file "
            "beside the design file"
        )
    figures = machines[model]
    assert isinstance(figures, dict)  # noqa: S101 - a file of our own
    return figures


def read_text(path: Path, limit: int = SIZE_LIMIT, *, older: str | None = None) -> tuple[str, str]:
    """Text and SHA-256 of a file; raises OutputError or DesignError that names it.

    The text is UTF-8; where it is not and ``older`` names another encoding, that is taken for a text
    without null bytes.
    """
    try:
        with path.open("rb") as file:
            data = file.read(limit + 1)
    except OSError as error:
        raise OutputError(f"{path}: cannot be read: {error.strerror or error}") from error
    if len(data) > limit:
        raise DesignError(f"{path}: is larger than {limit:,} bytes; is it the right file?")
    digest = hashlib.sha256(data).hexdigest()
    try:
        return data.decode("utf-8-sig"), digest
    except UnicodeDecodeError as error:
        if older is not None and b"\0" not in data:
            return data.decode(older), digest
        raise DesignError(f"{path}: is no UTF-8 text (byte {error.start}); is it the right file?") from error


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Content and SHA-256 of a TOML file; raises DesignError that names file, line and column."""
    text, digest = read_text(path)
    try:
        return tomllib.loads(text), digest
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        reason = str(error) if isinstance(error, tomllib.TOMLDecodeError) else "nested too deep"
        raise DesignError(f"{path}: is no valid TOML: {reason}") from error


def load(path: Path, host: Host) -> Design:
    """Read a design file.

    Raises
    ------
    OutputError
        The file cannot be read.
    DesignError
        Something in it is wrong: one line for each wrong thing.
    PluginError
        Its family is not installed.
    """
    content, digest = read_toml(path)
    name, family = read_head(content, path, host, _KEYS)
    params = read_table(family.Params, content.get("parameters", {}), str(path), "parameters")
    content, parts = split(content, path)
    cam = read_cam(content, path)
    part_cam = {name: read_cam(own, path, f"cam.part.{name}") for name, own in parts.items()}
    design = Design(name, family, params, cam, path, digest, part_cam)
    _ = design.tool_library  # a path that leads out is refused before any work
    return design


def read_head(
    content: Mapping[str, Any], path: Path, host: Host, keys: tuple[str, ...]
) -> tuple[str, Family[Any]]:
    """Name and family of a file whose top level may hold ``keys``; raises as :func:`load` does."""
    for key in content:
        if key not in keys:
            raise DesignError(f"{path}: {unknown(key, keys)}")
    layout = content.get("format", FORMAT)
    if type(layout) is not int or layout != FORMAT:  # true and 1.0 equal 1
        raise DesignError(f"{path}: format: {layout!r} is not known; this program reads format {FORMAT}")
    family_name = content.get("family")
    if not isinstance(family_name, str):
        fault = "is missing" if family_name is None else f"{family_name!r} is no text"
        known = ", ".join(sorted(host.families)) or "none is installed"
        raise DesignError(f"{path}: family: {fault}; name one of: {known}")
    name = content.get("name", path.stem)
    if not isinstance(name, str):
        raise DesignError(f"{path}: name: {name!r} is no text")
    try:
        check_name(name)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from error
    try:
        return name, host.family(family_name)
    except PluginError as error:
        raise PluginError(f"{path}: family: {error}") from error


def read_table(model: type[T], table: object, source: str, where: str) -> T:
    """Validate one table; raises DesignError with a line for each wrong key."""
    if not isinstance(table, Mapping):
        raise DesignError(f"{source}: {where}: is {table!r}; write a table [{where}]")
    try:
        return model.model_validate(dict(table))
    except ValidationError as error:
        lines = [f"{source}: {line}" for line in _explain(error, model, where)]
        raise DesignError("\n".join(lines)) from None


def _explain(error: ValidationError, model: type[BaseModel], where: str) -> Iterator[str]:
    for item in error.errors(include_url=False):
        keys = [str(key) for key in item["loc"]]
        place = ".".join([where, *keys])
        if item["type"] == "extra_forbidden":
            fields = tuple(_table_at(model, keys[:-1]).model_fields)
            yield f"{'.'.join([where, *keys[:-1]])}: {unknown(keys[-1], fields)}"
        elif item["type"] == "missing":
            yield f"{place}: is missing"
        else:
            message = _MESSAGES.get(item["type"]) or item["msg"]
            for start in ("Value error, ", "Input ", "String "):
                message = message.removeprefix(start)
            value = item.get("input")
            if isinstance(value, (str, int, float)) and item["type"] != "unit" and keys:
                message = f"{value!r} {message}"
            yield f"{place}: {message}"


def _table_at(model: type[BaseModel], keys: list[str]) -> type[BaseModel]:
    for key in keys:
        field = model.model_fields.get(key)
        if field is None:
            continue  # the key of a table of tables
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                model = kind
    return model


def unknown(key: str, known: tuple[str, ...], what: str = "key") -> str:
    """Say that a key is not known, and what was probably meant."""
    close = difflib.get_close_matches(key, known, 1)
    hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(known)}"
    return f"unknown {what} {key!r}; {hint}"
