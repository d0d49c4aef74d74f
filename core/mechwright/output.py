"""Contracts of what writes files: posts and exporters."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

from mechwright.family import HOOK_API

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.findings import Finding
    from mechwright.motion import Motion
    from mechwright.part import Part
    from mechwright.program import Program
    from mechwright.tooling import CamSettings, Tool, ToolChange


class Post(ABC):
    """Turns a program into the text that one control reads."""

    api: ClassVar[int] = HOOK_API
    name: ClassVar[str]
    """Name in design files (``"linuxcnc"``)."""
    title: ClassVar[str]
    """Name for people."""
    suffix: ClassVar[str] = ".nc"
    """Ending of program files."""
    dialect: ClassVar[str] = "linuxcnc"
    """The control, by the name of a post that comes with the program, whose rules the text follows when the
    proof reads it back."""

    by_hand: ClassVar["ToolChange"] = "pause"
    """How a control without a tool change has tools changed, unless the design file says so itself."""

    @abstractmethod
    def write(self, program: "Program") -> str:
        """The program text, lines ended by a line feed."""

    def files(self, program: "Program") -> dict[str, str]:
        """The program as files, stem to text, in the order in which they are run; most controls take one."""
        return {program.name: self.write(program)}

    def check(self, settings: "CamSettings") -> "Sequence[Finding]":  # noqa: ARG002 - for controls with limits
        """What the control cannot do of what a design file asks for."""
        return ()

    def check_tools(self, settings: "CamSettings", tools: "Sequence[Tool]") -> "Sequence[Finding]":  # noqa: ARG002
        """What the control cannot do with the tools of a job, whose lengths are those measured."""
        return ()

    @abstractmethod
    def tool_table(self, tools: "Sequence[Tool]") -> tuple[str, str]:
        """File name and text of the control's tool table; two empty strings if it has none."""

    def offset_table(self, tools: "Sequence[Tool]", settings: "CamSettings") -> tuple[str, str]:  # noqa: ARG002
        """The tool table of a job with cutter compensation, whose D offsets it holds as well.

        By default that of :meth:`tool_table`.
        """
        return self.tool_table(tools)


class Exporter(ABC):
    """Writes parts in one file format. The same parts give the same bytes."""

    api: ClassVar[int] = HOOK_API
    name: ClassVar[str]
    """Name on the command line (``"step"``)."""
    suffix: ClassVar[str]
    """Ending of its files."""
    modules: ClassVar[tuple[str, ...]] = ()
    """Names of modules that it imports when it writes and that take long to import: where they are not
    imported yet, ``build`` may let it write in a second process, beside other work. A copy made by pickle
    has to write the same bytes."""

    @abstractmethod
    def part(self, part: "Part") -> bytes:
        """One part by itself, in its own coordinates."""

    def assembly(
        self,
        name: str,  # noqa: ARG002 - used by formats that hold assemblies
        parts: "Sequence[Part]",  # noqa: ARG002
        motion: "Motion",  # noqa: ARG002
        sample: int = 0,  # noqa: ARG002
    ) -> bytes | None:
        """All instances in their poses at one sample of the motion; None if the format holds single parts."""
        return None
