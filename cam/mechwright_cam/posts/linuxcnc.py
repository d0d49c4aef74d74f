"""The post for LinuxCNC 2.9 and later."""

import math
from collections.abc import Sequence

from mechwright.program import Drill, ToolSection
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import Tool
from mechwright_cam.posts.base import GcodePost, Writer
from mechwright_cam.posts.text import comment_lines, number


class LinuxCncPost(GcodePost):
    """LinuxCNC: G43 with H, G53 retracts, cycles G81 to G83, arcs with incremental I and J."""

    name = "linuxcnc"
    title = "LinuxCNC"
    active_comments = (
        *("MSG", "DEBUG", "PRINT", "LOG", "LOGOPEN", "LOGAPPEND", "LOGCLOSE"),
        *("PROBEOPEN", "PROBECLOSE", "PY"),
    )

    def safe_start(self, out: Writer) -> None:
        """Set every mode that the program relies on.

        G64 without P would let the control round corners without limit: P keeps it within the tolerance of
        arcs.
        """
        out.line("G17", "G21", "G40", "G49", "G80", "G90", "G94")
        out.line("G64", "P" + number(TOLERANCES.arc_fit))

    def retract(self, out: Writer) -> None:
        """Go to machine Z0, the upper end of travel."""
        out.line("G53 G0 Z0")
        out.motion = "G0"
        out.lost_height()

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool, select the work offset, start the spindle."""
        out.line(f"T{section.tool.number} M6")
        out.line(out.program.work_offset, "S" + number(section.spindle, 0), "M3")
        out.feed = ""  # a section that is run by itself states its feed
        out.x = out.y = math.nan
        out.motion = ""

    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:
        """Turn on the tool's length offset, with the first move to z."""
        out.line(f"G43 H{section.tool.number}", *out.axis_words(None, None, z))

    def message(self, out: Writer, text: str) -> None:
        """Show a message on the control's screen."""
        for line in comment_lines(text):
            out.line(f"(MSG, {line})")

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with G81, G82 (dwell) or G83 (pecks); holes that agree share the cycle."""
        if hole.peck is not None and hole.dwell > 0:
            self.end_drilling(out)  # no cycle of LinuxCNC does both
            self.drill_in_moves(out, hole)
            return
        code = "G83" if hole.peck is not None else "G82" if hole.dwell > 0 else "G81"
        words = [code, "Z" + number(hole.bottom), "R" + number(hole.retract)]
        if hole.peck is not None:
            words.append("Q" + number(hole.peck))
        elif hole.dwell > 0:
            words.append("P" + number(hole.dwell, 3))
        # The cycle itself returns to the height it started from, so z stays what it is.
        cycle = (*words, number(hole.feed, 1))
        if out.cycle == cycle:
            place = out.axis_words(hole.x, hole.y, None)
            out.line(*(place or ["X" + number(hole.x)]))
            return
        self.end_drilling(out)
        out.x = out.y = math.nan  # the first line of a cycle states both
        place = out.axis_words(hole.x, hole.y, None)
        out.line("G98", words[0], *place, *words[1:], out.feed_word(hole.feed))
        out.cycle = cycle
        out.motion = code

    def end_drilling(self, out: Writer) -> None:
        """Leave the cycle with G80."""
        if out.cycle:
            out.line("G80")
            out.cycle = ()
            out.motion = ""

    def end(self, out: Writer) -> None:
        """Coolant, spindle and height are safe already; end."""
        out.line("M30")

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``tool.tbl``: pocket, diameter and name; Z is measured at the machine, so it stands at 0."""
        lines = [
            f"T{tool.number} P{tool.number} Z0 D{number(tool.diameter)} ;{tool.name} {tool.kind}"
            for tool in sorted({tool.number: tool for tool in tools}.values(), key=lambda tool: tool.number)
        ]
        return "tool.tbl", "\n".join(lines) + "\n"
