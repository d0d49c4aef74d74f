"""Cutters, machines, stock and holding: the tables under ``[cam]`` of a design file, and the tool library."""

import re
from enum import StrEnum
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from mechwright.machine import Machine as Machine  # families and CAM know it from here
from mechwright.parameters import Parameters
from mechwright.tolerances import TOLERANCES
from mechwright.units import Degrees, MetresPerMin, Millimetres, Ratio


class ToolKind(StrEnum):
    """Kinds of cutter that the program can use."""

    END_MILL = "end-mill"
    DRILL = "drill"
    SPOT_DRILL = "spot-drill"
    BULL_NOSE = "bull-nose"
    BALL = "ball"
    CHAMFER = "chamfer-mill"
    THREAD_MILL = "thread-mill"


MILLS = frozenset({ToolKind.END_MILL, ToolKind.BULL_NOSE, ToolKind.BALL})
"""Cutters that clear and finish with end and side."""


class CuttingData(Parameters):
    """How a tool cuts one material."""

    cutting_speed: MetresPerMin = Field(gt=0, le=2000, description="Speed of the cutting edge.")
    chip_load: Millimetres = Field(gt=0, le=2, description="Feed per tooth; per lip for a drill.")
    step_down: Ratio = Field(
        0.5, gt=0, le=5, description="Depth of one roughing pass, or of one peck, in diameters."
    )
    step_over: Ratio = Field(0.4, gt=0, le=1, description="Width of one roughing pass, in diameters.")


class CuttingChange(Parameters):
    """What a design says of a tool's cutting data; what it leaves out stays as the library has it."""

    cutting_speed: MetresPerMin | None = Field(None, gt=0, le=2000, description="Speed of the cutting edge.")
    chip_load: Millimetres | None = Field(
        None, gt=0, le=2, description="Feed per tooth; per lip for a drill."
    )
    step_down: Ratio | None = Field(
        None, gt=0, le=5, description="Depth of one roughing pass, or of one peck, in diameters."
    )
    step_over: Ratio | None = Field(None, gt=0, le=1, description="Width of one roughing pass, in diameters.")


class Tool(Parameters):
    """A cutter in its holder."""

    name: str = Field(min_length=1, max_length=40, pattern=r"^[a-z0-9][a-z0-9_.-]*$", description="Its name.")
    number: int = Field(ge=1, le=9999, description="T number; the length offset H is the same.")
    kind: ToolKind = Field(description="What it is.")
    diameter: Millimetres = Field(gt=0, le=100, description="Cutting diameter.")
    flutes: int = Field(2, ge=1, le=12, description="Number of cutting edges.")
    flute_length: Millimetres = Field(gt=0, le=300, description="How deep it can cut.")
    centre_cutting: bool = Field(True, description="Whether it may be plunged straight down.")
    point_angle: Degrees = Field(
        118.0, gt=30, le=180, description="Full angle of a drill's point, or of a chamfer mill."
    )
    corner_radius: Millimetres = Field(0.0, ge=0, le=50, description="Radius of a bull-nose mill's corner.")
    tip_diameter: Millimetres = Field(0.0, ge=0, le=50, description="Flat at the tip of a chamfer mill.")
    shank_diameter: Millimetres | None = Field(
        None, gt=0, le=100, description="Diameter above the flutes; by default the cutting diameter."
    )
    stick_out: Millimetres | None = Field(
        None,
        gt=0,
        le=400,
        description="Length out of the holder, if it is set; the setup sheet says the least.",
    )
    holder_diameter: Millimetres = Field(
        40.0, gt=0, le=200, description="Diameter of the holder's lower end; a collet chuck by default."
    )
    life: Annotated[Ratio, Field(gt=0, le=10000)] | None = Field(
        None, description="Minutes in cut after which an edge is worn."
    )
    substrate: Literal["carbide", "hss"] = Field("carbide", description="What it is made of.")
    coating: str = Field("", max_length=20, description="Its coating, as the setup sheet names it.")
    length: Millimetres | None = Field(
        None, ge=-1000, le=1000, description="Its length offset H as measured at the machine."
    )
    diameter_offset: int | None = Field(
        None, ge=1, le=9999, description="D number for cutter compensation; by default that of the tool."
    )
    cutting: dict[str, CuttingData] = Field(
        default_factory=dict, description="Material name to cutting data."
    )

    @model_validator(mode="after")
    def _shape(self) -> Self:
        if self.corner_radius > self.diameter / 2:
            raise ValueError("corner_radius must be at most half of the diameter")
        if self.tip_diameter >= self.diameter:
            raise ValueError("tip_diameter must be below the diameter")
        if (self.kind is ToolKind.BULL_NOSE) != (self.corner_radius > 0):
            raise ValueError("a bull-nose mill has a corner_radius, and no other tool has one")
        if self.stick_out is not None and self.stick_out < self.flute_length:
            raise ValueError("stick_out must be at least flute_length: flutes do not cut inside the holder")
        return self

    @property
    def radius(self) -> float:
        """Half the diameter, mm."""
        return self.diameter / 2

    @property
    def d_number(self) -> int:
        """D number of its cutter compensation."""
        return self.number if self.diameter_offset is None else self.diameter_offset

    @property
    def nose(self) -> float:
        """Radius of the rounded corner between end and side, mm: 0 for a flat end, the radius for a ball."""
        return self.radius if self.kind is ToolKind.BALL else self.corner_radius


