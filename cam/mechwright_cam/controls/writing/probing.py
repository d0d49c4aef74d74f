"""Programs that probe, by G38.2 and G38.3, and set the work offset by G10 L20."""

from collections.abc import Sequence
from typing import ClassVar

from mechwright.errors import ProgramError
from mechwright_cam.controls.writing.sections import Sections
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Program
from mechwright_cam.program.touches import Touches
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import number

FAST, SLOW = 150.0, 25.0
"""Feeds of the two touches, mm/min: how far the machine goes on after the second is below a micrometre."""
BACK = 2.0
"""Between the two, mm."""
PARAMETERS = {"X": ("#5061", "#5420"), "Y": ("#5062", "#5421"), "Z": ("#5063", "#5422")}
"""Where the ball met, and where the tool stands, by axis."""


class Probing(Sections):
    """A control that probes by G38.2."""

    counts: ClassVar[bool] = True
    """Whether a program can ask where the ball met, by parameters; else it counts from where it stopped."""

    def cannot_probe(self, tools: Sequence[Tool]) -> str:  # noqa: ARG002
        """Nothing: it can."""
        return ""

    def probe(self, touches: Touches, machine: Machine) -> str:
        """Each axis is set as soon as it is touched; what meets nothing, or too early, ends the program."""
        if why := self.cannot_probe(()):
            raise ProgramError(f"program {touches.name}: {why}")
        program = Program(touches.name, touches.offset, touches.high, (), touches.notes, machine)
        out = self.writer(program)
        self.frame(out)
        self.comment(out, f"program {touches.name}, {self.title}: probes the zero of {touches.offset}")
        for note in touches.notes:
            self.comment(out, note)
        out.line(*self.safe_modes)
        out.line("G61")
        self.retract(out)
        for code in (5, 9):
            out.line(self.m(code))
        self.take_probe(out, touches)
        x, y = touches.first
        out.line(touches.offset, "G0", f"X{self.length(x)}", f"Y{self.length(y)}")
        self.probe_length(out, touches)
        for line in self._touching(touches):
            out.line(line)
        self.retract(out)
        self.end(out)
        return "\n".join(self.finished(out)) + "\n"

    def take_probe(self, out: Writer, touches: Touches) -> None:
        """Bring the probe into the spindle."""
        out.line(self.change_words(touches.tool))

    def probe_length(self, out: Writer, touches: Touches) -> None:
        """The probe's length in force, and down to the height of rapids."""
        out.line(self.length_words(touches.tool), f"G0 Z{self.length(touches.high)}")

    def _touching(self, touches: Touches) -> list[str]:
        lines = []
        setting = self.setting_words(touches.offset).replace("G10 L2 ", "G10 L20 ")
        fast, slow = (number(feed / self.scale, 1) for feed in (FAST, SLOW))
        for step in touches.steps:
            word = f"{step.axis}{self.length(step.to)}"
            if step.kind == "rapid":
                lines.append(f"G0 {word}")
                continue
            if step.kind == "guarded":
                lines.append(f"G38.3 {word} F{fast}")
                continue
            met, stands = PARAMETERS[step.axis]
            back, value = self.length(BACK), self.length(step.value)
            lines.append(f"G38.2 {word} F{fast}")
            if self.counts:
                lines.append(f"G0 {step.axis}[{met} {'-' if step.upward else '+'} {back}]")
            else:
                lines += ["G91", f"G0 {step.axis}{'-' if step.upward else ''}{back}", "G90"]
            lines.append(f"G38.2 {word} F{slow}")
            shown = f"[{value} + {stands} - {met}]" if self.counts else value
            lines.append(f"{setting} {step.axis}{shown}")
        return lines
