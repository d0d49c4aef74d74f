"""The contract of a control: what writes its programs."""

from abc import abstractmethod
from typing import TYPE_CHECKING, ClassVar

from mechwright.contracts.plugin import Plugin

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.contracts.finding import Finding
    from mechwright_cam.program.moves import Program
    from mechwright_cam.shop.posting import ToolChange
    from mechwright_cam.shop.settings import CamSettings
    from mechwright_cam.shop.tool import Tool


class Post(Plugin):
    """Turns a program into the text that one control reads."""

    kind = "control"
    plural = "controls"
    texts = ("title", "suffix")

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


Control = Post
