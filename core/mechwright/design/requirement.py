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

``kind`` may be left out where the family knows one only. ``[cam]`` goes into the designs as it is.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.design.design import read_cam, read_head, read_table, read_toml, tool_library, unknown
from mechwright.errors import DesignError
from mechwright.plugins.host import Host
from mechwright_cam.shop.settings import CamSettings

_KEYS = ("format", "family", "name", "requirement", "cam")


@dataclass(frozen=True)
class Requirement:
    """A requirement file that has been read and found well-formed.

    Parameters
    ----------
    name
        Stem of the names of the designs.
    family
        The family that it names.
    kind
        A key of ``family.requirements``.
    table
        The table ``[requirement]``, of the kind's model.
    cam
        The table ``[cam]`` of the designs.
    path
        The file.
    digest
        SHA-256 of its bytes.
    """

    name: str
    family: Family[Any]
    kind: str
    table: Parameters
    cam: CamSettings
    path: Path
    digest: str

    @property
    def tool_library(self) -> Path | None:
        """The tool library of the designs; it lies in or below the file's folder."""
        return tool_library(self.path, self.cam)


def load_requirement(path: Path, host: Host) -> Requirement:
    """Read a requirement file.

    Raises
    ------
    OutputError
        The file cannot be read.
    DesignError
        Something in it is wrong, one line for each wrong thing; or its family has no synthesis.
    PluginError
        Its family is not installed.
    """
    content, digest = read_toml(path)
    name, family = read_head(content, path, host, _KEYS)
    require_synthesis(family, str(path))
    table = content.get("requirement", {})
    kinds = tuple(family.requirements)
    rest = table
    kind: object = kinds[0] if len(kinds) == 1 else None
    if isinstance(table, dict):
        rest = {key: value for key, value in table.items() if key != "kind"}
        kind = table.get("kind", kind)
    if kind is None:
        raise DesignError(f"{path}: requirement.kind: is missing; one of: {', '.join(kinds)}")
    if not isinstance(kind, str) or kind not in kinds:
        raise DesignError(f"{path}: requirement.kind: {unknown(str(kind), kinds, 'kind')}")
    requirement = Requirement(
        name,
        family,
        kind,
        read_table(family.requirements[kind], rest, str(path), "requirement"),
        read_cam(content, path),
        path,
        digest,
    )
    _ = requirement.tool_library  # a path that leads out is refused before any work
    return requirement


def require_synthesis(family: Family[Any], where: str) -> None:
    """Raise DesignError that begins with ``where`` if the family has no synthesis."""
    if not family.requirements:
        raise DesignError(
            f"{where}: family {family.name} has no synthesis; "
            f"write a design with mechwright new {family.name}"
        )
