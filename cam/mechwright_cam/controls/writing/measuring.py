"""Programs that measure tools on a setter, by G38.2.

Each tool goes down until it meets the setter, is drawn back a little, and touches it once more, slowly. Where
it stands then is told to the control, less than a micrometre below the contact.
"""

from collections.abc import Sequence

from mechwright.errors import ProgramError
from mechwright_cam.controls.writing.probing import BACK, Probing
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Program
from mechwright_cam.program.touches import ToolTouches
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import number


class Measuring(Probing):
    """A control that touches by G38.2 and keeps lengths that a program may write."""

    def cannot_measure(self, tools: Sequence[Tool]) -> str:  # noqa: ARG002
        """Nothing: it can."""
        return ""

    def measure(self, touches: ToolTouches, machine: Machine) -> dict[str, str]:
        """One program for all tools."""
        return {touches.name: self.measuring(touches, machine, touches.name, touches.tools)}

    def measuring(
        self, touches: ToolTouches, machine: Machine, name: str, tools: Sequence[tuple[int, str]]
    ) -> str:
        """The text of a program that measures some of the tools."""
        if why := self.cannot_measure(()):
            raise ProgramError(f"program {name}: {why}")
        out = self.writer(Program(name, touches.offsets[0], 0.0, (), (), machine))
        self.frame(out)
        self.comment(out, f"program {name}, {self.title}: measures tools on the setter")
        height = f"{number(touches.over / self.scale, self.decimals)} {self.units}"
        self.comment(out, f"the setter's top is at Z {height} of {touches.offsets[0]}; the spindle stays off")
        out.line(*self.safe_modes)
        out.line("G61")
        for code in (5, 9):
            out.line(self.m(code))
        self.retract(out)
        out.line(touches.offsets[0])
        for tool, said in tools:
            self._touch(out, touches, tool, said)
        self.end(out)
        return "\n".join(self.finished(out)) + "\n"

    def _touch(self, out: Writer, touches: ToolTouches, tool: int, said: str) -> None:
        (x, y), down = touches.place, self.length(-touches.travel)
        fast, slow = (number(feed / self.scale, 1) for feed in (touches.fast, touches.slow))
        self.take_tool(out, tool, said)
        out.line(self.no_length)
        out.line(*self.machine_words(), f"X{self.length(x)}", f"Y{self.length(y)}")
        if touches.start is not None:
            out.line(*self.machine_words(), f"Z{self.length(touches.start)}")
        self.comment(out, f"touch: T{tool} {said}")
        out.line("G91")
        out.line(f"G38.2 Z{down} F{fast}")
        out.line(f"G0 Z{self.length(BACK)}")
        out.line(f"G38.2 Z{self.length(-2 * BACK)} F{slow}")
        out.line("G90")
        for line in self.length_lines(touches, tool):
            out.line(line)
        self.retract(out)

    def take_tool(self, out: Writer, tool: int, said: str) -> None:  # noqa: ARG002 - for changes by hand
        """Bring a tool into the spindle."""
        out.line(self.change_words(tool))

    def length_lines(self, touches: ToolTouches, tool: int) -> Sequence[str]:
        """What tells the control that the tip stands at the setter's top: its length, for the work offset."""
        return [f"G10 L10 P{tool} Z{self.length(touches.over)}"]
