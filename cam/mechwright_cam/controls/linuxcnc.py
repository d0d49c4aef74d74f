"""The post for LinuxCNC 2.9 and later."""

from collections.abc import Sequence

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.writing.base import GcodePost
from mechwright_cam.controls.writing.offsets import d_offset
from mechwright_cam.controls.writing.text import comment_lines, number
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, ToolSection
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind


class LinuxCncPost(GcodePost):
    """LinuxCNC: G43 with H, G53 retracts, cycles G81 to G83, arcs with incremental I and J."""

    name = "linuxcnc"
    title = "LinuxCNC"
    work_offsets = ("G54 to G59", "G59.1 to G59.3")
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

    def retract(self, out: Writer) -> None:
        """Go to the upper end of travel, in machine coordinates."""
        out.line("G53", "G0", "Z" + out.length(out.program.machine.retract_z))
        out.motion = "G0"
        out.lost_height()

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool."""
        out.line(f"T{section.tool.number} M6")

    def message(self, out: Writer, text: str) -> None:
        """Show a message on the control's screen."""
        for line in comment_lines(text):
            out.line(f"(MSG, {line})")

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with a cycle."""
        self.cycle(out, hole)

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``tool.tbl``: pocket, length, diameter and name; a length not measured yet stands at 0."""
        return "tool.tbl", "".join(_row(tool, tool.number, tool.diameter) for tool in _each(tools))

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same with the diameters that D takes: an own row where D has a number of its own."""
        rows = {}
        for tool in _each(tools):
            rows[tool.number] = _row(tool, tool.number, tool.diameter)
        for tool in _each(tools):
            if tool.kind is ToolKind.END_MILL:
                offset = d_offset(
                    tool, self.dialect, settings.post, settings.compensation, settings.wear_limit
                )
                rows[offset.number] = _row(tool, offset.number, offset.planned, f" D of T{tool.number}")
        return "tool.tbl", "".join(rows[number] for number in sorted(rows))


def _each(tools: Sequence[Tool]) -> list[Tool]:
    return sorted({tool.number: tool for tool in tools}.values(), key=lambda tool: tool.number)


def _row(tool: Tool, place: int, diameter: float, note: str = "") -> str:
    length = number(tool.length or 0.0)
    return f"T{place} P{place} Z{length} D{number(diameter)} ;{tool.name} {tool.kind}{note}\n"
