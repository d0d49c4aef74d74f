"""The tables of a design that say how the links of a spherical linkage are made."""

from typing import Annotated, Literal

from pydantic import Field

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.units import Degrees, Millimetres, Ratio, Unit


class HardwareTable(Parameters):
    """Sizes of the links. They lie on concentric shells, the coupler on the innermost one."""

    standoff: Millimetres = Field(5.0, ge=0, le=200, description="From the sphere to the coupler's shell.")
    link_thickness: Millimetres = Field(
        5.0, ge=0.5, le=100, description="Thickness of the links, radially.", json_schema_extra=FIRST
    )
    link_width: Millimetres = Field(
        8.0,
        ge=1,
        le=200,
        description="Width of the links, across. Default: less where links or pins have no room.",
        json_schema_extra={**FIRST, **FITTED},
    )
    section: Literal["rectangle", "shell"] = Field(
        "rectangle",
        description="Section of the arcs: flat to both sides, or a true strip of a spherical shell.",
    )
    boss_diameter: Millimetres = Field(
        12.0,
        ge=2,
        le=200,
        description="Diameter of the bosses around the pins. Default: less where they have no room, and "
        "more about thick pins.",
        json_schema_extra=FITTED,
    )
    boss_height: Millimetres = Field(
        0.5, ge=0, le=50, description="How far bosses rise over the link, each side."
    )
    pin_diameter: Millimetres = Field(
        6.0,
        ge=1,
        le=100,
        description="Diameter of pins and shafts. Default: less where they have no room.",
        json_schema_extra={**FIRST, **FITTED},
    )
    fit: Millimetres = Field(
        0.05, ge=0, le=1, description="How much wider bores and slots are than their pins."
    )
    gap: Millimetres = Field(1.5, ge=0.05, le=50, description="Between the shells, radially.")
    frame: Literal["auto", "one", "two"] = Field(
        "auto",
        description="Ground of a four-bar: outside the links, on both sides, or outside where that goes.",
    )
    material: MaterialName = Field(
        "aluminium", description="Material of links and base.", json_schema_extra=FIRST
    )
    pin_material: MaterialName = Field("steel", description="Material of pins and drive.")


class StandTable(Parameters):
    """The frame's foot: the ground link goes on beyond the crank's axis to a post and a base plate."""

    arc: Degrees = Field(
        40.0, ge=5, le=170, description="From the input axis to the post, away from the other one."
    )
    height: Millimetres = Field(40.0, ge=2, le=1000, description="Of the post over the ground link.")
    plate: Millimetres = Field(80.0, ge=10, le=1000, description="Side of the square base plate.")
    plate_thickness: Millimetres = Field(8.0, ge=1, le=100, description="Thickness of the base plate.")
    motor_flange: Annotated[float, Field(ge=20, le=300), Unit("mm")] | None = Field(
        None,
        description="Side of the square of screws in a flange about the input axis, on which a motor goes; "
        "both fixed axes then have bushes. Default: there is none.",
    )
    screw: Millimetres = Field(6.6, ge=1, le=50, description="Diameter of the screw holes in the base plate.")


class DriveTable(Parameters):
    """The bevel drive from crank to arm of a five-bar, as pitch cones outside the ground link."""

    gears: bool = Field(True, description="Whether there are gears; false if two motors drive.")
    share: Ratio = Field(
        0.85,
        ge=0.2,
        le=0.98,
        description="Size of the gears of a pair with idler: part of what the shafts leave.",
    )
    idler: Degrees = Field(5.0, ge=1, le=45, description="Pitch cone angle of the idler.")
    face_width: Millimetres = Field(10.0, ge=1, le=200, description="Face width, along the cones.")


class FlatTable(Parameters):
    """Links as flat strips, to be cut on a two-axis mill and bent."""

    make: bool | None = Field(
        None,
        description="Whether drawings and programs of the strips are made. Default: where all can be bent.",
    )
    thickness: Millimetres = Field(3.0, ge=0.3, le=20, description="Thickness of the strips.")
    bend_radius: Millimetres = Field(3.0, ge=0.1, le=50, description="Inside radius of the bends.")
    neutral: Ratio = Field(
        0.4,
        ge=0.2,
        le=0.5,
        description="Place of the neutral fibre in the thickness, from the inside: the K factor.",
    )
