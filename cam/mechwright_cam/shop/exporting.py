"""Writing a tool library in any format, and telling what the format could not hold."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mechwright.errors import OutputError
from mechwright.output.folder import write_new
from mechwright_cam.shop.formats.known import format_of
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.toml_text import library_text
from mechwright_cam.shop.tool import Tool

SAME = 1e-6
"""Sizes that differ by less, of 1 or of themselves, are the same: files round to a millionth of a
millimetre."""
NAMED = 3
"""Tools that are named one by one in a line."""


def export(tools: Sequence[Tool], path: Path, *, replace: bool = False) -> tuple[tuple[Path, ...], list[str]]:
    """Write tools into a file of the format that its name ends in, and read it back.

    Returns
    -------
    files
        Those that are written.
    lost
        A line for each key that the file does not hold, found by reading it.

    Raises DesignError where there is no such format or it can hold none of the tools, OutputError where a
    file is there already or cannot be written.
    """
    form = format_of(path)
    files = {path: library_text(tools).encode()} if form is None else form.files(tools, path)
    if not replace and (there := next((file for file in files if file.exists()), None)):
        raise OutputError(f"{there}: is there already; give another name, or --force to replace it")
    for file, content in reversed(files.items()):  # what a list names is there before it
        try:
            file.parent.mkdir(exist_ok=True)
        except OSError as error:
            raise OutputError(f"{file.parent}: cannot be made: {error.strerror or error}") from error
        write_new(file, content, replace=replace)
    return tuple(files), lost(tools, load_library(path).tools)


def lost(before: Sequence[Tool], after: Sequence[Tool]) -> list[str]:
    """What is in the first of two lists of tools and not in the second, told by key."""
    found = {tool.number: _facts(tool) for tool in after}
    differing: dict[str, list[str]] = {}
    for tool in before:
        known = found.get(tool.number)
        if known is None:
            differing.setdefault("tool", []).append(tool.name)
            continue
        for key, value in _facts(tool).items():
            if not _same(value, known[key]):
                differing.setdefault(key, []).append(tool.name)
    return [f"holds no {key} of {_named(names)}" for key, names in differing.items()]


def _facts(tool: Tool) -> dict[str, Any]:
    """A tool's keys, with the D number that holds."""
    return {**tool.model_dump(mode="json"), "diameter_offset": tool.d_number}


def _same(one: Any, two: Any) -> bool:
    if isinstance(one, dict) and isinstance(two, dict):
        return one.keys() == two.keys() and all(_same(one[key], two[key]) for key in one)
    if isinstance(one, float) and isinstance(two, float):
        return math.isclose(one, two, rel_tol=SAME, abs_tol=SAME)
    return bool(one == two)


def _named(names: Sequence[str]) -> str:
    more = len(names) - NAMED
    return ", ".join(names[:NAMED]) + (f" and {more} more" if more > 0 else "")
