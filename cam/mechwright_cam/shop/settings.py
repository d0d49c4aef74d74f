"""Cutters, machines, stock and holding: the tables under ``[cam]`` of a design file, and the tool library."""

import datetime as dt
from typing import Literal, Self

from pydantic import Field, model_validator

from mechwright.contracts.fits import HoleClass
from mechwright.contracts.marking import LEAST_HEIGHT
from mechwright.contracts.parameters import FIRST, Parameters
from mechwright.tolerances import TOLERANCES, falls_short
from mechwright.units import Degrees, Millimetres, Ratio
from mechwright_cam.shop.holding import Hold, Nesting, SecondSide, Stock
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import (
    LEAST_CLEARANCE,
    Compensation,
    MachinePlace,
    Measured,
    Posting,
    Probe,
    Setter,
    WorkOffset,
)
from mechwright_cam.shop.tool import CuttingChange

DEEPEST_INTO = round(TOLERANCES.gouge - TOLERANCES.flatten, 6)  # no tail of floating point in messages
"""Most that a wall may be asked to be too deep, mm: what chords of outlines leave of the permitted gouge."""

LEAST_ZONE = 2 * (TOLERANCES.outline + TOLERANCES.flatten)
"""Least width of the zone in which a wall may lie, mm: less would leave chords of outline and offset, and the
fit, no room."""

MOST_OFF = TOLERANCES.leftover - TOLERANCES.arc_fit
"""Most that may, mm: the corners of a larger cutter need the rest of the permitted leftover."""


