"""The keys of the table ``[machine]`` that a frame takes."""

from typing import Annotated, Literal

from pydantic import Field

from mechwright.contracts.materials import MaterialName
from mechwright.contracts.parameters import FIRST, Parameters
from mechwright.units import Millimetres, Unit

FrameName = Literal["none", "plate", "plates", "base"]
BearingSeries = Literal["auto", "62", "60", "619", "618"]
Arrangement = Literal["floating", "locating-free"]


class FrameKeys(Parameters):
    """What a workshop chooses of a frame; the rest follows from the mechanism."""

    frame: FrameName = Field(
        "none",
        description=(
            "Support of the shafts. plate: the mechanism's own ground plate, the motor behind it; plates: "
            "two bearing plates on pillars; base: either of them on legs over a base plate, with the motor."
        ),
        json_schema_extra=FIRST,
    )
    bearing: BearingSeries = Field(
        "auto",
        description=(
            "Series of the ball bearings: 62 is the heaviest, 618 the thinnest; auto: the first that fits."
        ),
    )
    bearing_arrangement: Arrangement = Field(
        "floating",
        description=(
            "How two bearing plates hold a shaft along its axis. floating: each bearing holds it one way; "
            "locating-free: the lower bearing holds it both ways, and the outer ring of the upper one slides."
        ),
    )
    plate_thickness: Annotated[float, Field(ge=4, le=60), Unit("mm")] | None = Field(
        None, description="Of the bearing plates. Default: as their bearings need."
    )
    plates: tuple[Annotated[float, Field(ge=1, le=200), Unit("mm")], ...] = Field(
        (),
        max_length=100,
        description="Thicknesses of plate that are in hand; empty, as they are sold. The frame's plates take "
        "the least that will do.",
    )
    plate_material: MaterialName = Field("aluminium", description="Of all plates of the frame.")
    cover: bool = Field(
        False,
        description="Whether the plates reach over all that moves, so that nothing stands out sideways.",
    )
    guard: bool = Field(
        False,
        description="Whether rings of polycarbonate close the space between the bearing plates, so that no "
        "finger gets in.",
    )
    axial_gap: Millimetres = Field(
        2.0, ge=0.5, le=50, description="Least gap along the axes between what moves and the bearing plates."
    )