class Stock(Parameters):
    """The plate that the part is cut from; as thick as the part.

    Its size is the part's plus the margin all round, unless length and width are given.
    """

    margin: Millimetres | None = Field(
        None, ge=0, le=200, description="Stock around the part; by default the roughing cutter and 3 mm."
    )
    length: Millimetres | None = Field(None, gt=0, le=10000, description="Size of the plate in X.")
    width: Millimetres | None = Field(None, gt=0, le=10000, description="Size of the plate in Y.")
    finished: tuple[Literal["left", "right", "front", "rear"], ...] = Field(
        (), description="Edges where the stock ends exactly at the part and is not milled."
    )

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if (self.length is None) != (self.width is None):
            raise ValueError("give both length and width, or neither")
        if self.length is not None and self.margin is not None:
            raise ValueError("give length and width, or margin, not both")
        return self


class Nesting(Parameters):
    """Several parts of one material and thickness on one plate; without the table each has its own."""

    name: str = Field(
        "nest", min_length=1, max_length=40, description="Name of the nest, and stem of its files."
    )
    parts: tuple[str, ...] = Field(
        (), description="Names of the parts; empty: all that go together, one nest per plate thickness."
    )
    gap: Millimetres | None = Field(
        None,
        gt=0,
        le=300,
        description="Between the parts; by default two of the widest channels and 3 mm.",
    )
    turn: bool = Field(True, description="Parts may be turned by 90 degrees to save stock.")


class Hold(Parameters):
    """How the part is held while its outside is cut."""

    method: Literal["tabs", "bore", "vice"] = Field(
        "tabs", description="Tabs to the frame, a clamp through the bore, or a vice on finished edges."
    )
    tabs: int = Field(4, ge=2, le=24, description="Number of tabs.")
    tab_width: Millimetres | None = Field(
        None, gt=0, le=50, description="Width of a tab along the contour; by default 2, or less if it must."
    )
    tab_height: Millimetres = Field(1.0, gt=0, le=20, description="Height of a tab above the underside.")
    tab_shape: Literal["rectangular", "ramped"] = Field(
        "rectangular", description="Upright sides, or slopes that the cutter goes up and down without a stop."
    )
    tab_angle: Degrees = Field(15.0, ge=1, le=45, description="Slope of the sides of ramped tabs.")
    clamp_diameter: Millimetres = Field(20.0, gt=0, le=300, description="Largest diameter of the bore clamp.")
    clamp_height: Millimetres = Field(
        15.0, gt=0, le=200, description="Height of the bore clamp above the part."
    )
    grip: Millimetres | None = Field(
        None, ge=1, le=200, description="Height of the edges in the vice; by default half of the thickness."
    )
    jaw_width: Millimetres | None = Field(
        None, gt=0, le=1000, description="Width of the vice's jaws; by default as wide as there is room."
    )


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
    line_numbers: int = Field(0, ge=0, le=100, description="Step of the N numbers; 0 writes none.")
    restart: bool = Field(False, description="Every operation can be started from: it states all modes.")
    optional_stops: bool = Field(False, description="An M1 before every tool change.")
    cycles: bool = Field(True, description="Drilling cycles; false writes out their moves.")
    exact_stop: bool = Field(False, description="G61: stop at every corner, instead of blending (G64).")
    offsets: bool = Field(False, description="Write the measured offsets into the program (G10).")
    d_value: Literal["radius", "diameter"] = Field(
        "radius", description="What Fanuc and Haas keep in a D offset; LinuxCNC and Mach3 keep the diameter."
    )
    tool_change: ToolChange | None = Field(
        None,
        description="Where the control has no tool change: stop for it, or one file per tool; by default as "
        "the control wants it.",
    )


