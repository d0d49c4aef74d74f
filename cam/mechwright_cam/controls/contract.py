"""The contract of a control: all that there is to know about one kind of machine control, in one class."""

from abc import abstractmethod
from copy import copy
from typing import TYPE_CHECKING, ClassVar

from mechwright.contracts.plugin import Plugin
from mechwright.designs.inches import FACTORS
from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import EXACT, Corners
from mechwright_cam.controls.offsets import G54_TO_G59, OffsetTables, WorkOffsets

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Self

    from mechwright.contracts.file_names import File, Files, Text
    from mechwright.contracts.finding import Finding
    from mechwright.designs.inches import Units
    from mechwright_cam.controls.answers import GuardedLookahead, RunOfText
    from mechwright_cam.program.moves import Program
    from mechwright_cam.program.touches import ToolTouches, Touches
    from mechwright_cam.shop.machine import Machine
    from mechwright_cam.shop.posting import ToolChange
    from mechwright_cam.shop.settings import CamSettings
    from mechwright_cam.shop.tool import Tool


METRIC, INCH = "G21", "G20"
"""The usual words for the units of a program."""


class Control(Plugin):
    """Writes programs, reads them, and knows its tables, its limits and its words for the operator.

    Pages and proof ask the control itself, never its name: a control that inherits from another and changes
    one fact is told of rightly everywhere. Controls that read RS274 words derive from
    :class:`mechwright_cam.controls.gcode.GcodeControl`.
    """

    kind = "control"
    plural = "controls"
    limited = True

    title: ClassVar[str]
    """Name for people."""
    suffix: ClassVar[str] = ".nc"
    """Ending of program files."""
    offsets: ClassVar[OffsetTables] = OffsetTables()
    """What it keeps of each tool."""
    work_offsets: ClassVar[tuple[WorkOffsets, ...]] = (G54_TO_G59,)
    """The work offsets it has."""
    by_hand: ClassVar["ToolChange"] = "pause"
    """How a control without a tool change has tools changed, unless the design file says so itself."""

    tolerances: ClassVar[tuple[float, ...]] = ()
    """How near to the path an operation can ask it to stay, mm, loosest first and 0 for exact; what does not
    say is written with the middle one."""

    taps_again: ClassVar[bool] = False
    """Whether rigid tapping begins at one mark of the spindle each time, so that it finds a thread again."""
    taps: ClassVar[frozenset[str]] = frozenset()
    """The ways in which it taps: ``"rigid"``, where it keeps feed and spindle together itself, ``"floating"``
    in a holder that gives way, and each with ``" left"`` behind it for left-hand taps."""

    units: "Units" = "mm"
    """Of the programs and tables that it writes, and of the words on its sheets; it reads both."""

    def speaking(self, units: "Units") -> "Self":
        """The same control with other units."""
        if units == self.units:
            return self
        other = copy(self)
        other.units = units
        return other

    # -- programs -----------------------------------------------------------------------------------------

    @abstractmethod
    def write(self, program: "Program") -> "Text":
        """The program text, lines ended by a line feed."""

    def files(self, program: "Program") -> "Files":
        """The program as files, stem to text, in the order in which they are run; most controls take one."""
        return {program.name: self.write(program)}

    def stems(self, name: str, tools: "Sequence[Tool]") -> "Sequence[str]":  # noqa: ARG002 - for one file a tool
        """Stems that files of a program may have, by its name and its possible tools; before any planning.

        :meth:`files`, :meth:`measure` and :meth:`probe` give no others.
        """
        return (name,)

    @abstractmethod
    def read(
        self,
        program: "str | Mapping[str, str]",
        *,
        block_delete: bool = False,
        upper_end: float = 0.0,
        diameters: "Mapping[int, float] | None" = None,
    ) -> "RunOfText":
        """Run a program as the control would, wherever it comes from.

        Parameters
        ----------
        program
            The text, or several files by name in the order in which they are run.
        block_delete
            Whether lines that start with ``/`` are skipped.
        upper_end
            Machine Z of a full retract, mm: to there or higher is the machine's upper end.
        diameters
            D number to the diameter of the cutter that it stands for, mm.

        Raises
        ------
        ProgramError
            The control would stop, or the reader would have to guess. The message names file and line.
        """

    @property
    def decimals(self) -> int:
        """Decimals of a coordinate, in its units, that the control keeps."""
        return 4

    @property
    def scale(self) -> float:
        """Length of its unit, mm."""
        return FACTORS["mm"] if self.units == "inch" else 1.0

    @property
    def resolution(self) -> float:
        """The last decimal of a coordinate, mm."""
        return self.scale * 10.0**-self.decimals

    @property
    def corners(self) -> Corners:
        """How far the control leaves the path between two moves."""
        return EXACT

    @property
    def lookahead(self) -> "GuardedLookahead":
        """How it goes from move to move: how long that takes, and how far off the path."""
        from mechwright_cam.controls.lookahead import DEFAULT_LOOKAHEAD

        return DEFAULT_LOOKAHEAD

    @property
    def length_write(self) -> tuple[int, str] | None:
        """L of the G10 that sets a tool's length, and the letter of the length; None without such a table."""
        return None

    # -- limits and tables --------------------------------------------------------------------------------

    def check(self, settings: "CamSettings") -> "Sequence[Finding]":  # noqa: ARG002 - for controls with limits
        """What the control cannot do of what a design file asks for."""
        return ()

    def check_zero(self, settings: "CamSettings") -> "Sequence[Finding]":
        """What it cannot do without machine zero: change tools within a program."""
        from mechwright.contracts.finding import Finding

        if settings.machine.homed:
            return ()
        if self.by_hand != "files":
            lack = f"{self.title} changes tools at the upper end of Z, unknown to a machine without zero"
            remedy = 'write homing = "marks", and home by hand at marks on the axes before each job'
            return (Finding.error("cam.homing", "cam.machine.homing", lack, remedy=remedy),)
        if settings.post.tool_change == "pause":
            lack = "at a stop the tool stands low, as the machine has no zero that it could go up to"
            remedy = "leave tool_change out: each tool then has a file of its own"
            return (Finding.error("cam.homing", "cam.post.tool_change", lack, remedy=remedy),)
        return ()

    def check_tools(self, settings: "CamSettings", tools: "Sequence[Tool]") -> "Sequence[Finding]":  # noqa: ARG002
        """What the control cannot do with the tools of a job, whose lengths are those measured."""
        return ()

    def cannot_tap(self, tool: "Tool") -> str:
        """Why it does not tap with a tap as it is held; nothing where it does."""
        way = "floating" if tool.floating else "rigid"
        if way + (" left" if tool.left_hand else "") in self.taps:
            return ""
        if tool.left_hand and way in self.taps:
            return f"{self.title} has no cycle for left-hand taps"
        if not tool.floating and "floating" in self.taps:
            return (
                f"{self.title} does not keep feed and spindle together: a tap needs a floating holder there"
            )
        return f"{self.title} does not turn the spindle back in step with the feed: it has no tapping cycle"

    @property
    def compensates(self) -> bool:
        """Whether it has cutter compensation at all, which an earlier program may have left on."""
        return True

    dwell_words: ClassVar[str] = "P is in seconds"
    """The unit of its dwells."""
    bound_words: ClassVar[str] = ""
    """Where a program says how far the control may leave the path; empty where none can say so."""
    rounding_words: ClassVar[str] = ""
    """What keeps it as near to the path as our own programs do at walls; empty where no word does."""
    exact_words: ClassVar[str] = "G61"
    """What keeps it on the path."""
    several: ClassVar[bool] = False
    """Whether it writes programs for several work offsets."""
    stages: ClassVar[bool] = False
    """Whether a T word alone makes the next tool ready while the present one cuts."""
    tap_needs: ClassVar[str] = ""
    """What it needs for rigid tapping, a sentence for the setup sheet."""

    @abstractmethod
    def tool_table(self, tools: "Sequence[Tool]") -> "File":
        """File name and text of the control's tool table; two empty strings if it has none."""

    def offset_table(self, tools: "Sequence[Tool]", settings: "CamSettings") -> "File":  # noqa: ARG002
        """The tool table of a job with cutter compensation, whose D offsets it holds as well.

        By default that of :meth:`tool_table`.
        """
        return self.tool_table(tools)

    # -- words for the operator, in programs, on setup sheets and in the proof's advice -------------------

    def m(self, code: int) -> str:
        """The control's word for a usual M code: 0 stop, 3 and 5 spindle, 6 tool, 7 to 9 coolant, 30 end."""
        return f"M{code}"

    def change_words(self, tool: int) -> str:
        """What changes to a tool."""
        return f"T{tool} {self.m(6)}"

    def length_words(self, tool: int | str) -> str:
        """What puts a tool's length offset in force."""
        return f"G43 {self.length_place(tool)}"

    def length_place(self, tool: int | str) -> str:
        """Where a tool's length stands."""
        return f"H{tool}"

    no_length: ClassVar[str] = "G49"
    """What puts no length in force."""

    @property
    def unit_word(self) -> str:
        """The word for the units of its programs."""
        return INCH if self.units == "inch" else METRIC

    def cannot_probe(self, tools: "Sequence[Tool]") -> str:  # noqa: ARG002 - for controls without a tool table
        """Why it has no program that probes the zero of a job with these tools; nothing where it has one."""
        return f"{self.title} has no program that probes here: set the zero by hand, or with its own cycles"

    def probe(self, touches: "Touches", machine: "Machine") -> "Text":  # noqa: ARG002
        """The text of a program that probes; raises ProgramError where it has none."""
        raise ProgramError(f"program {touches.name}: {self.cannot_probe(())}")

    def cannot_measure(self, tools: "Sequence[Tool]") -> str:  # noqa: ARG002 - for controls with lengths in programs
        """Why it has no program that measures these tools on a setter; nothing where it has one."""
        return f"{self.title} has no program that measures tools here: use its own cycle, or measure by hand"

    def measure(self, touches: "ToolTouches", machine: "Machine") -> "Files":  # noqa: ARG002
        """Stem and text of the programs that measure tools, in order; raises ProgramError without any."""
        raise ProgramError(f"program {touches.name}: {self.cannot_measure(())}")

    def rapid_words(self, z: str) -> str:
        """What goes to a height in the work, at a rapid."""
        return f"G0 Z{z}"

    def offset_words(self, offset: str) -> str:
        """What people at the control call a work offset."""
        return offset

    def setting_words(self, offset: str) -> str:
        """What sets a work offset, without its axes."""
        return next(row for row in self.work_offsets if row.has(offset)).setting(offset)

    def height_words(self, offset: str, value: str) -> str:
        """What sets the Z of a work offset to a value."""
        return f"{self.setting_words(offset)} Z[{value}]"

    def upper_end(self, machine: "Machine") -> float:
        """Machine Z of a full retract, mm: as the machine says, or where it does not, as is usual here."""
        return machine.retract_z

    def retract_words(self, machine: "Machine") -> str:
        """What goes to the upper end of a machine."""
        return f"G53 G0 Z{self.upper_end(machine) / self.scale:.{self.decimals}g}"

    def needs(self, settings: "CamSettings") -> "Sequence[str]":  # noqa: ARG002 - for controls that rely on settings
        """What has to be set on the control before a job is run, a sentence each, for the setup sheet."""
        return ()

    @property
    def leftover(self) -> str:
        """What an earlier program may leave and no program takes back, and how to; for sheet and proof."""
        return ""

    def table_words(self, table: str) -> str:
        """What to do with the file of the tool table."""
        return f"{table} lists the tools: enter the measured lengths there."
