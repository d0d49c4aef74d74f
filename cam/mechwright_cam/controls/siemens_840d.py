"""Siemens SINUMERIK 840D sl and its kin (828D, ONE), in their own language: see docs/controls.md."""

import hashlib
import re
from collections.abc import Mapping, Sequence

from mechwright.output.csv_text import csv_text
from mechwright_cam.controls.dialect import EXACT, Arcs, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.offsets import OffsetTables, WorkOffsets
from mechwright_cam.controls.reading import sinumerik
from mechwright_cam.controls.words import sinumerik as words
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Program, ToolSection
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import comment_lines, number

G54_TO_G57 = WorkOffsets("G54 to G57", r"G(5[4-7])", "$P_UIFR[{}]", 53)

LONGEST_NAME = 24
"""Characters of a program's name (Programming Manual NC programming, "Name of an NC program")."""
DIGEST = 4
"""Characters that tell names apart whose ends are cut off: of 65,536 pairs one is alike, and refused."""


def program_identifier(name: str) -> str:
    """The name of a program as the control takes it: 24 letters, digits and _ at most, two letters first.

    The end of a longer name gives way to a digest of the whole.

    >>> program_identifier("crank-1"), program_identifier("1-gear"), program_identifier("a_b")
    ('crank_1', 'P_1_gear', 'P_a_Ub')
    >>> program_identifier("driver-locking-disc-underside")
    'driver_locking_disc_9D54'
    """
    found = name.replace("_", "_U").replace("-", "_")
    if not re.match(r"[A-Za-z]{2}", found):
        found = f"P_{found}"
    if len(found) <= LONGEST_NAME:
        return found
    digest = hashlib.sha256(name.encode()).hexdigest()[:DIGEST].upper()
    return f"{found[: LONGEST_NAME - DIGEST - 1].rstrip('_')}_{digest}"


class Siemens840D(GcodeControl):
    """SINUMERIK 840D: tools by T and M6, lengths by D1, retracts by SUPA with D0, G710 and G700 for units.

    No cycles and no cutter compensation: holes are written out, and paths are those of the tool's centre.
    """

    name = "siemens-840d"
    title = "SINUMERIK 840D"
    suffix = ".mpf"
    dialect = Dialect(
        calls="98",
        words=words.INTERPRETED,
        kept=words.KEPT,
        translate=sinumerik.translated,
        text=Text(longest=sinumerik.LONGEST, percent=False),
        arcs=Arcs(absolute=0.01, chord=0.0),  # MD 21000; MD 21010 is the part of the radius
        length_write=None,
        decimals=3,
        decimals_inch=4,
        change_stops_coolant=True,
        corners=EXACT,  # how far G64 rounds corners, machine data say
    )
    offsets = OffsetTables(d=None)
    no_compensation = "is written and read here without cutter compensation (G41, G42)"
    work_offsets = (G54_TO_G57,)
    no_length = "D0"
    stages = True
    subprograms = "behind"
    highest_tool = 32000
    forbidden = '%;"$'
    modes = ("G17", sinumerik.METRIC, "G40", "G90", "G94", "COMPOF")
    takes_back = "press Reset, and look that the frames but G54 to G57 are 0"

    @property
    def unit_word(self) -> str:
        """G710 and G700, which hold for feeds and offsets as well."""
        return sinumerik.INCHES if self.units == "inch" else sinumerik.METRIC

    def files(self, program: Program) -> dict[str, str]:
        """One file, whose name the control takes: letters, digits and _, and two letters first."""
        return {program_identifier(program.name): self.write(program)}

    def stems(self, name: str, tools: Sequence[Tool]) -> Sequence[str]:  # noqa: ARG002
        """The name that the control takes."""
        return (program_identifier(name),)

    def retract_lines(self, z: float) -> Sequence[str]:
        """Machine coordinates for one block, without the tool's length."""
        return (f"G0 SUPA Z{self.length(z)} D0",)

    def machine_words(self) -> Sequence[str]:
        """The words before axes that are machine coordinates."""
        return ("G0", "SUPA")

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """The label at its beginning."""
        return f"SUB_{self.subprogram_number(out, number)}:"

    def subprogram_ends(self, out: Writer, number: int) -> str:
        """The label at its end."""
        return f"SUB_{self.subprogram_number(out, number)}_END:"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """The blocks between both labels are run as a subprogram."""
        one = f"SUB_{self.subprogram_number(out, number)}"
        return f"CALL BLOCK {one} TO {one}_END"

    def change_words(self, tool: int) -> str:
        """What changes to a tool."""
        return f"T{tool}, then {self.m(6)}"

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """T, which may have been made ready, and the change in a block of its own."""
        out.line(f"T{section.tool.number}")
        out.line(self.m(6))

    def length_words(self, tool: int | str) -> str:  # noqa: ARG002 - D counts the edges of the tool in the spindle
        """What puts a tool's length in force: its first edge."""
        return "D1"

    def length_place(self, tool: int | str) -> str:  # noqa: ARG002
        """Where a tool's length stands: its first edge."""
        return "D1"

    def tool_note(self, tool: Tool) -> str:
        """Without an H number."""
        return super().tool_note(tool).replace(f" H{tool.number} ", " ", 1)

    def comment(self, out: Writer, text: str) -> None:
        """Write a comment, as many lines as it takes."""
        for line in comment_lines(text, forbidden=self.forbidden):
            out.line(f"; {line}")

    def message(self, out: Writer, text: str) -> None:
        """Show a message on the control's screen."""
        for line in comment_lines(text, forbidden=self.forbidden):
            out.line(f'MSG("{line}")')

    dwell_words = "F of G4 is in seconds"
    exact_words = "G60"

    def blending(self, exact: bool) -> list[str]:
        """G60 stops at every corner; G64 keeps moving."""
        return ["G60" if exact else "G64"]

    def drill(self, out: Writer, hole: Drill) -> None:
        """No cycles: what they do hangs on their version."""
        self.drill_in_moves(out, hole)

    def dwell(self, out: Writer, seconds: float) -> None:
        """Wait; F is in seconds here."""
        out.line("G4", "F" + number(seconds, 3))

    def height_words(self, offset: str, value: str) -> str:
        """What sets the Z of a work offset."""
        return f"{self.setting_words(offset)[:-1]},Z,TR]={value}"

    def write_offset(self, offset: str, places: Mapping[str, float]) -> str:
        """A frame with all three axes; fine offset and turn become 0."""
        axes = ",".join(f"{axis},{self.length(value)}" for axis, value in places.items())
        return f"{self.setting_words(offset)}=CTRANS({axes})"

    def tool_words(self, tool: Tool) -> list[str]:  # noqa: ARG002 - T numbers of the tool list are the machine's own
        """Lengths are entered into the tool list."""
        return []

    def needs(self, settings: CamSettings) -> Sequence[str]:  # noqa: ARG002
        """Tools by number, machine Z of the retract."""
        return [
            "Tools are called by number (T3): where the tool list has names, name each tool by its number.",
            "G0 SUPA Z goes to machine Z, without frames and tool length: it has to be the upper end.",
        ]

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``siemens-tools.csv``: what to type into the tool list; D1 holds length and radius."""
        unit = "" if self.units == "mm" else " in"
        table: list[list[object]] = [["tool", "edge", "description", f"length 1{unit}", f"radius{unit}"]]
        for place, tool in sorted({tool.number: tool for tool in tools}.items()):
            length = "" if tool.length is None else self._said(tool.worn_length)
            table.append([place, "D1", f"{tool.name} {tool.kind}", length, self._said(tool.radius)])
        return "siemens-tools.csv", csv_text(table)
