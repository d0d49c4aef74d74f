"""The post for Fanuc controls (0i, 30i and their kin) with custom of the trade: see docs/controls.md."""

from collections.abc import Sequence

from mechwright_cam.controls.writing.base import GcodePost
from mechwright_cam.controls.writing.offsets import DOffset, d_offset
from mechwright_cam.controls.writing.text import comment_lines, number
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, ToolSection
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

OFFSETS_NUMBER = 7999
"""O number of the file of tool lengths: from 8000 on, programs are commonly locked against editing."""


class FanucPost(GcodePost):
    """Fanuc: percent signs and an O number, retract by G91 G28, numbers with a point, P in milliseconds."""

    name = "fanuc"
    title = "Fanuc"
    dialect = "fanuc"
    decimals = 3
    point = True
    capitals = True
    milliseconds = True
    forbidden = '%;@&!?"<>{}|\\^`~$'
    work_offsets = ("G54 to G59", "G54.1 P1 to P48")
    highest_tool = 9999

    def frame(self, out: Writer) -> None:
        """Percent sign and program number."""
        out.line("%")
        name = "".join(comment_lines(out.program.name, forbidden=self.forbidden, upper=True)[:1])
        out.line(f"O{out.program.posting.program_number:04d}", f"({name})")

    def retract(self, out: Writer) -> None:
        """Go to the reference point of Z, from where the tool stands: G91 makes that the way."""
        out.line("G91", "G28", "Z0.")
        out.line("G90")
        out.motion = ""
        out.lost_height()

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool; the spindle has stopped and stands at its reference point."""
        out.line(f"T{section.tool.number} M6")

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with a cycle."""
        self.cycle(out, hole)

    def end(self, out: Writer) -> None:
        """End, rewind, and the closing percent sign."""
        out.line("M30")
        out.line("%")

    def tool_words(self, tool: Tool) -> list[str]:
        """The length as geometry offset (offset memory C)."""
        return [f"G10 L10 P{tool.number} R{number(tool.length or 0.0, self.decimals, self.point)}"]

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """A program that sets the lengths that have been measured; none if none has."""
        return self._offsets_file(tools, ())

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same, and the D offsets: geometry (L12) as planned, wear (L13) 0."""
        offsets = [
            d_offset(tool, self.dialect, settings.post, settings.compensation, settings.wear_limit)
            for tool in tools
            if tool.kind is ToolKind.END_MILL
        ]
        return self._offsets_file(tools, offsets)

    def _offsets_file(self, tools: Sequence[Tool], offsets: Sequence[DOffset]) -> tuple[str, str]:
        measured = {tool.number: tool for tool in tools if tool.length is not None}
        if not measured and not offsets:
            return "", ""
        what = "TOOL LENGTHS, RUN ONCE"
        if offsets:
            what = f"TOOL LENGTHS, {offsets[0].quantity.upper()} IN D, RUN ONCE FOR NEW CUTTERS"
        lines = ["%", f"O{OFFSETS_NUMBER:04d}", f"({what})", "G21 G90"]
        for _, tool in sorted(measured.items()):
            lines += self.tool_words(tool)
        for offset in sorted(offsets, key=lambda offset: offset.number):
            value = number(offset.planned, self.decimals, self.point)
            lines += [f"G10 L12 P{offset.number} R{value}", f"G10 L13 P{offset.number} R0."]
        return "tool-offsets.nc", "\n".join([*lines, "M30", "%"]) + "\n"
