"""Mach3 mill, by common practice; G4 in seconds."""

from collections.abc import Mapping, Sequence

from mechwright.output.csv_text import csv_text
from mechwright_cam.controls.contract import METRIC
from mechwright_cam.controls.dialect import EXACT, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.words import mach3 as words
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Program, Tap
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool


class Mach3(GcodeControl):
    """Mach3: arcs by G91.1, G53 retracts, a tool change that runs the machine's own macro."""

    name = "mach3"
    title = "Mach3"
    dialect = Dialect(
        stored_homes=frozenset({"G28", "G30"}),
        calls="98",
        words=words.WORDS,
        kept=words.KEPT,
        text=Text(semicolon_comments=False),
        corners=EXACT,  # constant velocity (G64) rounds corners as the settings of the machine say
    )
    subprograms = "behind"
    taps = frozenset({"floating"})
    forbidden = "%;"
    highest_tool = 254
    takes_back = "type G15, G92.1, G50 and G69 before zero is set"
    modes = ("G17", METRIC, "G40", "G49", "G80", "G90", "G91.1", "G94")

    def subprogram_call(self, out: Writer, number: int) -> str:
        """M98, once."""
        return super().subprogram_call(out, number) + " L1"

    def head(self, out: Writer) -> None:
        """Tell the setting that the program relies on, where it does."""
        super().head(out)
        if _waits(out.program):
            self.comment(out, "dwells are in seconds: G04 dwell in ms must be off")

    def needs(self, settings: CamSettings) -> Sequence[str]:  # noqa: ARG002
        """Its tool table is in the units that it was set up with."""
        said = "The lengths in the table are in inches: so have to be the native units of the profile."
        return [said] if self.units == "inch" else []

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``mach3-tools.csv``: what to type into the tool table, which is binary itself."""
        return self._table({tool.number: (tool, tool.diameter, "") for tool in tools})

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same with the diameters that D takes: an own row where D has a number of its own."""
        return self._table(self.offsets.rows(tools, settings))

    def _table(self, rows: Mapping[int, tuple[Tool, float, str]]) -> tuple[str, str]:
        unit = "" if self.units == "mm" else " in"
        table: list[list[object]] = [["tool", "description", f"diameter{unit}", f"height{unit}"]]
        for place, (tool, diameter, note) in sorted(rows.items()):
            height = "" if tool.length is None else self._said(tool.worn_length)
            words = ", ".join(filter(None, (f"{tool.name} {tool.kind}", note)))
            table.append([place, words, self._said(diameter), height])
        return "mach3-tools.csv", csv_text(table)


def _waits(program: Program) -> bool:
    moves = (m for section in program.sections for operation in section.operations for m in operation.moves)
    return program.machine.spindle_delay > 0 or any(isinstance(m, Drill | Tap) and m.dwell > 0 for m in moves)
