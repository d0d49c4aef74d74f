"""The post for Mach3."""

import csv
import io
from collections.abc import Sequence

from mechwright.program import Drill, Program, ToolSection
from mechwright.tooling import Tool
from mechwright_cam.posts.base import GcodePost
from mechwright_cam.posts.text import number
from mechwright_cam.posts.writer import Writer


class Mach3Post(GcodePost):
    """Mach3: arcs by G91.1, G53 retracts, a tool change that runs the machine's own macro."""

    name = "mach3"
    title = "Mach3"
    dialect = "mach3"
    forbidden = "%;"
    highest_tool = 254
    modes = ("G17", "G21", "G40", "G49", "G80", "G90", "G91.1", "G94")

    def head(self, out: Writer) -> None:
        """Tell the setting that the program relies on, where it does."""
        super().head(out)
        if _waits(out.program):
            self.comment(out, "dwells are in seconds: G04 dwell in ms must be off")

    def retract(self, out: Writer) -> None:
        """Go to the upper end of travel, in machine coordinates."""
        out.line("G53", "G0", "Z" + out.length(out.program.machine.retract_z))
        out.motion = "G0"
        out.lost_height()

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool."""
        out.line(f"T{section.tool.number} M6")

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with a cycle."""
        self.cycle(out, hole)

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``mach3-tools.csv``: what to type into the tool table, which is binary itself."""
        text = io.StringIO()
        rows = csv.writer(text, lineterminator="\n")
        rows.writerow(["tool", "description", "diameter", "height"])
        for tool in sorted({tool.number: tool for tool in tools}.values(), key=lambda tool: tool.number):
            height = "" if tool.length is None else number(tool.length)
            rows.writerow([tool.number, f"{tool.name} {tool.kind}", number(tool.diameter), height])
        return "mach3-tools.csv", text.getvalue()


def _waits(program: Program) -> bool:
    moves = (m for section in program.sections for operation in section.operations for m in operation.moves)
    return program.machine.spindle_delay > 0 or any(isinstance(m, Drill) and m.dwell > 0 for m in moves)