class SecondSide(Parameters):
    """How the plate is turned over for features that only the underside shows."""

    work_offset: WorkOffset = Field("G55", description="Work offset of the second side.")
    flip: Literal["x", "y"] = Field("x", description="The plate is turned over about this axis.")
    locate: Literal["bore", "edges", "dowels"] = Field(
        "bore", description="What X0 Y0 is picked up by: the largest bore, the plate's edges, or two dowels."
    )
    dowel_diameter: Millimetres = Field(
        6.0, ge=2, le=20, description="Diameter of the dowel holes, bored beside the part on the flip axis."
    )
    x: Millimetres | None = Field(
        None, ge=-10000, le=10000, description="Machine X of its work offset, if it is measured."
    )
    y: Millimetres | None = Field(
        None, ge=-10000, le=10000, description="Machine Y of its work offset, if it is measured."
    )
    z: Millimetres | None = Field(
        None, ge=-10000, le=10000, description="Machine Z of its work offset, if it is measured."
    )

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if 0 < [self.x, self.y, self.z].count(None) < 3:
            raise ValueError("give x, y and z of the measured work offset, or none of them")
        return self


Compensation = Literal["computer", "control", "wear"]
"""Where the radius of a finishing cutter is allowed for: in the path, at the control (G41 and G42, D holds
the radius), or in the path with the wear at the control (D holds the difference, 0 for a new cutter)."""


DEEPEST_INTO = round(TOLERANCES.gouge - TOLERANCES.flatten, 6)  # no tail of floating point in messages
"""Most that a wall may be asked to be too deep, mm: what chords of outlines leave of the permitted gouge."""
LEAST_OFF = 2 * (TOLERANCES.outline + TOLERANCES.flatten)
"""Least that may stay on a wall, mm: less would leave chords of outline and offset, and the fit, no room."""
MOST_OFF = TOLERANCES.leftover - TOLERANCES.arc_fit
"""Most that may, mm: the corners of a larger cutter need the rest of the permitted leftover."""


class PathSettings(Parameters):
    """How exact the finished walls are, and what their paths are made of."""

    inner_tolerance: Millimetres = Field(
        TOLERANCES.outline, ge=0, le=DEEPEST_INTO, description="Deepest that finishing may cut into a wall."
    )
    outer_tolerance: Millimetres = Field(
        2 * (TOLERANCES.arc_fit + TOLERANCES.flatten) - TOLERANCES.outline,
        ge=LEAST_OFF,
        le=MOST_OFF,
        description="Most that finishing may leave on a wall; at least inner_tolerance.",
    )
    lines_per_arc: int = Field(
        1, ge=1, le=100, description="An arc is written where it stands for at least so many lines."
    )

    @model_validator(mode="after")
    def _outwards(self) -> Self:
        if self.outer_tolerance < self.inner_tolerance:
            raise ValueError(
                f"outer_tolerance {self.outer_tolerance:g} is below inner_tolerance "
                f"{self.inner_tolerance:g}; paths stay off walls, so give it at least as much"
            )
        return self

    @property
    def bias(self) -> float:
        """How far off the wall the path of finishing is planned, mm: in the middle of both tolerances."""
        return (self.outer_tolerance - self.inner_tolerance) / 2

    @property
    def tolerance(self) -> float:
        """How far a path may stray from the parallel of the flattened outline, mm."""
        return (self.outer_tolerance + self.inner_tolerance) / 2 - TOLERANCES.flatten


