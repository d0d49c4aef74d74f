"""What all controls share that read RS274 words: a program from its first line to its last, and back.

A control is a subclass that says how it spells what differs, and how it reads (``dialect``).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

from mechwright.contracts.finding import Finding
from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.read import interpret_files
from mechwright_cam.controls.reading.run import Run
from mechwright_cam.controls.writing.subprograms import RESTARTS_NONE, Subprograms
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Program, Rapid
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind


class GcodeControl(Subprograms):
    """A control that reads RS274 words."""

    no_compensation: ClassVar[str] = "has no cutter compensation (G41, G42)"
    """What is said of a control whose D offsets are none."""

    def write(self, program: Program) -> str:
        """The program text, lines ended by a line feed.

        Raises
        ------
        ProgramError
            The program has no moves, or a section that does not start with a Rapid to x and y; the offsets
            that it should set have not been measured.
        """
        self._check_program(program)
        out = self.writer(program)
        self.frame(out)
        self.head(out)
        before = len(out.lines)
        self.safe_start(out)
        if program.posting.offsets:
            self.set_offsets(out)
        if program.machine.homed:  # else the first section says what its zero is before anything moves
            self.retract(out)
        for place, section in enumerate(program.sections):
            if place and program.posting.optional_stops and out.lines[-1] != self.m(0):
                out.line(self.m(1))
            following = program.sections[(place + 1) % len(program.sections)].tool.number
            ahead = program.posting.stage_tools and following != section.tool.number
            out.staged = following if ahead else 0
            self.section(out, section)
        self.go_home(out)
        if self.subprograms == "first":
            out.lines[before:before] = [line for lines in out.subprograms for line in lines]
        self.end(out)
        return "\n".join(self.finished(out)) + "\n"

    def _check_program(self, program: Program) -> None:
        """Raise ProgramError for a program that it cannot run, or that does nothing."""
        if program.posting.stage_tools and not self.stages:
            raise ProgramError(f"program {program.name}: {self._stages_none}; leave post.stage_tools out")
        if program.posting.restart and program.more_offsets:
            raise ProgramError(f"program {program.name}: {RESTARTS_NONE}; leave post.restart out")
        title, compensates = self.title, self.offsets.d is not None
        if not any(operation.moves for section in program.sections for operation in section.operations):
            raise ProgramError(f"program {program.name} has no moves; nothing is written")
        for section in program.sections:
            tool = section.tool
            if not compensates and tool in program.compensated:
                raise ProgramError(
                    f"{title} {self.no_compensation}, and program {program.name} uses "
                    'it; use cam.compensation = "computer"'
                )
            if max(tool.number, tool.d_number if tool in program.compensated else 0) > self.highest_tool:
                raise ProgramError(
                    f"tool {tool.name} has number {max(tool.number, tool.d_number)}; {title} takes up "
                    f"to T{self.highest_tool}; give it a lower one in the tool library"
                )
            if tool.kind is ToolKind.TAP and (why := self.cannot_tap(tool)):
                raise ProgramError(f"program {program.name}, tool {tool.name}: {why}; mill the thread")
            first = next((move for operation in section.operations for move in operation.moves), None)
            if not (isinstance(first, Rapid) and None not in (first.x, first.y)):
                raise ProgramError(
                    f"program {program.name}: the section of T{tool.number} does not start "
                    "with a rapid to x and y"
                )

    def check(self, settings: CamSettings) -> Sequence[Finding]:
        """What the control cannot do of what a design file asks for: work offset, cutter compensation."""
        found, rows = list(self.check_zero(settings)), self.work_offsets
        for offset in settings.offsets:
            if not any(row.has(offset) for row in rows):
                lack = f"{self.title} has no work offset {offset}"
                remedy = f"use one of: {', '.join(row.name for row in rows)}"
                key = "cam.work_offset" if offset == settings.work_offset else "cam.more_offsets"
                found.append(Finding.error("cam.work-offset", key, lack, remedy=remedy))
        if settings.post.restart and settings.more_offsets:
            remedy = "leave restart out"
            found.append(Finding.error("cam.restart", "cam.post.restart", RESTARTS_NONE, remedy=remedy))
        if settings.compensation != "computer" and self.offsets.d is None:
            lack = f"{self.title} {self.no_compensation}"
            remedy = 'use compensation = "computer"'
            found.append(Finding.error("cam.compensation", "cam.compensation", lack, remedy=remedy))
        if settings.post.stage_tools and not self.stages:
            remedy = "leave stage_tools out"
            found.append(
                Finding.error("cam.stage-tools", "cam.post.stage_tools", self._stages_none, remedy=remedy)
            )
        return found

    @property
    def _stages_none(self) -> str:
        return f"{self.title} has no tool made ready ahead: its tools are changed by hand or by its own macro"

    def check_tools(self, settings: CamSettings, tools: Sequence[Tool]) -> Sequence[Finding]:  # noqa: ARG002
        """Taps that it cannot use."""
        return [
            Finding.error(
                "cam.tapping", "cam.tools", f"{tool.name}: {why}", remedy="list a thread mill for it"
            )
            for tool in tools
            if tool.kind is ToolKind.TAP and (why := self.cannot_tap(tool))
        ]

    def read(self, program: str | Mapping[str, str], **settings: Any) -> Run:
        """Run a program by the rules of the control's dialect."""
        table = self.dialect.words.with_tools(self.highest_tool)
        dialect = replace(self.dialect, name=self.title, words=table)
        return interpret_files(program, dialect, **settings)

    def head(self, out: Writer) -> None:
        """Write what the operator has to know before the start."""
        program = out.program
        self.comment(out, f"program {program.name}, {self.title}")
        for note in program.notes:
            self.comment(out, note)
        zero, unit = self.zeros(program), self.units
        self.comment(out, f"origin {zero}, Z0 on top of the stock, units {unit} and {unit}/min")
        for tool in program.tools:
            self.comment(out, self.tool_note(tool))
        for offset in self.offsets.of_program(program):
            self.comment(out, self.d_note(offset))

    def zeros(self, program: Program) -> str:
        """What people at the control call the work offsets of a program."""
        return ", ".join(map(self.offset_words, program.offsets))

    def set_offsets(self, out: Writer) -> None:
        """Write the measured work offsets and tool lengths into the control's tables."""
        program, places = out.program, {out.program.work_offset: out.program.measured}
        places |= {offset: program.measured.of(offset) for offset in program.more_offsets}
        missing = [
            f"cam.measured.{axis if offset == program.work_offset else f'more.{offset}.{axis}'}"
            for offset, place in places.items()
            for axis in "xyz"
            if getattr(place, axis) is None
        ]
        missing += [f"cam.measured.lengths.{tool.name}" for tool in program.tools if tool.length is None]
        if missing:
            raise ProgramError(
                f"cam.post.offsets: program {program.name} is to set its offsets, and {missing[0]} is not "
                "given; measure it, or leave the offsets to the operator"
            )
        self.comment(out, "measured offsets")
        if self.dialect.words.axes_need_motion:
            out.line("G0")  # G80 of the safe start is in force, and no axis word may stand beside it
        for offset, place in places.items():
            out.line(self.write_offset(offset, {axis.upper(): getattr(place, axis) for axis in "xyz"}))
        for tool in program.tools:
            for line in self.tool_words(tool):
                out.line(line)
