"""The design table of a slider-crank."""

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.mechanics.planar.course import MOST_RATIO
from mechwright.units import Degrees, Millimetres, Newtons, Ratio, RevPerMin, Unit
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank

LONGEST = 2000.0
"""mm. Longer links are structures, not plates."""


class SliderCrankParams(Parameters):
    """A crank, a rod and a slider on a straight guide, all from plates.

    Sizes of the plates that are left out follow from the crank; ``check`` says what cannot be built.

    Examples
    --------
    >>> SliderCrankParams(crank=50, rod=150, offset=20).linkage.offset
    20.0
    """

    also: ClassVar[Mapping[str, str]] = {
        "stroke": "without an offset twice the crank; mechwright synthesize finds designs of a stroke",
        "conrod": "it is called rod",
        "connecting_rod": "it is called rod",
        "coupler": "it is called rod",
        "eccentricity": "it is called offset",
        "crank_radius": "it is called crank",
        "crank_length": "it is called crank",
        "rod_length": "it is called rod",
        "pin_diameter": "it is called pin",
    }

    crank: Millimetres = Field(
        30.0, ge=0.5, le=LONGEST, description="Length a of the crank, pivot to pin.", json_schema_extra=FIRST
    )
    rod: Millimetres = Field(
        100.0, ge=1, le=LONGEST, description="Length c of the rod, pin to pin.", json_schema_extra=FIRST
    )
    offset: Millimetres = Field(
        10.0,
        ge=-LONGEST,
        le=LONGEST,
        description="Offset e of the slide line, to the left of its direction.",
        json_schema_extra=FIRST,
    )
    slide_direction: Degrees = Field(0.0, ge=-360, le=360, description="Direction of the slide.")
    assembly: Literal["ahead", "behind"] = Field(
        "ahead", description="Whether the slider stands ahead of the crank pin along the slide, or behind it."
    )
    speed: RevPerMin = Field(
        60.0,
        ge=0.001,
        le=20000,
        description="Speed of the crank; of a lever, swings there and back in a minute.",
        json_schema_extra=FIRST,
    )
    acceleration_ratio: Ratio = Field(
        0.0,
        ge=-MOST_RATIO,
        le=MOST_RATIO,
        description="Acceleration of the crank over the square of its speed, per radian, counter-clockwise "
        "positive, constant over the turn; speed is then that at its start.",
    )
    clockwise: bool = Field(False, description="Whether the crank turns clockwise, or a lever begins so.")
    swing_from: Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None = Field(
        None,
        description="One end of the swing of a crank that is a lever, counter-clockwise from X. Default: it "
        "turns fully, or goes as far as it can.",
    )
    swing_to: Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None = Field(
        None, description="The other end of that swing."
    )
    load: Newtons = Field(
        0.0,
        ge=-1e6,
        le=1e6,
        description="Force on the slider along the slide; negative against its direction.",
        json_schema_extra=FIRST,
    )
    coupler_x: Annotated[float, Field(ge=-LONGEST, le=LONGEST), Unit("mm")] | None = Field(
        None, description="Coupler point along the rod from the crank pin. Default: the rod's middle."
    )
    coupler_y: Millimetres = Field(
        0.0, ge=-LONGEST, le=LONGEST, description="Coupler point to the left of the rod."
    )
    coupler_bore: Millimetres = Field(
        0.0,
        ge=0,
        le=100,
        description="Bore in the coupler point, which the rod then reaches out to; 0: none.",
    )
    thickness: Millimetres = Field(
        6.0, ge=0.5, le=100, description="Thickness of all plates.", json_schema_extra=FIRST
    )
    material: MaterialName = Field(
        "aluminium", description="Material of the plates.", json_schema_extra=FIRST
    )
    crank_shape: Literal["disc", "arm"] = Field("disc", description="Whether the crank is a disc or an arm.")
    pin: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Diameter of both joint pins. Default: an eighth of the crank, 2 to 20, or for short "
        "ones 1.5 or 1; thicker where the load asks for it and the crank has room.",
    )
    shaft: Annotated[float, Field(ge=1, le=300), Unit("mm")] | None = Field(
        None, description="Diameter of the crank's shaft. Default: one and a half pins."
    )
    bushing: Millimetres = Field(
        1.0, ge=0, le=20, description="Wall of the bushings in rod and base; 0 for none."
    )
    wall: Annotated[float, Field(ge=0.5, le=200), Unit("mm")] | None = Field(
        None, description="Material around the bores. Default: half a pin, at least 2."
    )
    rod_width: Annotated[float, Field(ge=0.5, le=400), Unit("mm")] | None = Field(
        None, description="Width of the rod between its bosses. Default: as wide as they are."
    )
    rod_bend: Millimetres = Field(
        0.0, ge=-LONGEST, le=LONGEST, description="How far a bent rod leaves the straight line, to its left."
    )
    slider_length: Annotated[float, Field(ge=1, le=LONGEST), Unit("mm")] | None = Field(
        None, description="Length of the slider along the guide. Default: one and a half times its width."
    )
    slider_width: Annotated[float, Field(ge=1, le=LONGEST), Unit("mm")] | None = Field(
        None, description="Width of the slider between the rails. Default: a pin and four walls."
    )
    rail: Annotated[float, Field(ge=1, le=400), Unit("mm")] | None = Field(
        None, description="Width of the guide's rails. Default: a dowel of 0.6 pins and two walls."
    )
    rail_overhang: Annotated[float, Field(ge=1, le=LONGEST), Unit("mm")] | None = Field(
        None,
        description="How far the rails go on beyond the slider's ends. Default: by their width, or until "
        "their dowels stand outside of the crank's way where the layers need it.",
    )
    screw_hole: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Diameter of holes in the corners of the base, which then goes on legs: it reaches under "
        "all that moves, and the shaft's end fits a coupling. Default: none.",
    )
    screw_offset: Annotated[float, Field(ge=1, le=10000), Unit("mm")] | None = Field(
        None,
        description="Least distance of these holes from the line through the crank's pivot along the slide. "
        "Default: beside all that moves.",
    )
    play: Millimetres = Field(0.05, ge=0, le=2, description="Play of the slider on each side.")
    gap: Millimetres = Field(0.3, ge=0, le=20, description="Air between plates of neighbouring layers.")
    clearance: Millimetres = Field(
        1.0, ge=0, le=100, description="Least distance of moving plates of one layer in plan."
    )

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.swing_from is None) != (self.swing_to is None):
            raise ValueError("give both swing_from and swing_to, or neither")
        if self.swing_from is not None and self.swing_from == self.swing_to:
            raise ValueError("swing_from and swing_to are the same angle, so nothing moves; give two")
        if self.swing_from is not None and self.clockwise:
            raise ValueError("clockwise is for a crank without a swing; exchange swing_from and swing_to")
        return self

    @property
    def linkage(self) -> SliderCrank:
        """The linkage, angles in rad."""
        branch = 1 if self.assembly == "ahead" else -1
        direction = self.slide_direction * (math.pi / 180)
        return SliderCrank(self.crank, self.rod, self.offset, direction, branch)

    @property
    def coupler_point(self) -> complex:
        """The coupler point in the rod's coordinates, mm."""
        return (self.rod / 2 if self.coupler_x is None else self.coupler_x) + 1j * self.coupler_y
