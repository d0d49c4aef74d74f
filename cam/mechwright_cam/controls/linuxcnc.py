"""LinuxCNC 2.9 and later, from its documents and sources."""

import math
from collections.abc import Sequence

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import METRIC
from mechwright_cam.controls.dialect import ROUGH, Arcs, Corners, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.lookahead.contract import Lookahead
from mechwright_cam.controls.lookahead.linuxcnc import Planner
from mechwright_cam.controls.offsets import G54_TO_G59, LINUXCNC_OFFSETS
from mechwright_cam.controls.reading.macros import Macros
from mechwright_cam.controls.words import linuxcnc as words
from mechwright_cam.controls.writing.drilling import EVERY_WAY
from mechwright_cam.controls.writing.measuring import Measuring
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Rapid, Tap
from mechwright_cam.shop.formats.linuxcnc import Row, table_text
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import LINUXCNC_ACTIVE, comment_lines, floored, number

IN_INCHES = 6
"""Decimals of a tolerance in inches: less would make it a third larger or smaller."""
TABLE = "tool.tbl"
"""Name of the tool table's file."""


class LinuxCnc(Measuring, GcodeControl):
    """LinuxCNC: G43 with H, G53 retracts, cycles G81 to G83, arcs with incremental I and J.

    Three axes. The limits of arcs are those of its interpreter's source in millimetres.
    """

    name = "linuxcnc"
    title = "LinuxCNC"
    dialect = Dialect(
        stored_homes=frozenset({"G28", "G30"}),
        macros=Macros,
        words=words.WORDS,
        kept=words.KEPT,
        text=Text(
            active_comments=("py,", "pyrun,", "pyreload", "abort,", "logopen,", "logappend,", "probeopen")
        ),
        # Without P, or without any word, it keeps up its speed however far it leaves the path.
        corners=Corners(unsaid=math.inf, after_g64=math.inf, tolerance=True),
        arcs=Arcs(inch=2.54, of_larger=True, most=2.83, least=0.00127, chord=0.00127),
        mode_ends_feed=True,
        entry_along_z=False,
        tapping="G33.1",
        taps_out=True,
    )
    modes = ("G17", METRIC, "G40", "G49", "G80", "G90", "G91.1", "G94")
    takes_back = "type G92.1 and G8 before zero is set, and look that R of the work offset is 0"
    work_offsets = (G54_TO_G59, LINUXCNC_OFFSETS)
    highest_tool = 99999
    stages = True
    subprograms = "first"
    taps = EVERY_WAY
    taps_again = True
    tap_needs = "G33.1 needs an encoder on the spindle, whose index is wired to spindle.0.index-enable."
    tolerances = (ROUGH, TOLERANCES.arc_fit, 0.0)
    active_comments = LINUXCNC_ACTIVE

    @property
    def lookahead(self) -> Lookahead:
        """Its trajectory planner."""
        return Planner()

    bound_words = "P and Q of G64 together"
    rounding_words = f"G64 P{TOLERANCES.arc_fit:g} Q0 (in mm)"

    def blending(self, exact: bool) -> list[str]:
        """How corners are taken.

        G64 without P would let the control round corners without limit: P keeps it within the tolerance of
        arcs, but for what :mod:`mechwright_cam.controls.lookahead.linuxcnc` knows of.
        """
        return self.rounding(0.0 if exact else TOLERANCES.arc_fit)

    def rounding(self, tolerance: float) -> list[str]:
        """Rounding within P, and Q0: no lines are merged."""
        digits = self.decimals if self.units == "mm" else IN_INCHES
        word = "P" + number(floored(tolerance / self.scale, digits), digits)
        return ["G64", word, "Q0"] if tolerance > 0 else ["G61"]

    def tap(self, out: Writer, hole: Tap) -> None:
        """G33.1 keeps feed and spindle together; a floating holder takes G84 or G74."""
        if out.tapping.floating:
            self.tap_cycle(out, hole)
            return
        self.rapid(out, Rapid(hole.x, hole.y))
        above = out.z
        self.rapid(out, Rapid(z=hole.retract))
        out.line("G33.1", "Z" + out.height(hole.bottom), "K" + out.pitch(out.tapping.pitch or 0.0))
        out.motion = ""
        self.rapid(out, Rapid(z=above))

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """An O-word; the control passes over what stands up to its end until it is called."""
        return f"o{self.subprogram_number(out, number)} sub"

    def subprogram_ends(self, out: Writer, number: int) -> str:
        """The O-word of the same number."""
        return f"o{self.subprogram_number(out, number)} endsub"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """The O-word of the same number."""
        return f"o{self.subprogram_number(out, number)} call"

    def message(self, out: Writer, text: str) -> None:
        """Show a message on the control's screen."""
        for line in comment_lines(text):
            out.line(f"(MSG, {line})")

    def needs(self, settings: CamSettings) -> Sequence[str]:  # noqa: ARG002
        """Tables are in the units of the machine, whatever those of the program."""
        inch = f"{TABLE} is in inches, for a machine with LINEAR_UNITS = inch in its INI file."
        return [inch] if self.units == "inch" else []

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``tool.tbl``: pocket, length, diameter and what it is; a length not measured yet stands at 0."""
        each = {tool.number: tool for tool in tools}.values()
        return TABLE, table_text((Row(tool.number, tool, tool.diameter) for tool in each), self.units)

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same with the diameters that D takes: an own row where D has a number of its own."""
        rows = self.offsets.rows(tools, settings)
        return TABLE, table_text((Row(place, row[0], row[1]) for place, row in rows.items()), self.units)
