"""LinuxCNC 2.9 and later, from its documents and sources."""

import math
from collections.abc import Sequence

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.corners import Corners
from mechwright_cam.controls.dialect import FEEDS, RETURN, Dialect
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.reading.macros import Macros
from mechwright_cam.controls.work_offsets import G54_TO_G59, LINUXCNC_OFFSETS
from mechwright_cam.controls.writing.text import comment_lines, number
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

_MOTION = {0, 10, 20, 30, 730, 800, 810, 820, 830, 850, 890}
_PLANE_UNITS = {170, 180, 190, 200, 210}
_OFFSETS = {100, 400, 410, 411, 420, 421, 430, 431, 490, 540, 550, 560, 570, 580, 590, 591, 592, 593}
_MODES = {40, 280, 530, 610, 611, 640, 900, 901, 910, 911, 940, 980, 990}


class LinuxCnc(GcodeControl):
    """LinuxCNC: G43 with H, G53 retracts, cycles G81 to G83, arcs with incremental I and J.

    Three axes. The limits of arcs are those of its interpreter's source in millimetres.
    """

    name = "linuxcnc"
    title = "LinuxCNC"
    dialect = Dialect(
        macros=Macros,
        # Without P, or without any word, it keeps up its speed however far it leaves the path.
        corners=Corners(unsaid=math.inf, after_g64=math.inf, tolerance=True),
        g_codes=frozenset(_MOTION | _PLANE_UNITS | _OFFSETS | _MODES),
        unsupported=(
            (RETURN, "retract with G53 G0 Z0 or G28"),
            (840, "tapping is not simulated"),
            (920, "shift the origin with the work offset, G54 to G59.3"),
            (930, FEEDS),
            (950, FEEDS),
        ),
    )
    work_offsets = (G54_TO_G59, LINUXCNC_OFFSETS)
    highest_tool = 99999
    active_comments = (
        *("MSG", "DEBUG", "PRINT", "LOG", "LOGOPEN", "LOGAPPEND", "LOGCLOSE"),
        *("PROBEOPEN", "PROBECLOSE", "PY"),
    )

    def blending(self, exact: bool) -> list[str]:
        """How corners are taken.

        G64 without P would let the control round corners without limit: P keeps it within the tolerance of
        arcs.
        """
        return ["G61"] if exact else ["G64", "P" + number(TOLERANCES.arc_fit)]

    def message(self, out: Writer, text: str) -> None:
        """Show a message on the control's screen."""
        for line in comment_lines(text):
            out.line(f"(MSG, {line})")

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``tool.tbl``: pocket, length, diameter and name; a length not measured yet stands at 0."""
        return "tool.tbl", "".join(_row(tool, tool.number, tool.diameter) for tool in _each(tools))

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same with the diameters that D takes: an own row where D has a number of its own."""
        rows = {tool.number: _row(tool, tool.number, tool.diameter) for tool in tools}
        for d in self.offsets.of_tools(_each(tools), settings):
            rows[d.number] = _row(d.tool, d.number, d.planned, f" D of T{d.tool.number}")
        return "tool.tbl", "".join(rows[number] for number in sorted(rows))


def _each(tools: Sequence[Tool]) -> list[Tool]:
    return sorted({tool.number: tool for tool in tools}.values(), key=lambda tool: tool.number)


def _row(tool: Tool, place: int, diameter: float, note: str = "") -> str:
    length = number(tool.length or 0.0)
    return f"T{place} P{place} Z{length} D{number(diameter)} ;{tool.name} {tool.kind}{note}\n"
