"""Fanuc controls (0i, 30i and their kin) with custom of the trade: see docs/controls.md."""

from collections.abc import Sequence

from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Corners, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.offsets import FANUC_OFFSETS, G54_TO_G59, DOffset, OffsetTables
from mechwright_cam.controls.words import fanuc as words
from mechwright_cam.controls.writing.drilling import EVERY_WAY
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Tap
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import comment_lines

OFFSETS_NUMBER = 7999
"""O number of the file of tool lengths: from 8000 on, programs are commonly locked against editing."""
SUBPROGRAMS = 100
"""So many O numbers belong to each program of a job: O0102 is the second subprogram of O0001."""


class Fanuc(GcodeControl):
    """Fanuc: percent signs and an O number, retract by G91 G28, numbers with a point, P in milliseconds.

    Milling, offset memory C, conventional decimal point.
    """

    name = "fanuc"
    title = "Fanuc"
    dialect = Dialect(
        calls="98",
        words=words.WORDS,
        kept=words.KEPT,
        text=Text(
            semicolon_comments=False,
            ascii_comments=True,
            capitals=True,
            percent_ends=False,
            program_numbers=True,
        ),
        tapping="M29",
        bare_dwell_unit=0.001,
        peck_clearance=1.0,
        decimals=3,
        decimals_inch=4,
        arc_entry=False,
        idle_most=1,
        home_cancels_length=True,
        length_moves="parameter 5006, bit 6",
        length_write=(10, "R"),
        one_unit=True,
        change_stops_coolant=True,
        # G64 and no word at all are rounded by the machine's parameters; R of G5.1 may ask for speed, and
        # with Q2 or more it puts curves through the places of the program.
        corners=Corners(
            looser=(
                (51, "R", frozenset({10.0}), "write R10 (precision), or leave the level to the machine"),
                (51, "Q", frozenset({0.0, 1.0}), "write Q1 (look ahead) or Q0"),
                (80, "P", frozenset({0.0, 1.0}), "write P1 (look ahead) or P0"),
            )
        ),
    )
    takes_back = "look that the common offset (EXT) is 0, and G15, G50, G50.1, G67 and G69 in force"
    offsets = OffsetTables(d="setting", d_setting="commonly parameter 5004, bit 2", wear=True)
    work_offsets = (G54_TO_G59, FANUC_OFFSETS)
    stages = True
    subprograms = "behind"
    taps = EVERY_WAY
    tap_needs = (
        "M29 has to be the machine's code of rigid tapping (parameter 5210; the builder may have another)."
    )
    capitals = True
    retract_motion = ""
    dwell_words = "P without a decimal point is in milliseconds"
    forbidden = '%;@&!?"<>{}|\\^`~$'

    def frame(self, out: Writer) -> None:
        """Percent sign and program number."""
        out.line("%")
        name = "".join(comment_lines(out.program.name, forbidden=self.forbidden, upper=True)[:1])
        out.line(f"O{out.program.posting.program_number:04d}", f"({name})")

    def retract_lines(self, z: float) -> Sequence[str]:  # noqa: ARG002 - the reference point is the control's
        """To the reference point of Z, from where the tool stands: G91 makes that the way."""
        return f"G91 G28 Z{self.length(0.0)}", "G90"

    def restate(self, out: Writer) -> None:
        """Without G49, which may move Z by the tool's length where it stands; the next G43 replaces it."""
        if not self.dialect.length_moves:
            super().restate(out)
            return
        self.end_drilling(out)
        out.line(*(word for word in self.safe_modes if word != self.no_length))
        self.take_default_corners(out)
        self.retract(out)

    def subprogram_number(self, out: Writer, number: int) -> int:
        """An O number of its own, which no other program of the job has."""
        own = out.program.posting.program_number * SUBPROGRAMS + number
        if number >= SUBPROGRAMS or own >= OFFSETS_NUMBER:
            raise ProgramError(
                f"cam.post.program_number: subprograms of O{out.program.posting.program_number:04d} would be "
                f"O{own}, and {OFFSETS_NUMBER - 1} is the highest; use at most "
                f"{OFFSETS_NUMBER // SUBPROGRAMS - 1}"
            )
        return own

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """Its O number, as four digits."""
        return f"O{self.subprogram_number(out, number):04d}"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """M98 with its number."""
        return f"M98 P{self.subprogram_number(out, number):04d}"

    def tap(self, out: Writer, hole: Tap) -> None:
        """M29 before the cycle keeps feed and spindle together; a floating holder does without."""
        rigid = () if out.tapping.floating else (self.dialect.tapping, out.speed)
        self.tap_cycle(out, hole, before=rigid)

    def end(self, out: Writer) -> None:
        """End, rewind, and the closing percent sign."""
        super().end(out)
        out.line("%")

    def tool_words(self, tool: Tool) -> list[str]:
        """The length as geometry offset (offset memory C)."""
        return [f"G10 L10 P{tool.number} R{self.length(tool.length or 0.0)}"]

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """A program that sets the lengths that have been measured; none if none has."""
        return self._offsets_file(tools, ())

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same, and the D offsets: geometry (L12) as planned, wear (L13) 0."""
        return self._offsets_file(tools, self.offsets.of_tools(tools, settings))

    def needs(self, settings: CamSettings) -> Sequence[str]:  # noqa: ARG002
        """Offsets that were typed in under the other units may be taken as they stand."""
        if self.units == "mm":
            return []
        return [
            "The offsets are typed in inches: whether those of metric jobs are converted, a parameter of the "
            "machine says (5006, bit 0)."
        ]

    def table_words(self, table: str) -> str:
        """What to do with the file of offsets."""
        return (
            f"{table} is a program: run it once for new cutters, and H and D are set as far as known."
            " Run again later it takes back what was corrected at the machine."
        )

    def _offsets_file(self, tools: Sequence[Tool], offsets: Sequence[DOffset]) -> tuple[str, str]:
        measured = {tool.number: tool for tool in tools if tool.length is not None}
        if not measured and not offsets:
            return "", ""
        what = "TOOL LENGTHS, RUN ONCE"
        if offsets:
            what = f"TOOL LENGTHS, {offsets[0].quantity.upper()} IN D, RUN ONCE FOR NEW CUTTERS"
        lines = [
            "%",
            f"O{OFFSETS_NUMBER:04d}",
            f"({what})",
            f"{self.unit_word} G90",
        ]
        for _, tool in sorted(measured.items()):
            lines += self.tool_words(tool)
            if tool.wear_length:
                lines.append(f"G10 L11 P{tool.number} R{self.length(tool.wear_length)}")
        for offset in sorted(offsets, key=lambda offset: offset.number):
            value = self.length(offset.planned)
            lines.append(f"G10 L12 P{offset.number} R{value}")
            lines.append(f"G10 L13 P{offset.number} R{self.length(offset.wear)}")
        return "tool-offsets.nc", "\n".join([*lines, self.m(30), "%"]) + "\n"
