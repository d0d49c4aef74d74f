"""How programs are written, and what was measured at the machine: tables of ``[cam]``."""

import re
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from mechwright.contracts.parameters import Parameters
from mechwright.designs.inches import Units
from mechwright.units import Millimetres, MillimetresPerMin
from mechwright_cam.shop.machine import Place

LEAST_CLEARANCE = 0.5
"""Rapids run at least so high over stock and clamp, mm: burrs and the setting of tools take tenths."""


_OFFSET = re.compile(r"G(5[4-9]|59\.[123]|54\.1 P([1-9]|[1-9]\d|[12]\d\d|300)|154 P[1-9]\d?)")


def _work_offset(text: str) -> str:
    if not _OFFSET.fullmatch(text):
        raise ValueError("should be G54 to G59, or as the control has it G59.1 to G59.3, G54.1 P1, G154 P1")
    return text


WorkOffset = Annotated[str, AfterValidator(_work_offset)]
"""Every work offset that some control has; its post says which."""


ToolChange = Literal["pause", "files"]
"""How a tool is changed by hand: at a stop in the program, or between files of one tool each."""


class Posting(Parameters):
    """How the program is written, whatever it does."""

    program_number: int = Field(1, ge=1, le=9999, description="O number of the first program, if it has one.")
    units: Units | None = Field(
        None, description="Unit of programs, tables and sheets; by default that of the shop, or mm."
    )
    line_numbers: int = Field(0, ge=0, le=100, description="Step of the N numbers; 0 writes none.")
    restart: bool = Field(False, description="Every operation states all modes: a restart point.")
    optional_stops: bool = Field(False, description="An M1 before every tool change.")
    stage_tools: bool = Field(
        False,
        description="Call the next tool (T alone) after each tool change, for changers with an arm.",
    )
    cycles: bool = Field(True, description="Drilling cycles; false writes out their moves.")
    exact_stop: bool = Field(False, description="G61: stop at every corner, instead of blending (G64).")
    offsets: bool = Field(False, description="Write the measured offsets into the program (G10).")
    d_value: Literal["radius", "diameter"] = Field(
        "radius", description="Content of a D offset of Fanuc and Haas; LinuxCNC and Mach3 keep the diameter."
    )
    tool_change: ToolChange | None = Field(
        None,
        description="On a control without a tool change: stop for it, or write one file per tool; by default "
        "as the control prefers.",
    )


class Probe(Parameters):
    """A touch probe that finds the stock's zero."""

    tool: int | None = Field(
        None,
        ge=1,
        le=99999,
        description="T number of a touch probe: a program of its own finds the stock's zero with it.",
    )
    diameter: Millimetres = Field(4.0, ge=0.5, le=20, description="Diameter of the probe's ball.")
    doubt: Millimetres = Field(
        3.0, ge=0.5, le=10, description="Largest error of the zero that is set by eye beforehand."
    )


class Setter(Parameters):
    """A tool setter that stands on the table, and measures the tools of a job."""

    x: Place = Field(
        None, description="Machine X of its middle; x, y and over ask for a program that measures tools."
    )
    y: Place = Field(None, description="Machine Y of its middle.")
    over: Millimetres | None = Field(
        None, ge=-500, le=500, description="Height of its top over the top of the stock, below 0 for lower."
    )
    diameter: Millimetres = Field(20.0, ge=2, le=100, description="Diameter of its top.")
    start: Place = Field(
        None, description="Machine Z where the rapid ends and the touch begins; by default the retract."
    )
    travel: Millimetres = Field(
        100.0, ge=1, le=1000, description="Longest touch; one that meets nothing ends the program."
    )
    fast: MillimetresPerMin = Field(150.0, ge=10, le=1000, description="Feed of the first touch.")
    slow: MillimetresPerMin = Field(25.0, ge=1, le=100, description="Feed of the second touch.")

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if 0 < [self.x, self.y, self.over].count(None) < 3:
            raise ValueError("give x, y and over of the setter, or none of them")
        return self


Compensation = Literal["computer", "control", "wear"]
"""Where the radius of a finishing cutter is allowed for: in the path, at the control (G41 and G42, D holds
the radius), or in the path with the wear at the control (D holds the difference, 0 for a new cutter)."""


class MachinePlace(Parameters):
    """Where a work offset lies."""

    x: Place = Field(None, description="Machine X of the work offset.")
    y: Place = Field(None, description="Machine Y of the work offset.")
    z: Place = Field(None, description="Machine Z of the work offset.")


class Measured(Parameters):
    """What was read at the machine; the setup sheet says how."""

    x: Place = Field(None, description="Machine X of the work offset.")
    y: Place = Field(None, description="Machine Y of the work offset.")
    z: Place = Field(None, description="Machine Z of the work offset.")
    lengths: dict[str, Annotated[Millimetres, Field(ge=-1000, le=1000)]] = Field(
        default_factory=dict, description="Tool name to its length offset H."
    )
    more: dict[WorkOffset, MachinePlace] = Field(
        default_factory=dict, description="Work offset of more_offsets to its machine X, Y and Z."
    )

    def of(self, offset: str) -> "Measured":
        """The same with the place of one of the further work offsets; unknown where it is not measured."""
        place = self.more.get(offset, MachinePlace())
        return self.model_copy(update={"x": place.x, "y": place.y, "z": place.z})