class PathSettings(Parameters):
    """How exact the finished walls are, and what their paths are made of."""

    inner_tolerance: Millimetres = Field(
        TOLERANCES.outline, ge=0, le=DEEPEST_INTO, description="Deepest cut of finishing into a wall."
    )
    outer_tolerance: Millimetres = Field(
        2 * (TOLERANCES.arc_fit + TOLERANCES.flatten) - TOLERANCES.outline,
        ge=LEAST_ZONE / 2,
        le=MOST_OFF,
        description="Thickest stock that finishing may leave on a wall; at least inner_tolerance.",
    )
    lines_per_arc: int = Field(1, ge=1, le=100, description="Least number of lines that one arc replaces.")

    @model_validator(mode="after")
    def _outwards(self) -> Self:
        if self.outer_tolerance < self.inner_tolerance:
            raise ValueError(
                f"outer_tolerance {self.outer_tolerance:g} is below inner_tolerance "
                f"{self.inner_tolerance:g}; paths stay off walls, so give it at least as much"
            )
        if falls_short(self.outer_tolerance + self.inner_tolerance, LEAST_ZONE):
            raise ValueError(
                f"inner_tolerance {self.inner_tolerance:g} and outer_tolerance {self.outer_tolerance:g} are "
                f"together below {LEAST_ZONE:g}, which chords and arcs need; give outer_tolerance "
                f"{LEAST_ZONE - self.inner_tolerance:g}"
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


class Sheet(Parameters):
    """What the setup sheets say of themselves."""

    revision: str = Field("", max_length=20, description="Revision of the drawing or program, such as B.")
    date: dt.date | None = Field(None, description="Date on the sheets; none by default.")


class CamSettings(Parameters):
    """The table ``[cam]`` of a design file."""

    control: str = Field(
        "linuxcnc",
        min_length=1,
        max_length=40,
        description="Control that reads the program.",
        json_schema_extra=FIRST,
    )
    work_offset: WorkOffset = Field(
        "G54",
        description="Work offset: G54 to G59; G59.3, G54.1 P48 or G154 P99 where the control has it.",
        json_schema_extra=FIRST,
    )
    more_offsets: tuple[WorkOffset, ...] = Field(
        (),
        description="Further work offsets, each with a plate of its own; one tool change serves all.",
        json_schema_extra=FIRST,
    )
    origin: Literal["axis", "corner", "centre"] = Field(
        "axis",
        description="X and Y zero: the part's axis, the stock's lower left corner, or its centre.",
        json_schema_extra=FIRST,
    )
    tools: tuple[str, ...] = Field(
        (),
        description="Names of the cutters to use; empty: chosen from the library.",
        json_schema_extra=FIRST,
    )
    operations: tuple[str, ...] = Field(
        (), description="Names of operations that are tried before the built-in ones."
    )
    tool_library: str = Field("", max_length=200, description="A tool library beside the design file.")
    cutting: dict[str, CuttingChange] = Field(
        default_factory=dict, description="Tool name to cutting data, over those of the library."
    )
    machine: Machine = Field(Machine(), description="The mill.")
    post: Posting = Field(Posting(), description="How the program is written.")
    sheet: Sheet = Field(Sheet(), description="Revision and date on the setup sheets.")
    second_side: SecondSide = Field(SecondSide(), description="The second side.")
    probe: Probe = Field(Probe(), description="The touch probe.")
    setter: Setter = Field(Setter(), description="The tool setter.")
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
    stock_to_leave: Millimetres = Field(0.2, ge=0, le=5, description="Stock that roughing leaves on walls.")
    floor_to_leave: Millimetres = Field(
        0.2, ge=0, le=5, description="Stock that roughing leaves on floors; at most half of the depth."
    )
    path: PathSettings = Field(PathSettings(), description="Accuracy of walls, and lines and arcs.")
    spring_passes: int = Field(1, ge=0, le=5, description="Repeats of the last finishing pass.")
    finish_step: Ratio | None = Field(
        None,
        gt=0,
        le=10,
        description="Deepest finishing pass in cutter diameters; by default one pass for the whole wall "
        "where the cutter bears it, else passes of 2.",
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
        description="Largest difference, in mm of radius, between D in the control and the planned D.",
    )
    corner_mill: Millimetres = Field(
        2.0,
        ge=0.1,
        le=20,
        description="Smallest end mill that is chosen for sharp inside corners; by default 1 or 0.5 where "
        "parts that are cut with larger ones would not fit together.",
    )
    chip_thinning: bool = Field(
        True, description="Raise the feed where a small engagement makes chips thinner than planned."
    )
    clearing: Literal["contour", "adaptive"] = Field(
        "contour",
        description="How recesses and openings are roughed: along their walls, or with bounded engagement.",
    )
    outsides: Literal["contour", "adaptive", "faster"] = Field(
        "contour",
        description="How the channel around an outside is roughed: with the mill's full width, in a wider "
        "channel with bounded engagement, or the faster of both.",
    )
    engagement: Degrees = Field(
        60.0, ge=30, le=120, description="Greatest engagement of a cutter in adaptive clearing."
    )
    adaptive_depth: Ratio = Field(
        1.5, gt=0, le=5, description="Depth of an adaptive pass in cutter diameters."
    )
    deburr: Millimetres = Field(
        0.0, ge=0, le=5, description="Width of a chamfer on all edges of the top face; 0 for none."
    )
    mark: str = Field(
        "",
        max_length=60,
        description="Text engraved where the top face has most room; {part} stands for the part's name.",
    )
    mark_height: Millimetres = Field(4.0, ge=LEAST_HEIGHT, le=100, description="Height of its capitals.")
    mark_depth: Millimetres = Field(0.2, gt=0, le=2, description="Depth of its lines.")
    mark_line: Millimetres = Field(
        0.6, ge=0.1, le=5, description="Greatest width of its lines; at least half of it is cut."
    )
    fitting_marks: bool = Field(False, description="Engrave dots that show how parts stand to each other.")
    ramp_angle: Degrees = Field(3.0, gt=0, le=45, description="Steepest ramp or helix entry.")

    @model_validator(mode="after")
    def _offsets_once(self) -> Self:
        for place, offset in enumerate(self.offsets):
            if offset in self.offsets[:place]:
                raise ValueError(
                    f"more_offsets: {offset} is named twice; give each plate a work offset of its own"
                )
        for offset in self.measured.more:
            if offset not in self.more_offsets:
                raise ValueError(
                    f"measured.more: {offset} is none of more_offsets; name it there, or leave it out"
                )
        return self

    @property
    def adaptive(self) -> bool:
        """Whether anything is cleared with bounded engagement."""
        return "adaptive" in {self.clearing, self.outsides}

    @property
    def offsets(self) -> tuple[str, ...]:
        """The work offsets at which the same is milled, each once."""
        return (self.work_offset, *self.more_offsets)

    def at(self, offset: str) -> Self:
        """The same seen from another of its work offsets, whose place is that measured for it."""
        if offset == self.work_offset:
            return self
        own = MachinePlace(x=self.measured.x, y=self.measured.y, z=self.measured.z)
        rest = {other: place for other, place in self.measured.more.items() if other != offset}
        measured = self.measured.of(offset).model_copy(update={"more": {self.work_offset: own, **rest}})
        others = tuple(other for other in self.offsets if other != offset)
        return self.model_copy(update={"work_offset": offset, "more_offsets": others, "measured": measured})


class Hole(Parameters):
    """A table ``[cam.part.NAME.holes.HOLE]``: what becomes of a round hole."""

    screw: str | None = Field(
        None,
        max_length=30,
        description="Screw whose head it takes: ISO 4762 M6 (counterbore), ISO 10642 M6 (countersink), "
        "ASME B18.3 1/4; the hole gets the clearance of its shank.",
    )

    fit: HoleClass | None = Field(None, description="ISO 286 class to whose middle the hole is made.")
    thread: str | None = Field(
        None,
        max_length=20,
        description="Thread, such as M6, M6x0.75, 1/4-20 UNC or M6 LH; the hole gets its core diameter.",
    )
    depth: Millimetres | None = Field(
        None, gt=0, le=500, description="Depth of the thread; by default all of the hole."
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if sum(one is not None for one in (self.fit, self.thread, self.screw)) != 1:
            raise ValueError("give it a fit or a thread, one of the two, or a screw")
        if self.depth is not None and self.thread is None:
            raise ValueError("depth is that of a thread; leave depth out")
        return self


class PartSettings(CamSettings):
    """A table ``[cam.part.NAME]``, laid over ``[cam]``."""

    holes: dict[str, Hole] = Field(
        default_factory=dict, description="Name of a round hole to its fit or thread."
    )
