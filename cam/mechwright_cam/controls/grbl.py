"""Grbl 1.1, from its documents and sources."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby

from mechwright.contracts.finding import Finding, Severity
from mechwright_cam.controls.contract import METRIC
from mechwright_cam.controls.dialect import EXACT, Arcs, Dialect, Text
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.offsets import OffsetTables
from mechwright_cam.controls.words import grbl as words
from mechwright_cam.controls.writing.measuring import Measuring
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Program, ToolSection
from mechwright_cam.program.touches import ToolTouches, Touches
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import GRBL_COMMENT_WIDTH, GRBL_REALTIME

BELOW_SWITCH = -2.0
"""Machine Z of a retract, mm: the pull-off of homing ($27) is 1 mm as it comes."""
MOST_TURNS = 4
"""Turns of a tool, on average, for which names of files are compared before anything is planned."""
SENDERS = (
    "UGS, bCNC, gSender and OpenBuilds CONTROL take the files as they are, one after the other. None has "
    "a tool change (M6), so their windows for it stay shut.",
    "cncjs: upload a file, wait for its box, press run. Candle: one file at a time; its comments are short.",
    "A pendant with a card takes .nc files with short names: one file for each tool, nothing else beside it.",
)
"""What each sender asks for, for the sheet."""


class Grbl(Measuring, GcodeControl):
    """Grbl: no tool change, no cycles, no table of lengths; arcs by I and J only; lines of 79 characters.

    Tools are changed by hand, between files of one tool each: at a stop (M0) Grbl reads nothing but the word
    to go on, so it can neither jog nor probe, and a new tool cannot be touched off. A tool whose length is
    known gets it by G43.1; where one is not, every tool is touched off on the stock anew.
    """

    name = "grbl"
    title = "Grbl 1.1"
    dialect = Dialect(
        stored_homes=frozenset({"G28", "G30"}),
        words=words.WORDS,
        kept=words.KEPT,
        text=Text(
            longest=79,  # the buffer has 80 bytes, and the last of them ends the line
            counts_code=True,
            ascii_comments=True,  # it obeys bytes from 128 up wherever they stand: overrides of feed, speed
            forbidden=GRBL_REALTIME,
            digits=8,  # MAX_INT_DIGITS
            percent=False,
        ),
        arcs=Arcs(
            absolute=0.005,
            most=0.5,
            chord=-1e-4,  # single precision, at machine coordinates of up to 1 m
            least_turn=1e-6,  # ARC_ANGULAR_TRAVEL_EPSILON is 5e-7, in single precision
        ),
        decimals=3,
        tool_by_t=True,
        length_write=None,
        corners=EXACT,  # the path is always followed: junction deviation ($11) slows down, and rounds nothing
    )
    offsets = OffsetTables(lengths=False, length_word="G43.1", d=None)
    forbidden = "%$;" + GRBL_REALTIME
    comment_width = GRBL_COMMENT_WIDTH
    highest_tool = 255
    by_hand = "files"
    takes_back = "type G92.1 before zero is set"
    modes = ("G17", METRIC, "G40", "G49", "G80", "G90", "G91.1", "G94")

    def files(self, program: Program) -> dict[str, str]:
        """A file for each change of tool, or the program with a stop for each."""
        if (program.posting.tool_change or self.by_hand) == "pause":
            return super().files(program)
        posting = program.posting.model_copy(update={"tool_change": "files"})
        runs = [list(run) for _, run in groupby(program.sections, key=lambda section: section.tool.number)]
        files = {}
        for place, run in enumerate(runs, start=1):
            note = f"file {place} of {len(runs)}, {self._load(run[0], program)}"
            name = f"{program.name}-{place}-t{run[0].tool.number}"
            one = replace(
                program, name=name, sections=tuple(run), notes=(*program.notes, note), posting=posting
            )
            files[name] = self.write(one)
        return files

    def stems(self, name: str, tools: Sequence[Tool]) -> Sequence[str]:
        """One for each tool wherever it comes in turn, and the program's own where it stops for a change."""
        numbers = sorted({tool.number for tool in tools})
        turns = range(1, MOST_TURNS * len(numbers) + 1)
        one_tool = [f"{name}-t{number}" for number in numbers]
        return [name, *one_tool, *(f"{name}-{turn}-t{number}" for turn in turns for number in numbers)]

    def check(self, settings: CamSettings) -> Sequence[Finding]:
        """Also: the retract must stay off the homing switch, and mist is an option of the build."""
        found, height = list(super().check(settings)), self.upper_end(settings.machine)
        if settings.machine.homed and height >= 0:
            where, message = "cam.machine.retract_z", "machine Z0 is where the homing switch is"
            remedy = "retract below it, by more than the pull-off ($27), such as -2"
            found.append(Finding.warning("cam.retract", where, message, height, 0.0, "mm", remedy))
        if settings.coolant == "mist":
            message = "M7 is read by a Grbl built with ENABLE_M7 alone; others stop with error 20"
            remedy = 'use coolant = "flood" (M8) or "off", if yours is not'
            found.append(Finding("cam.coolant", Severity.NOTE, "cam.coolant", message, remedy=remedy))
        return found

    def check_zero(self, settings: CamSettings) -> Sequence[Finding]:
        """Without switches its machine zero is where it was switched on: no mark sets it."""
        if not settings.machine.homed and settings.more_offsets:
            lack = "without machine zero there is no known way up between two work zeros"
            remedy = "leave more_offsets out, and run the program anew at each zero"
            return [Finding.error("cam.homing", "cam.more_offsets", lack, remedy=remedy)]
        if settings.machine.homing != "marks":
            return super().check_zero(settings)
        lack = f"{self.title} sets machine zero by switches ($H) alone, and not at marks"
        remedy = 'write homing = "none": programs then go by the work offset'
        return [Finding.error("cam.homing", "cam.machine.homing", lack, remedy=remedy)]

    def needs(self, settings: CamSettings) -> Sequence[str]:
        """Homing, or what stands in for it; the scale of S; senders; a build with mist."""
        machine = settings.machine
        if machine.homed:
            said = [
                "Home the machine first ($22=1, then $H): G53 goes to machine coordinates, which without "
                "homing are those of where it was switched on."
            ]
        else:
            said = [
                "The programs use the work zero alone: no homing ($22=0), no soft limits ($20=0).",
                "Type $1=255 before zero is set: the motors then hold the axes while a tool is changed.",
                "The zero is lost with the power, by a reset in motion and by an alarm, though $# still "
                "shows it: set X, Y and Z anew.",
            ]
        if machine.speed_by_hand:
            said.append("Speeds are set at the spindle's dial: S does nothing.")
        else:
            said.append(
                f"Type $30={machine.spindle_max:g} and $31=0: S is in rev/min, and at another $30 the "
                "spindle turns at another speed."
            )
        said += SENDERS
        if not machine.homed:
            said.append(
                "Do not press the home button of cncjs or Candle: it sends $H, which is error 5 without "
                "switches. Set zero by G10 L20 P1, or by the zero buttons."
            )
        if settings.coolant == "mist":
            said.append("Mist (M7) takes a Grbl that was built with ENABLE_M7; others stop with error 20.")
        return said

    def check_tools(self, settings: CamSettings, tools: Sequence[Tool]) -> Sequence[Finding]:
        """A tool that is loaded at a stop has to have a known length."""
        taps = super().check_tools(settings, tools)
        known = [tool.name for tool in tools if tool.length is not None]
        if known and not settings.machine.homed:
            message = (
                f"a length of {known[0]} is given, and without machine zero every tool is touched off anew"
            )
            remedy = "leave the lengths out"
            taps = [*taps, Finding.error("cam.homing", "cam.measured.lengths", message, remedy=remedy)]
        unknown = [tool.name for tool in tools if tool.length is None]
        if settings.post.tool_change != "pause" or not unknown:
            return taps
        names, lengths = ", ".join(unknown), "[cam.measured.lengths]"
        message = f"at a stop (M0) Grbl can neither jog nor probe, so {names} cannot be touched off there"
        remedy = f"leave tool_change out for one file per tool, or give their lengths in {lengths}"
        return [*taps, Finding.warning("cam.tool-change", "cam.post.tool_change", message, remedy=remedy)]

    counts = False  # its parameters are told to the sender alone

    def cannot_probe(self, tools: Sequence[Tool]) -> str:
        """Z0 would be that of the probe, which no measured length of a cutter fits."""
        if any(tool.length is not None for tool in tools):
            return f"{self.title} has tool lengths in its programs, and not the probe's; set the zero by hand"
        return ""

    def cannot_measure(self, tools: Sequence[Tool]) -> str:
        """A length that stands in the program is not one that is set at the machine."""
        if any(tool.length is not None for tool in tools):
            return f"{self.title} has tool lengths in its programs: leave those, or the setter, out"
        return ""

    def measure(self, touches: ToolTouches, machine: Machine) -> dict[str, str]:
        """A program for each tool, to be run when it has been put in: there is one Z for all of them."""
        return {
            name: self.measuring(touches, machine, name, [(tool, said)])
            for tool, said in touches.tools
            for name in [f"{touches.name}-t{tool}"]
        }

    def take_tool(self, out: Writer, tool: int, said: str) -> None:
        """It is put in before the program starts."""
        self.comment(out, f"T{tool} {said} has been put in; run this again whenever it has been put in anew")

    def length_lines(self, touches: ToolTouches, tool: int) -> Sequence[str]:  # noqa: ARG002 - one Z for all
        """The Z of the work offset, for the tool in the spindle."""
        setting = self.setting_words(touches.offsets[0]).replace("G10 L2 ", "G10 L20 ")
        return [f"{setting} Z{self.length(touches.over)}"]

    def take_probe(self, out: Writer, touches: Touches) -> None:  # noqa: ARG002 - it is in the spindle
        """It is put in before the program starts."""
        self.comment(out, "put the probe into the spindle before the start; touch off each tool afterwards")

    def probe_length(self, out: Writer, touches: Touches) -> None:
        """No length: tools are touched off one by one."""
        out.line("G49")
        out.line(f"G0 Z{self.length(touches.high)}")

    def blending(self, exact: bool) -> list[str]:
        """Grbl always follows the path exactly; it knows G61 only."""
        return ["G61"] if exact else []

    def upper_end(self, machine: Machine) -> float:
        """Below the homing switch, which is at machine Z0; where the machine says another, there."""
        return machine.retract_z if "retract_z" in machine.model_fields_set else BELOW_SWITCH

    def retract_words(self, machine: Machine) -> str:
        """What goes to the upper end of a machine, off the homing switch."""
        words = super().retract_words(machine)
        if self.upper_end(machine) >= 0:
            words += ", after setting cam.machine.retract_z below the homing switch, such as -2"
        return words

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Name the tool, and wait for it unless it is in a file of its own, or in the spindle."""
        if section.tool.number == out.tool:
            return
        out.tool = section.tool.number
        if not out.program.machine.homed:
            out.line(out.program.work_offset)
        out.line(f"T{section.tool.number}")
        if not out.program.machine.homed:
            self.retract(out)
        if out.program.posting.tool_change != "files":
            self.message(out, self._load(section, out.program))
            out.line(self.m(0))
            self.retract(out)  # whoever has touched off has left the tool low

    def _load(self, section: ToolSection, program: Program) -> str:
        tool = section.tool
        at = f" of {self.zeros(program)}, each on its own stock" if program.more_offsets else ""
        touch = "" if tool.length is not None else f", touch it off on the stock as Z0{at}"
        return f"load T{tool.number} {tool.name}{touch}"

    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:
        """Write the length itself, or rely on the tool having been touched off."""
        if section.tool.length is None:
            out.line("G49")
        else:
            out.line(self.offsets.length_word, "Z" + out.length(section.tool.worn_length))
        out.line(out.motion_word("G0"), *out.axis_words(None, None, z, rapid=True))

    def drill(self, out: Writer, hole: Drill) -> None:
        """There are no cycles."""
        self.drill_in_moves(out, hole)

    def tool_words(self, tool: Tool) -> list[str]:  # noqa: ARG002 - there is no table to set
        """Lengths stand in the program."""
        return []

    def tool_note(self, tool: Tool) -> str:
        """Without an H number."""
        return super().tool_note(tool).replace(f" H{tool.number} ", " ", 1)

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:  # noqa: ARG002
        """There is none."""
        return "", ""
