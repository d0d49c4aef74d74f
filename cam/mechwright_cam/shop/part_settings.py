"""The tables ``[cam.part.NAME]`` of a design file: settings of one part, over those of ``[cam]``."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.errors import DesignError

WHOLE_JOB = ("control", "tool_library", "post", "nest")
"""Keys of ``[cam]`` that hold for the whole job: one control reads its programs, from one set of tools."""

_EXCLUSIVE = ({"margin"}, {"length", "width"})
"""Keys of ``[cam.stock]`` of which a part's table puts out those of the other group."""


def split(content: Mapping[str, Any], path: Path) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """Part the content of a file from its tables ``[cam.part.NAME]``.

    Returns
    -------
    content
        Without those tables.
    parts
        Part name to the content that holds for that part: the same, with its table laid over ``[cam]``.

    Raises
    ------
    DesignError
        ``cam.part`` or a table of it is none, or a key of it holds for the whole job.
    """
    cam = content.get("cam")
    if not isinstance(cam, Mapping) or "part" not in cam:
        return dict(content), {}
    tables = cam["part"]
    if not isinstance(tables, Mapping):
        raise DesignError(f"{path}: cam.part: is {tables!r}; write a table [cam.part.NAME]")
    base = {key: value for key, value in cam.items() if key != "part"}
    parts = {}
    for name, table in tables.items():
        if not isinstance(table, Mapping):
            raise DesignError(f"{path}: cam.part.{name}: is {table!r}; write a table [cam.part.{name}]")
        for key in WHOLE_JOB:
            if key in table:
                raise DesignError(f"{path}: cam.part.{name}.{key}: holds for the whole job; set it in [cam]")
        parts[name] = {**content, "cam": _over(base, table)}
    return {**content, "cam": base}, parts


def _over(base: Mapping[str, Any], table: Mapping[str, Any], where: str = "") -> dict[str, Any]:
    """One table laid over another, key by key."""
    merged = dict(base)
    if where == "stock":
        for mine, other in (_EXCLUSIVE, _EXCLUSIVE[::-1]):
            if mine & table.keys() and not other & table.keys():
                merged = {key: value for key, value in merged.items() if key not in other}
    for key, value in table.items():
        old = merged.get(key)
        if isinstance(old, Mapping) and isinstance(value, Mapping):
            value = _over(old, value, key)
        merged[key] = value
    return merged
