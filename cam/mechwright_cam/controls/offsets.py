"""What a control keeps in its tables of offsets: of tools, what a D has to hold, and of the work.

Glossary
--------
H
    Number of a length offset: by so much the tool is longer than the spindle nose, or than another tool.
D
    Number of an offset for cutter compensation.
geometry, wear
    Two columns of one offset, which the control adds up: the tool as planned, and what it has become.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright_cam.program.moves import Program
from mechwright_cam.shop.posting import Compensation, Posting
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

Quantity = Literal["radius", "diameter"]


@dataclass(frozen=True)
class DOffset:
    """A D offset: its number, what it holds when the tool is as planned, how much that may change, mm."""

    number: int
    tool: Tool
    quantity: Quantity
    planned: float
    limit: float
    wear: float = 0.0
    """What it has become since, of the same quantity, mm."""


@dataclass(frozen=True, slots=True)
class OffsetTables:
    """What a control keeps of each tool."""

    lengths: bool = True
    """Whether it keeps lengths, for G43 H. Without, tools are touched off one by one."""
    length_word: str = ""
    """The word that gives a tool its length in the program instead, such as ``"G43.1"``; empty if there is
    none.
    """
    d: Literal["radius", "diameter", "setting"] | None = "diameter"
    """What a D offset holds; ``"setting"`` if a setting of the machine says which, and so ``d_value`` of the
    design file; None without cutter compensation.
    """
    d_setting: str = ""
    """Where the machine is told which."""
    wear: bool = False
    """Whether D has columns of geometry and wear."""

    def of_program(self, program: Program) -> list[DOffset]:
        """The D offsets that a program uses."""
        planned = program.posting, program.compensation, program.wear_limit
        return [self.d_offset(tool, *planned) for tool in program.compensated]

    def of_tools(self, tools: Sequence[Tool], cam: CamSettings) -> list[DOffset]:
        """Those that tools need which may finish walls with cutter compensation."""
        planned = cam.post, cam.compensation, cam.wear_limit
        return [self.d_offset(tool, *planned) for tool in tools if tool.kind is ToolKind.END_MILL]

    def rows(self, tools: Sequence[Tool], cam: CamSettings) -> dict[int, tuple[Tool, float, str]]:
        """A table whose D are numbers of tools: to each number the tool, its diameter or D, and a note."""
        rows = {tool.number: (tool, tool.diameter, "") for tool in tools}
        return rows | {
            d.number: (d.tool, d.planned + d.wear, f"D of T{d.tool.number}")
            for d in self.of_tools(tools, cam)
        }

    def d_offset(self, tool: Tool, posting: Posting, compensation: Compensation, wear: float) -> DOffset:
        """The D offset of a tool, when its radius may be off by ``wear`` mm; ValueError if there is none.

        >>> tool = Tool(name="mill-6", number=3, kind="end-mill", diameter=6, flute_length=12)
        >>> offset = OffsetTables().d_offset(tool, Posting(), "control", 0.1)
        >>> offset.quantity, offset.planned, offset.limit
        ('diameter', 6.0, 0.2)
        """
        if self.d is None:
            raise ValueError("a control without cutter compensation has no D offsets")
        quantity = posting.d_value if self.d == "setting" else self.d
        factor = 1 if quantity == "radius" else 2
        planned = 0.0 if compensation == "wear" else factor * tool.radius
        return DOffset(tool.d_number, tool, quantity, planned, factor * wear, factor * tool.wear_diameter / 2)


@dataclass(frozen=True)
class WorkOffsets:
    """A row of work offsets."""

    name: str
    """The name that people see."""
    pattern: str
    """How its offsets are spelt, with the number as a group."""
    words: str
    """The words that set one, with ``{}`` for its place in the row."""
    before: int = 0
    """The number before that of the first in the row."""

    def has(self, offset: str) -> bool:
        """Whether the row has an offset.

        >>> G54_TO_G59.has("G59"), G54_TO_G59.has("G59.1")
        (True, False)
        """
        return re.fullmatch(self.pattern, offset) is not None

    def setting(self, offset: str) -> str:
        """The words that set one of its offsets, without the axes.

        >>> G54_TO_G59.setting("G55"), FANUC_OFFSETS.setting("G54.1 P7")
        ('G10 L2 P2', 'G10 L20 P7')
        """
        return self.words.format(self.place(offset))

    def place(self, offset: str) -> int:
        """The place of one of its offsets in the row.

        >>> G54_TO_G59.place("G55")
        2
        """
        match = re.fullmatch(self.pattern, offset)
        assert match is not None  # noqa: S101 - the caller has looked it up
        return int(match[1]) - self.before


G54_TO_G59 = WorkOffsets("G54 to G59", r"G(5[4-9])", "G10 L2 P{}", 53)
LINUXCNC_OFFSETS = WorkOffsets("G59.1 to G59.3", r"G59\.([1-3])", "G10 L2 P{}", -6)
FANUC_OFFSETS = WorkOffsets("G54.1 P1 to P48", r"G54\.1 P([1-9]|[123]\d|4[0-8])", "G10 L20 P{}")
HAAS_OFFSETS = WorkOffsets("G154 P1 to P99", r"G154 P([1-9]\d?)", "G10 L20 P{}")


_ROWS = (
    (r"G(5[4-9])", 2, -53),
    (r"G59\.([1-3])", 2, 6),
    (r"(?:G54\.1|G154) P(\d+)", 20, 0),
)
"""How work offsets are spelt, the L of G10 that sets them, and what to add to their number for its P."""


def place_of(offset: str) -> tuple[int, int]:
    """L and P of the G10 that sets a work offset."""
    for pattern, table, more in _ROWS:
        if match := re.fullmatch(pattern, offset):
            return table, int(match[1]) + more
    return 0, 0
