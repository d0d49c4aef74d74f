"""The tool library: cutters in a TOML file that a person can extend, or in a file of another program."""

import difflib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from mechwright.contracts.materials import GROUPS, MATERIALS
from mechwright.designs.files import read_toml
from mechwright.designs.inches import converted, told_in, units_of
from mechwright.designs.tables import read_table
from mechwright.errors import DesignError, ToolError
from mechwright.reading import kind_of, read_bytes
from mechwright_cam.shop.crib import read_crib
from mechwright_cam.shop.formats.contract import Format
from mechwright_cam.shop.formats.known import format_of
from mechwright_cam.shop.tool import CuttingChange, CuttingData, CuttingTable, Tool, ToolKind

BUILT_IN = Path(__file__).with_name("tools.toml")
"""The file of the cutters that come with the program."""


@dataclass(frozen=True)
class Library:
    """Cutters by name, each with its own T number; a DesignError names two that share one."""

    tools: tuple[Tool, ...]
    told: tuple[str, ...] = ()
    """What was left out or completed when a file of another program was read, a line each."""

    def __post_init__(self) -> None:
        _check_apart("number", "T number", [(tool.number, tool) for tool in self.tools])
        compensated = [t for t in self.tools if t.kind is ToolKind.END_MILL or t.diameter_offset is not None]
        _check_apart("D number", "diameter_offset", [(tool.d_number, tool) for tool in compensated])

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
            f"no tool {name!r} in the library; "
            f"{'did you mean' if len(near) <= 3 else 'known:'} {', '.join(near)}"
        )

    def extended(self, tools: tuple[Tool, ...]) -> "Library":
        """The library with more cutters; one of a known name replaces the known one."""
        merged = {tool.name: tool for tool in self.tools} | {tool.name: tool for tool in tools}
        return replace(self, tools=tuple(merged.values()))

    def cutting(self, changes: Mapping[str, CuttingChange]) -> "Library":
        """The library with cutting data of a design over its own, by the name of the tool.

        They hold for every material that the tool cuts. With a speed and a chip load they also stand for a
        material that the library has no data for. Raises ToolError where there is no such tool.
        """
        return self.extended(tuple(_changed(self.get(name), change) for name, change in changes.items()))

    def measured(self, lengths: Mapping[str, float]) -> "Library":
        """The library with lengths as measured, mm, by the name of the tool."""
        known = [tool for tool in self.tools if lengths.get(tool.name, tool.length) != tool.length]
        return self.extended(tuple(t.model_copy(update={"length": lengths[t.name]}) for t in known))


def _check_apart(what: str, key: str, numbers: list[tuple[int, Tool]]) -> None:
    known: dict[int, Tool] = {}
    for number, tool in numbers:
        other = known.setdefault(number, tool)
        if other is not tool:
            raise DesignError(
                f"tools {other.name!r} and {tool.name!r} both have {what} {number}; give one of them "
                f"another {key}"
            )


def _changed(tool: Tool, change: CuttingChange) -> Tool:
    said = change.model_dump(exclude_none=True)
    if tool.pitch is not None:
        if "chip_load" in said:
            raise DesignError(
                f"cam.cutting.{tool.name}.chip_load: a tap feeds its pitch, {tool.pitch:g} mm, in a turn; "
                "leave it out"
            )
        said["chip_load"] = tool.pitch / tool.flutes
    cutting = {name: data.model_copy(update=said) for name, data in tool.cutting.items()}
    if "cutting_speed" in said and "chip_load" in said:
        cutting = dict.fromkeys(GROUPS, CuttingData(**said)) | cutting
    return tool.model_copy(update={"cutting": CuttingTable(cutting)})


@cache
def built_in() -> Library:
    """The cutters that come with the program."""
    return Library(read_tools(BUILT_IN))


def load_library(path: Path | None = None, at_hand: Library | None = None) -> Library:
    """Give the cutters at hand, by default the built-in ones, extended and overridden by those in ``path``.

    A library of another program is a whole crib, and so is one of ours that says ``built_in = false``: then
    the built-in cutters are not at hand. Raises OutputError where the file cannot be read; DesignError that
    names file, tool, key, value and limit, a line for each wrong key.
    """
    at_hand = built_in() if at_hand is None else at_hand
    if path is None:
        return at_hand
    form = _form_of(path)
    if form is not None:
        crib = read_crib(path, form)
        tools, told, base = crib.tools, crib.told, Library(())
    else:
        tools, more = _read(path)
        told, base = (), at_hand if more else Library(())
    try:
        return replace(base.extended(tools), told=told)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from error


def library_files(path: Path) -> tuple[Path, ...]:
    """The files that a library consists of, itself first; raises as :func:`load_library` does."""
    form = _form_of(path)
    return (path, *(form.companion_files(path) if form is not None else ()))


def _form_of(path: Path) -> Format | None:
    """The format of a library; a folder is told as a folder, whatever its name ends in."""
    mode = 0
    with suppress(OSError, ValueError):  # told when it is read
        mode = path.stat().st_mode
    if mode and kind_of(mode):
        read_bytes(path)  # says what it is
    return format_of(path)


def read_tools(path: Path) -> tuple[Tool, ...]:
    """Read the ``[[tool]]`` tables of one file; raises OutputError or DesignError."""
    return _read(path)[0]


def _read(path: Path) -> tuple[tuple[Tool, ...], bool]:
    """The cutters of a file of ours, and whether the built-in ones are at hand besides."""
    data = read_toml(path)[0]
    units, more = units_of(data, path), data.pop("built_in", True)
    rows, _ = data.pop("tool", None), data.pop("units", None)
    if data:
        raise DesignError(f"{path}: unknown key {next(iter(data))!r}; a tool library holds [[tool]] tables")
    if not isinstance(more, bool):
        raise DesignError(f"{path}: built_in: is {more!r}; write true or false")
    if not isinstance(rows, list) or not rows:
        raise DesignError(f"{path}: holds no tool; add a [[tool]] table")
    if units == "inch":
        keys = Tool.model_json_schema()
        rows = [converted(row, keys) for row in rows]
    with told_in(units):
        return tuple(tools_of(rows, path).values()), more


def tools_of(rows: Sequence[object], path: Path) -> dict[str, Tool]:
    """Name to tool of the ``[[tool]]`` tables of a file; raises DesignError for what is wrong with one."""
    tools: dict[str, Tool] = {}
    for position, row in enumerate(rows, start=1):
        tool = _read_tool(path, position, row)
        if tool.name in tools:
            raise DesignError(f"{path}: two tools are called {tool.name!r}; rename one")
        tools[tool.name] = tool
    return tools


def _read_tool(path: Path, position: int, row: object) -> Tool:
    name = row.get("name") if isinstance(row, dict) else None
    where = f"tool {name!r}" if isinstance(name, str) else f"tool {position} of the file"
    tool = read_table(Tool, row, str(path), where)
    unknown = set(tool.cutting) - set(MATERIALS)
    if unknown:
        raise DesignError(
            f"{path}: {where}.cutting: no such material as {min(unknown)!r}; one of: "
            f"{', '.join(sorted(MATERIALS))}"
        )
    return tool
