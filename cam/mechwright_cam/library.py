"""The tool library: cutters in a TOML file that a person can extend."""

import difflib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from mechwright.design import read_toml
from mechwright.errors import DesignError, ToolError
from mechwright.materials import MATERIALS
from mechwright.tooling import Tool

BUILT_IN = Path(__file__).with_name("data") / "tools.toml"
"""The file of the cutters that come with the program."""


@dataclass(frozen=True)
class Library:
    """Cutters by name, each with its own T number.

    Raises
    ------
    DesignError
        Two cutters have one T number; the message names both.
    """

    tools: tuple[Tool, ...]

    def __post_init__(self) -> None:
        by_number: dict[int, Tool] = {}
        for tool in self.tools:
            other = by_number.setdefault(tool.number, tool)
            if other is not tool:
                raise DesignError(
                    f"tool library: tools {other.name!r} and {tool.name!r} both have number {tool.number}; "
                    "give one of them another T number"
                )

    def __iter__(self) -> Iterator[Tool]:
        return iter(self.tools)

    def get(self, name: str) -> Tool:
        """The cutter of this name; raises ToolError that lists close matches."""
        for tool in self.tools:
            if tool.name == name:
                return tool
        names = [tool.name for tool in self.tools]
        near = difflib.get_close_matches(name, names, n=3, cutoff=0.5) or names
        raise ToolError(
            f"cam.tools: no tool {name!r} in the library; "
            f"{'did you mean' if len(near) <= 3 else 'known:'} {', '.join(near)}"
        )

    def extended(self, tools: tuple[Tool, ...]) -> "Library":
        """The library with more cutters; one of a known name replaces the known one."""
        merged = {tool.name: tool for tool in self.tools} | {tool.name: tool for tool in tools}
        return Library(tuple(merged.values()))


@cache
def built_in() -> Library:
    """The cutters that come with the program."""
    return Library(read_tools(BUILT_IN))


def load_library(path: Path | None = None) -> Library:
    """Give the built-in library, extended and overridden by the cutters in ``path``.

    Raises
    ------
    DesignError
        The file cannot be read, or a tool in it is wrong: file, tool, key, value and limit are named.
    """
    return built_in() if path is None else built_in().extended(read_tools(path))


def read_tools(path: Path) -> tuple[Tool, ...]:
    """Read the ``[[tool]]`` tables of one file; raises DesignError."""
    data, _ = read_toml(path)
    rows = data.pop("tool", None)
    if data:
        raise DesignError(f"{path}: unknown table {next(iter(data))!r}; it holds [[tool]] tables")
    if not isinstance(rows, list) or not rows:
        raise DesignError(f"{path} holds no tool; add a [[tool]] table")
    tools: dict[str, Tool] = {}
    for position, row in enumerate(rows, start=1):
        tool = _read_tool(path, position, row)
        if tool.name in tools:
            raise DesignError(f"{path}: two tools are called {tool.name!r}; rename one")
        tools[tool.name] = tool
    return Library(tuple(tools.values())).tools


def _read_tool(path: Path, position: int, row: Any) -> Tool:
    name = row.get("name", f"number {position} of the file") if isinstance(row, dict) else position
    where = f"{path}: tool {name!r}"
    try:
        tool = Tool.model_validate(row)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in first["loc"]) or "table"
        # A missing key has the whole table as its input: that would only hide the message.
        given = "" if isinstance(first["input"], dict) else f" (it is {first['input']!r})"
        raise DesignError(f"{where}: {key}: {first['msg']}{given}") from error
    unknown = set(tool.cutting) - set(MATERIALS)
    if unknown:
        raise DesignError(
            f"{where}: cutting.{min(unknown)}: no such material; one of: {', '.join(sorted(MATERIALS))}"
        )
    return tool
