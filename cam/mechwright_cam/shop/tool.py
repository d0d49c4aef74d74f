"""Cutters, and how they cut a material."""

import math
from collections.abc import Iterable
from enum import StrEnum
from typing import Annotated, Any, Literal, Self

from pydantic import Field, field_validator, model_validator

from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.parameters import Parameters
from mechwright.units import Degrees, MetresPerMin, Millimetres, Ratio, convert


class ToolKind(StrEnum):
    """Kinds of cutter that the program can use."""

    END_MILL = "end-mill"
    DRILL = "drill"
    SPOT_DRILL = "spot-drill"
    BULL_NOSE = "bull-nose"
    BALL = "ball"
    CHAMFER = "chamfer-mill"
    THREAD_MILL = "thread-mill"
    REAMER = "reamer"
    TAP = "tap"


MILLS = frozenset({ToolKind.END_MILL, ToolKind.BULL_NOSE, ToolKind.BALL})
"""Cutters that clear and finish with end and side."""


HOLLOW = frozenset({ToolKind.CHAMFER, ToolKind.THREAD_MILL, ToolKind.REAMER, ToolKind.TAP})
"""Tools that by default do not cut with their middle."""
NECK = 0.7
"""Diameter of a thread mill's neck in that of its teeth, if nothing is said of it: then the teeth are higher
by a third than the coarsest thread for that diameter asks."""
BLUNT_TIP = 0.05
"""Radius of the point of a chamfer mill that is ground to one, mm: there it presses and does not cut."""

TAP_ROOT = 0.6134
"""How far in from its rim the teeth of a tap reach, in pitches: the height of an external thread (ASME B1.1;
ISO 724 alike). With less room the tap's core meets the wall, and it breaks."""
REAMER_LEAD = 0.9
"""Length of a reamer's lead, mm, of 45 degrees: what it has passed alone is not to size yet."""
TAP_POINT = 0.7
"""How far in from its rim a tap's point is, in pitches: its first tooth cuts nothing yet."""

SAME_LEAD = 1e-3
"""By this share the feed per turn of a tap in a library may differ from its pitch: rounded digits."""

REAMED = 0.26
"""How far in from its rim a reamer cuts, mm: half of the greatest allowance, and a last digit."""


GRIP = 12.0
"""Least length of shank in a collet, mm."""


class CuttingData(Parameters):
    """How a tool cuts one material."""

    cutting_speed: MetresPerMin = Field(gt=0, le=2000, description="Speed of the cutting edge.")
    chip_load: Millimetres = Field(gt=0, le=2, description="Feed per tooth; per lip for a drill.")
    step_down: Ratio = Field(
        0.5, gt=0, le=5, description="Depth of one roughing pass, or of one peck, in diameters."
    )
    step_over: Ratio = Field(0.4, gt=0, le=1, description="Width of one roughing pass, in diameters.")
    plunge: Ratio = Field(
        0.3, gt=0, le=1, description="Feed of a mill straight down into material, in that of its chip load."
    )


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
    plunge: Ratio | None = Field(
        None, gt=0, le=1, description="Feed of a mill straight down into material, in that of its chip load."
    )


class CuttingTable(dict[str, CuttingData]):
    """Cutting data by material; a grade without any is cut as its group, at its own pace.

    >>> table = CuttingTable(steel=CuttingData(cutting_speed=100, chip_load=0.02))
    >>> table["1.4301"].cutting_speed, "C45" in table, "7075" in table
    (60.0, True, False)
    """

    estimated: frozenset[str] = frozenset()
    """Materials whose data nobody has given."""

    def __missing__(self, name: str) -> CuttingData:
        known = MATERIALS.get(name)
        if known is None or known.group == name:
            raise KeyError(name)
        found = self[known.group]
        return found.model_copy(update={"cutting_speed": round(known.pace * found.cutting_speed, 6)})

    def __contains__(self, name: object) -> bool:
        known = MATERIALS.get(name) if isinstance(name, str) else None
        return super().__contains__(name) or (known is not None and super().__contains__(known.group))