class Measured(Parameters):
    """What was read at the machine; the setup sheet says how."""

    x: Millimetres | None = Field(None, ge=-10000, le=10000, description="Machine X of the work offset.")
    y: Millimetres | None = Field(None, ge=-10000, le=10000, description="Machine Y of the work offset.")
    z: Millimetres | None = Field(None, ge=-10000, le=10000, description="Machine Z of the work offset.")
    lengths: dict[str, Annotated[Millimetres, Field(ge=-1000, le=1000)]] = Field(
        default_factory=dict, description="Tool name to its length offset H."
    )


class CamSettings(Parameters):
    """The table ``[cam]`` of a design file."""

    control: str = Field(
        "linuxcnc", min_length=1, max_length=40, description="Control that reads the program."
    )
    work_offset: WorkOffset = Field(
        "G54", description="Work offset: G54 to G59; G59.3, G54.1 P48 or G154 P99 where the control has it."
    )
    origin: Literal["axis", "corner", "centre"] = Field(
        "axis", description="X and Y zero: the part's axis, the stock's lower left corner, or its centre."
    )
    tools: tuple[str, ...] = Field(
        (), description="Names of the cutters to use; empty: chosen from the library."
    )
    tool_library: str = Field("", max_length=200, description="A tool library beside the design file.")
    cutting: dict[str, CuttingChange] = Field(
        default_factory=dict, description="Tool name to cutting data, over those of the library."
    )
    machine: Machine = Field(Machine(), description="The mill.")
    post: Posting = Field(Posting(), description="How the program is written.")
    second_side: SecondSide = Field(SecondSide(), description="The second side.")
    measured: Measured = Field(Measured(), description="Offsets as measured.")
    stock: Stock = Field(Stock(), description="The plate.")
    hold: Hold = Field(Hold(), description="How the part is held.")
    nest: Nesting | None = Field(None, description="A table [cam.nest] puts several parts on one plate.")
    climb: bool = Field(True, description="Climb milling; false cuts conventionally.")
    coolant: Literal["flood", "mist", "off"] = Field("flood", description="Coolant while cutting.")
    clearance: Millimetres = Field(
        5.0, ge=LEAST_CLEARANCE, le=200, description="Height of rapids over stock and clamp."
    )
    breakthrough: Millimetres = Field(0.3, ge=0, le=5, description="How far through cuts go below the part.")
    stock_to_leave: Millimetres = Field(0.2, ge=0, le=5, description="Left on walls by roughing.")
    floor_to_leave: Millimetres = Field(
        0.2, ge=0, le=5, description="Left on floors of recesses by roughing; at most half of the depth."
    )
    path: PathSettings = Field(PathSettings(), description="Accuracy of walls, and lines and arcs.")
    spring_passes: int = Field(1, ge=0, le=5, description="Repeats of the last finishing pass.")
    finish_step: Ratio = Field(
        2.0,
        gt=0,
        le=10,
        description="Deepest finishing pass in cutter diameters; less where much is left for a fine mill.",
    )
    compensation: Compensation = Field(
        "computer",
        description="Where finishing allows for the cutter's radius: in the path, at the control (G41, G42 "
        "with the radius in D), or in the path with its wear at the control.",
    )
    wear_limit: Millimetres = Field(
        0.1,
        ge=0.01,
        le=1,
        description="By so much D may differ from the planned one, up or down, as a radius.",
    )
    corner_mill: Millimetres = Field(
        2.0, ge=0.1, le=20, description="No smaller end mill is chosen for the sake of sharp inside corners."
    )
    chip_thinning: bool = Field(
        True, description="Raise the feed where a small engagement makes chips thinner than planned."
    )
    clearing: Literal["contour", "adaptive"] = Field(
        "contour",
        description="How recesses and openings are roughed: along their walls, or with bounded engagement.",
    )
    engagement: Degrees = Field(
        60.0, ge=30, le=120, description="Greatest engagement of a cutter in adaptive clearing."
    )
    adaptive_depth: Ratio = Field(
        1.5, gt=0, le=5, description="Depth of an adaptive pass in cutter diameters."
    )
    ramp_angle: Degrees = Field(3.0, gt=0, le=45, description="Steepest ramp or helix entry.")
