"""The tables ``[cam.part.NAME]`` of a design file: settings of one part, over those of ``[cam]``."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.errors import DesignError

WHOLE_JOB = ("control", "tool_library", "post", "nest")
"""Keys of ``[cam]`` that hold for the whole job: one control reads its programs, from one set of tools."""

ASKED = frozenset({"deburr", "mark", "mark_height", "mark_depth", "mark_line", "fitting_marks", "holes"})
"""Keys that change the part itself, and say nothing of how it is cut."""

_EXCLUSIVE = ({"margin"}, {"length", "width"})
"""Keys of ``[cam.stock]`` of which a part's table puts out those of the other group."""


def split(table: Mapping[str, Any], path: Path) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """Part the table ``[cam]`` of a file from its tables ``[cam.part.NAME]``.

    Gives the table without those, and part name to its table laid over ``[cam]``. Raises DesignError where
    ``cam.part`` or a table of it is none, or a key of it holds for the whole job.
    """
    tables = table.get("part", {})
    if not isinstance(tables, Mapping):
        raise DesignError(f"{path}: cam.part: is {tables!r}; write a table [cam.part.NAME]")
    if "holes" in table:
        raise DesignError(f"{path}: cam.holes: holes are those of one part; write [cam.part.NAME.holes.HOLE]")
    base = {key: value for key, value in table.items() if key != "part"}
    parts = {}
    for name, own in tables.items():
        if not isinstance(own, Mapping):
            raise DesignError(f"{path}: cam.part.{name}: is {own!r}; write a table [cam.part.{name}]")
        for key in WHOLE_JOB:
            if key in own:
                raise DesignError(f"{path}: cam.part.{name}.{key}: holds for the whole job; set it in [cam]")
        parts[name] = over(base, own)
    return base, parts


def says_how(table: Mapping[str, Any]) -> bool:
    """Whether a table of a part, as it stands in the file, says anything of how the part is cut."""
    return not table or not ASKED.issuperset(table)


def over(base: Mapping[str, Any], table: Mapping[str, Any], where: str = "") -> dict[str, Any]:
    """One table laid over another, key by key."""
    merged = dict(base)
    if where == "stock":
        for mine, other in (_EXCLUSIVE, _EXCLUSIVE[::-1]):
            if mine & table.keys() and not other & table.keys():
                merged = {key: value for key, value in merged.items() if key not in other}
    for key, value in table.items():
        old = merged.get(key)
        if isinstance(old, Mapping) and isinstance(value, Mapping):
            value = over(old, value, key)
        merged[key] = value
    return merged