class Tool(Parameters):
    """A cutter in its holder."""

    name: str = Field(min_length=1, max_length=40, pattern=r"^[a-z0-9][a-z0-9_.-]*$", description="Its name.")
    number: int = Field(ge=1, le=9999, description="T number; the length offset H is the same.")
    kind: ToolKind = Field(description="Kind of tool.")
    diameter: Millimetres = Field(gt=0, le=100, description="Cutting diameter.")
    flutes: int = Field(2, ge=1, le=12, description="Number of cutting edges.")
    flute_length: Millimetres = Field(gt=0, le=300, description="How deep it can cut.")
    centre_cutting: bool = Field(
        True,
        description="Whether its middle cuts, so that it may be plunged straight down; by default that of "
        "all does but of chamfer and thread mills, reamers and taps.",
    )
    ramp_angle: Degrees | None = Field(
        None, gt=0, le=90, description="Steepest ramp into full material, if its maker says one."
    )
    point_angle: Degrees = Field(
        118.0, gt=30, le=180, description="Full angle of a drill's point, or of a chamfer mill."
    )
    corner_radius: Millimetres = Field(0.0, ge=0, le=50, description="Radius of a bull-nose mill's corner.")
    tip_diameter: Millimetres = Field(0.0, ge=0, le=50, description="Flat at the tip of a chamfer mill.")
    neck_diameter: Millimetres | None = Field(
        None,
        gt=0,
        le=100,
        description="Diameter of a thread mill behind its teeth; by default 0.7 of it.",
    )
    pitch: Millimetres | None = Field(
        None, gt=0, le=10, description="Pitch of a tap; its diameter is that of the thread."
    )
    chamfer_length: Ratio = Field(
        4.0, ge=1, le=10, description="Length of a tap's chamfer in pitches: 2 bottoming, 4 plug, 8 taper."
    )
    left_hand: bool = Field(
        False, description="Whether a tap cuts left-hand threads, turning backwards (M4)."
    )
    floating: bool = Field(
        False,
        description="Whether a tap is in a floating holder, which gives way along its axis; without one the "
        "control has to keep feed and spindle together.",
    )
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
    overall: Millimetres | None = Field(
        None, gt=0, le=400, description="Its whole length, if known: the collet needs 12 of it."
    )
    holder: str = Field("", max_length=40, description="Its holder, as the setup sheet names it.")
    purpose: str = Field("", max_length=80, description="Purpose, as lists and sheets print it.")
    wear_length: Millimetres = Field(
        0.0, ge=-2, le=2, description="Wear of its length, below 0 for one that is shorter than measured."
    )
    wear_diameter: Millimetres = Field(
        0.0, ge=-2, le=2, description="Wear of its diameter, below 0 for one that has become thinner."
    )
    life: Annotated[Ratio, Field(gt=0, le=10000)] | None = Field(
        None, description="Minutes in cut after which an edge is worn."
    )
    substrate: Literal["carbide", "hss"] = Field("carbide", description="Material of the cutting edge.")
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

    @field_validator("cutting", mode="after")
    @classmethod
    def _by_group(cls, said: dict[str, CuttingData]) -> dict[str, CuttingData]:
        return CuttingTable(said)

    @model_validator(mode="before")
    @classmethod
    def _middle(cls, said: Any) -> Any:
        if not isinstance(said, dict) or said.get("kind") not in HOLLOW:
            return said
        said = {"centre_cutting": False, **said}
        if said["kind"] == ToolKind.TAP and isinstance(said.get("cutting"), dict):
            said["cutting"] = {name: _led(said, data) for name, data in said["cutting"].items()}
        return said

    @model_validator(mode="after")
    def _shape(self) -> Self:
        if self.neck_diameter is not None and (
            self.kind is not ToolKind.THREAD_MILL or self.neck_diameter >= self.diameter
        ):
            raise ValueError("neck_diameter is that of a thread mill, and below its diameter")
        if self.kind is ToolKind.TAP:
            self._tap()
        elif {"pitch", "chamfer_length", "left_hand", "floating"} & self.model_fields_set - _plain(self):
            raise ValueError("pitch, chamfer_length, left_hand and floating are those of a tap")
        if self.kind in {ToolKind.THREAD_MILL, ToolKind.REAMER, ToolKind.TAP} and self.centre_cutting:
            what = str(self.kind).replace("-", " ")
            raise ValueError(f"a {what} cuts with the teeth at its rim; leave centre_cutting out")
        if self.corner_radius > self.diameter / 2:
            raise ValueError("corner_radius must be at most half of the diameter")
        if self.tip_diameter >= self.diameter:
            raise ValueError("tip_diameter must be below the diameter")
        if (self.kind is ToolKind.BULL_NOSE) != (self.corner_radius > 0):
            raise ValueError("a bull-nose mill has a corner_radius, and no other tool has one")
        if self.stick_out is not None and self.stick_out < self.flute_length:
            raise ValueError("stick_out must be at least flute_length: flutes do not cut inside the holder")
        if self.overall is not None and self.overall - GRIP < (self.stick_out or self.flute_length):
            raise ValueError(
                f"overall leaves less than {GRIP:g} mm for the collet: it holds on the shank alone"
            )
        return self

    def _tap(self) -> None:
        if self.pitch is None or not self.pitch < self.diameter / 2:
            raise ValueError("a tap needs its pitch, below half of its diameter")
        if self.chamfer_length * self.pitch >= self.flute_length:
            raise ValueError("the chamfer of a tap is shorter than its flute_length")
        for name, data in self.cutting.items():
            if abs(data.chip_load * self.flutes - self.pitch) > SAME_LEAD * self.pitch:
                raise ValueError(
                    f"in {name} the chip_load of a tap is its pitch over its flutes, "
                    f"{self.pitch / self.flutes:g} mm; leave it out"
                )

    def is_estimated(self, name: str) -> bool:
        """Whether its cutting data for a material are an estimate."""
        return isinstance(self.cutting, CuttingTable) and name in self.cutting.estimated

    @property
    def longest_stick_out(self) -> float:
        """Greatest length out of the holder, mm; infinite where its length is not known."""
        if self.stick_out is not None:
            return self.stick_out
        return math.inf if self.overall is None else self.overall - GRIP

    @property
    def point_length(self) -> float:
        """Length of a tap's chamfer, mm: so far above its tip the thread is full; 0 of what is no tap."""
        return 0.0 if self.pitch is None else self.chamfer_length * self.pitch

    @property
    def radius(self) -> float:
        """Half the diameter, mm."""
        return self.diameter / 2

    @property
    def d_number(self) -> int:
        """D number of its cutter compensation."""
        return self.number if self.diameter_offset is None else self.diameter_offset

    @property
    def worn_length(self) -> float:
        """Length offset with its wear, mm, for tables of one column; that of an unmeasured tool is 0."""
        return 0.0 if self.length is None else self.length + self.wear_length

    @property
    def nose(self) -> float:
        """Radius of the rounded corner between end and side, mm: 0 for a flat end, the radius for a ball."""
        return self.radius if self.kind is ToolKind.BALL else self.corner_radius

    @property
    def hollow(self) -> float:
        """Radius, mm, within which its end does not cut: 0 if it is centre-cutting.

        That of a thread mill's neck, a chamfer mill's tip, a tap's root, or within a reamer's allowance; of
        other mills it is not known, and they may ramp.
        """
        if self.kind is ToolKind.THREAD_MILL:
            return NECK * self.radius if self.neck_diameter is None else self.neck_diameter / 2
        if self.kind is ToolKind.CHAMFER and not self.centre_cutting:
            return max(self.tip_diameter / 2, BLUNT_TIP)
        if self.kind is ToolKind.REAMER:
            return max(self.radius - REAMED, 0.0)
        if self.pitch is not None:
            return self.radius - TAP_ROOT * self.pitch
        return 0.0


def _plain(tool: Tool) -> set[str]:
    """The keys of a tap that say of another tool what is so anyway, as files that are written say all."""
    fields = Tool.model_fields
    return {name for name in fields if getattr(tool, name) == fields[name].default}


def _led(tap: dict[str, Any], data: Any) -> Any:
    """Cutting data of a tap: its feed per tooth follows from its pitch."""
    pitch, flutes = tap.get("pitch"), tap.get("flutes", 2)
    if not isinstance(data, dict) or "chip_load" in data:
        return data
    try:
        lead = convert(pitch, "mm") if isinstance(pitch, str) else float(pitch or 0)
        return {"chip_load": lead / int(flutes), **data}
    except (TypeError, ValueError, ZeroDivisionError):
        return data  # what is wrong with them is told of themselves


def widest_mill(tools: Iterable[Tool]) -> float:
    """Diameter of the widest mill among some tools, mm; 0 without any."""
    return max((tool.diameter for tool in tools if tool.kind in MILLS), default=0.0)
