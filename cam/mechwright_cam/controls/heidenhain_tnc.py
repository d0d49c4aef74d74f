"""HEIDENHAIN TNC 640, iTNC 530 and their kin, in Klartext: see docs/controls.md."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding
from mechwright.errors import ProgramError
from mechwright.output.csv_text import csv_text
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.dialect import ROUGH, Arcs, Corners, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.offsets import OffsetTables, WorkOffsets
from mechwright_cam.controls.reading import klartext
from mechwright_cam.controls.words import klartext as words
from mechwright_cam.controls.writing.klartext import KlartextWriter, numbered, signed
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Program, ToolSection
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import comment_lines, floored, number

if TYPE_CHECKING:
    from mechwright_cam.shop.machine import Machine

EXACT = 0.001
"""What takes the place of exact stops, which Klartext has no word for, mm: the last decimal."""
IN_INCHES = 5
"""Decimals of a tolerance in inches."""
PRESETS = WorkOffsets("G54 to G59", r"G(5[4-9])", "row {} of the preset table", 53)


class HeidenhainTnc(GcodeControl):
    """Klartext: TOOL CALL, L, CC and C, CP for helices, M91 for retracts, cycles 247, 9 and 32.

    No machining cycles and no cutter compensation: holes are written out, paths are the tool centre's.
    """

    name = "heidenhain-tnc"
    title = "HEIDENHAIN TNC"
    suffix = ".h"
    dialect = Dialect(
        calls="98",
        words=words.INTERPRETED,
        kept=words.KEPT,
        translate=klartext.translated,
        text=Text(longest=4 * words.LONGEST, percent=False),
        # The machine parameter of circles allows no more.
        arcs=Arcs(absolute=0.016, relative=0.0, chord=0.0),
        stops_behind=True,
        length_write=None,
        decimals=3,
        decimals_inch=4,
        change_stops_coolant=True,
        # Without cycle 32 the machine's own tolerance holds, with it T alone.
        corners=Corners(tolerance=True),
    )
    offsets = OffsetTables(d=None)
    no_compensation = "is written and read here without cutter compensation (RL, RR)"
    work_offsets = (PRESETS,)
    no_length = "TOOL CALL 0 Z"
    stages = True
    subprograms = "behind"
    highest_tool = 32767
    forbidden = "~;"
    tolerances = (ROUGH, TOLERANCES.arc_fit, EXACT)
    takes_back = "select the program anew, and look that the status display shows none"

    def writer(self, program: Program) -> Writer:
        """A writer of blocks."""
        return KlartextWriter(program, self.decimals, self.scale)

    def finished(self, out: Writer) -> list[str]:
        """Blocks are numbered one by one, whatever step is asked for."""
        return numbered(out.lines)

    def frame(self, out: Writer) -> None:
        """The first block."""
        out.line(f"BEGIN PGM {out.program.name} {self._unit}")

    def end(self, out: Writer) -> None:
        """The end, and the last block."""
        super().end(out)
        out.line(f"END PGM {out.program.name} {self._unit}")

    @property
    def _unit(self) -> str:
        return "INCH" if self.units == "inch" else "MM"

    @property
    def unit_word(self) -> str:
        """The unit that BEGIN PGM names."""
        return f"BEGIN PGM {self._unit}"

    def safe_start(self, out: Writer) -> None:
        """The preset, and how far corners are rounded; BEGIN PGM brings all other modes back."""
        if not out.program.more_offsets:  # else each is put in force before its work
            self._preset(out, out.program.work_offset)
        out.corners = self.blending(out.program.posting.exact_stop)
        self.corner_lines(out, out.corners)

    def _preset(self, out: Writer, offset: str) -> None:
        """A row of the preset table in force."""
        out.line("CYCL DEF 247 DATUM SETTING ~")
        out.line(f"Q339={signed(str(PRESETS.place(offset)))} ;DATUM NUMBER")

    def take_offset(self, out: Writer, section: ToolSection, *, turns: bool) -> None:
        """The preset, and the spindle unless it turns."""
        self._preset(out, out.offset)
        if not turns:
            self._offset_and_spindle(out, section)

    def subprogram_number(self, out: Writer, number: int) -> int:  # noqa: ARG002 - labels are of one program
        """From 1 on: older controls have 254."""
        return number

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """The label of a number."""
        return f"LBL {self.subprogram_number(out, number)}"

    def subprogram_ends(self, out: Writer, number: int) -> str:  # noqa: ARG002 - there is one
        """The label that ends all subprograms."""
        return "LBL 0"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """Once."""
        return f"CALL LBL {self.subprogram_number(out, number)}"

    def corner_lines(self, out: Writer, words: Sequence[str]) -> None:
        """A cycle of two blocks."""
        for line in words:
            out.line(line)

    dwell_words = "cycle 9 waits in seconds"
    bound_words = "T of cycle 32"
    rounding_words = f"CYCL DEF 32.1 T{TOLERANCES.arc_fit:g} (in mm)"
    exact_words = f"T{EXACT:g}"

    def blending(self, exact: bool) -> list[str]:
        """Cycle 32 bounds how far the control leaves the path."""
        return self.rounding(EXACT if exact else TOLERANCES.arc_fit)

    def rounding(self, tolerance: float) -> list[str]:
        """Cycle 32 with T."""
        digits = self.decimals if self.units == "mm" else IN_INCHES
        value = number(floored(max(tolerance, EXACT) / self.scale, digits), digits)
        return ["CYCL DEF 32.0 TOLERANCE", f"CYCL DEF 32.1 T{value}"]

    def restate(self, out: Writer) -> None:
        """At a restart point the speed is stated anew as well."""
        super().restate(out)
        out.speed = ""

    def retract_lines(self, z: float) -> Sequence[str]:
        """Machine coordinates for one block, in which the tool's length does not count."""
        return (f"L Z{signed(self.length(z))} R0 FMAX M91",)

    def change_words(self, tool: int) -> str:
        """What changes to a tool."""
        return f"TOOL CALL {tool} Z"

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """The tool, its axis and its speed; length and radius come with it."""
        out.speed = f"S{section.spindle:.0f}"
        out.line(self.change_words(section.tool.number), out.speed)

    def _start_spindle(self, out: Writer, section: ToolSection, *words: str) -> None:  # noqa: ARG002 - the preset holds
        """M3; the speed is that of TOOL CALL, and is stated anew where it may be another."""
        speed = f"S{section.spindle:.0f}"
        if out.speed != speed:
            out.line("TOOL CALL Z", speed)
            out.speed = speed
        out.line(self.m(4 if section.tool.left_hand else 3))
        if out.program.machine.spindle_delay > 0:
            self.dwell(out, out.program.machine.spindle_delay)

    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:  # noqa: ARG002
        """TOOL CALL has put the length in force."""
        out.line(out.motion_word("G0"), *out.axis_words(None, None, z, rapid=True))

    def length_words(self, tool: int | str) -> str:
        """What puts a tool's length in force."""
        return f"TOOL CALL {tool} Z".replace("  ", " ")

    def length_place(self, tool: int | str) -> str:
        """Where a tool's length stands."""
        return f"L of T{tool}"

    def rapid_words(self, z: str) -> str:
        """A rapid to a height."""
        return f"L Z{signed(z)} R0 FMAX"

    def offset_words(self, offset: str) -> str:
        """A row of the preset table."""
        return f"preset {PRESETS.place(offset)}" if PRESETS.has(offset) else offset

    def height_words(self, offset: str, value: str) -> str:
        """What sets the Z of a work offset."""
        return f"Z in {self.setting_words(offset)} = {value}"

    def tool_note(self, tool: Tool) -> str:
        """Without an H number."""
        return super().tool_note(tool).replace(f" H{tool.number} ", " ", 1)

    def comment(self, out: Writer, text: str) -> None:
        """Write a comment, as many blocks as it takes."""
        for line in comment_lines(text, forbidden=self.forbidden):
            out.line(f"; {line}")

    def drill(self, out: Writer, hole: Drill) -> None:
        """No cycles: what they do hangs on their version."""
        self.drill_in_moves(out, hole)

    def dwell(self, out: Writer, seconds: float) -> None:
        """Wait; a cycle of two blocks."""
        out.line("CYCL DEF 9.0 DWELL TIME")
        out.line(f"CYCL DEF 9.1 DWELL {number(seconds, 3)}")

    def set_offsets(self, out: Writer) -> None:
        """Raise ProgramError: the preset table is the operator's."""
        raise ProgramError(f"program {out.program.name}: {self._sets_none}; leave post.offsets out")

    @property
    def _sets_none(self) -> str:
        return f"{self.title} programs write no row of the preset table here: the sheet says what to type in"

    def check(self, settings: CamSettings) -> Sequence[Finding]:
        """As others, offsets that the program should set, and steps of its numbers."""
        found = list(super().check(settings))
        if settings.post.offsets:
            remedy = "leave offsets out"
            found.append(Finding.error("cam.offsets", "cam.post.offsets", self._sets_none, remedy=remedy))
        if settings.post.line_numbers:
            said = f"{self.title} numbers its blocks from 0 one by one, and has no other step"
            remedy = "leave line_numbers out"
            found.append(Finding.error("cam.line-numbers", "cam.post.line_numbers", said, remedy=remedy))
        return found

    def retract_words(self, machine: "Machine") -> str:
        """What goes to the upper end of a machine."""
        return self.retract_lines(self.upper_end(machine))[0]

    def needs(self, settings: CamSettings) -> Sequence[str]:
        """Presets without turns, tools without deltas, machine Z of the retract, feeds in inches."""
        offsets = ", ".join(map(self.offset_words, settings.offsets))
        said = [
            f"The program takes {offsets} (CYCL DEF 247): its columns SPA, SPB and SPC (ROT) have to be 0.",
            "Length and radius come from the tool table at TOOL CALL: DL, DR and DR2 there are wear "
            "alone, at first 0.",
            f"{self.retract_words(settings.machine)} goes to machine Z, without the tool's length: it has to "
            "be the upper end within the travel (cam.machine.retract_z).",
        ]
        if self.units == "inch":
            said.append("F is in tenths of an inch a minute, as in programs with INCH; tables are in inches.")
        return said

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``heidenhain-tools.csv``: what to type into the tool table, by the names of its columns."""
        table: list[list[object]] = [["T", "NAME", "L", "R", "R2", "DL", "DR", "DOC"]]
        for place, tool in sorted({tool.number: tool for tool in tools}.items()):
            length = "" if tool.length is None else self._said(tool.worn_length)
            nose = self._said(tool.nose)
            table.append(
                [place, tool.name.upper(), length, self._said(tool.radius), nose, 0, 0, str(tool.kind)]
            )
        return "heidenhain-tools.csv", csv_text(table)
