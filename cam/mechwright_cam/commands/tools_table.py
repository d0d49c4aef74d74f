"""Tools as a text of 80 columns: nothing is cut off, long names have a line of their own."""

import textwrap
from collections.abc import Iterable, Sequence

from mechwright.contracts.materials import MATERIALS
from mechwright_cam.planning.uses import Use
from mechwright_cam.shop.lengths import MILLIMETRES, Lengths
from mechwright_cam.shop.tool import Tool, ToolKind

WIDTH = 80
TIE = "\a"
"""A blank at which no line ends."""
HEAD = ("T", "name", "kind", "D", "end", "z", "flutes", "out", "holder", "of")
LEGEND = (
    "in {unit}: D diameter, end radius of the corner or angle of the point/its flat or P pitch, flutes their "
    "length, out of the holder, holder its diameter; z teeth, of what it is made"
)
LEFT = frozenset({"name", "kind", "of"})
"""Columns of words; those of figures stand on the right."""


def listing(tools: Sequence[Tool], to: Lengths = MILLIMETRES) -> list[str]:
    """A line for each tool by T number, and below them what each is for and can cut."""
    rows = [_row(tool, to) for tool in sorted(tools, key=lambda tool: tool.number)]
    widths = [max(len(cell) for cell in column) for column in zip(HEAD, *rows, strict=True)]
    named = HEAD.index("name")
    room = WIDTH - sum(widths) - 2 * (len(HEAD) - 1) + widths[named]
    widths[named] = min(widths[named], max(room, len("name")))
    lines = []
    for row in (HEAD, *rows):
        cells = list(row)
        if len(cells[named]) > widths[named]:
            lines.append(f"{cells[0]:>{widths[0]}}  {cells[named]}")
            cells[0] = cells[named] = ""
        padded = (
            f"{cell:<{width}}" if name in LEFT else f"{cell:>{width}}"
            for name, cell, width in zip(HEAD, cells, widths, strict=True)
        )
        lines.append("  ".join(padded).rstrip())
    purposes = (f"T{tool.number} is for {tool.purpose}" for tool in tools if tool.purpose)
    told = [line for purpose in purposes for line in _wrapped(purpose)]
    return [
        *lines,
        "",
        *_wrapped(LEGEND.format(unit="mm" if to.units == "mm" else "inches")),
        *told,
        *_materials(tools),
    ]


def _row(tool: Tool, to: Lengths) -> tuple[str, ...]:
    pointed = tool.kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.CHAMFER}
    end = f"{tool.point_angle:g}°" if pointed else f"R{to.plain(tool.nose)}" if tool.nose else "flat"
    if tool.pitch is not None:
        end = f"P{to.plain(tool.pitch)}"
    if tool.tip_diameter:
        end = f"{end}/{to.plain(tool.tip_diameter)}"
    out = "-" if tool.stick_out is None else to.plain(tool.stick_out)
    return (
        str(tool.number),
        tool.name,
        tool.kind,
        to.plain(tool.diameter),
        "-" if tool.kind is ToolKind.THREAD_MILL else end,
        str(tool.flutes),
        to.plain(tool.flute_length),
        out,
        to.plain(tool.holder_diameter),
        tool.substrate,
    )


def _materials(tools: Sequence[Tool]) -> Iterable[str]:
    """For which materials the tools have cutting data, tools of the same ones in one paragraph."""
    groups: dict[tuple[str, ...], list[Tool]] = {}
    for tool in tools:
        groups.setdefault(tuple(name for name in MATERIALS if name in set(tool.cutting)), []).append(tool)
    for materials, found in groups.items():
        start = f"cutting data for {', '.join(materials)}" if materials else "no cutting data"
        which = "all" if len(groups) == 1 else " ".join(f"T{tool.number}" for tool in found)
        yield from _wrapped(f"{start}: {which}")
        if not materials:
            yield from _wrapped("give cutting_speed and chip_load in [cam.cutting.NAME] of a design", "  ")


def doing(name: str, found: Sequence[Use]) -> list[str]:
    """What the tools do in a program, a paragraph for each."""
    tools = {use.tool.name: use.tool for use in found}
    lines = [f"{name}:"]
    for tool in sorted(tools.values(), key=lambda tool: tool.number):
        work: dict[str, list[str]] = {}
        for use in found:
            if use.tool.name == tool.name:
                work.setdefault(use.doing, []).append(use.feature)
        said = "; ".join(f"{one} {', '.join(dict.fromkeys(names))}" for one, names in work.items())
        lines += _wrapped(f"  T{tool.number} {tool.name}: {said}")
    return lines


def unneeded_lines(tools: Sequence[Tool]) -> list[str]:
    """The tools that a design does not need."""
    if not tools:
        return ["not needed: none"]
    names = ", ".join(f"T{tool.number}{TIE}{tool.name}" for tool in tools)
    return [line.replace(TIE, " ") for line in _wrapped(f"not needed: {names}")]


def _wrapped(text: str, indent: str = "    ") -> list[str]:
    return textwrap.wrap(
        text, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )
