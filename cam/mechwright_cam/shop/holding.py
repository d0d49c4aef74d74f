"""Stock, holding, nests and the second side: tables of ``[cam]``."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright.contracts.parameters import Parameters
from mechwright.units import Degrees, Millimetres
from mechwright_cam.shop.machine import Place
from mechwright_cam.shop.posting import WorkOffset

Length = Annotated[Millimetres, Field(ge=-10000, le=10000)]
ToeClamp = tuple[Length, Length, Length, Length, Length]
"""Least x and y, greatest x and y, and height z of the top, mm."""


class Stock(Parameters):
    """The plate that the part is cut from; as thick as the part.

    Its size is the part's plus the margin all round, unless length and width are given.
    """

    margin: Millimetres | None = Field(
        None,
        ge=0,
        le=200,
        description="Stock around the part; by default with a rim for clamps on two of its sides.",
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
        (), description="Names of the parts; empty: one nest of all parts for each material and thickness."
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

    method: Literal["tabs", "bore", "vice", "none"] = Field(
        "tabs",
        description="Tabs to the frame, a clamp through the bore, a vice on finished edges, or none of them: "
        "by bed and toe_clamps.",
    )
    bed: Literal["vacuum", "tape"] | None = Field(
        None, description='With method = "none": what holds the plate and all its pieces from below.'
    )
    toe_clamps: tuple[ToeClamp, ...] = Field(
        (),
        max_length=40,
        description='With method = "none": clamps on the plate, [x0, y0, x1, y1, top] in work coordinates.',
    )
    tabs: int = Field(4, ge=2, le=24, description="Number of tabs.")
    tab_width: Millimetres | None = Field(
        None, gt=0, le=50, description="Width of a tab along the contour; by default 2, less on small parts."
    )
    tab_height: Millimetres = Field(
        1.0,
        gt=0,
        le=20,
        description="Height of a tab above the underside; by default less in thin plates, beside recesses.",
    )
    tab_shape: Literal["rectangular", "ramped"] = Field(
        "rectangular", description="Upright sides, or slopes that the cutter follows without a stop."
    )
    tab_angle: Degrees = Field(15.0, ge=1, le=45, description="Slope of the sides of ramped tabs.")
    tab_places: Literal["planned", "found"] = Field(
        "planned",
        description="Whether the proof requires the planned tabs, or judges the size of those it finds.",
    )
    clamp_diameter: Millimetres = Field(
        20.0,
        gt=0,
        le=300,
        description="Largest diameter of the bore clamp; by default less on a part without room for it.",
    )
    clamp_height: Millimetres = Field(
        15.0, gt=0, le=200, description="Height of the bore clamp above the part."
    )
    grip: Millimetres | None = Field(
        None, ge=1, le=200, description="Height of the edges in the vice; by default half of the thickness."
    )
    jaw_width: Millimetres | None = Field(
        None, gt=0, le=1000, description="Width of the vice's jaws; by default as wide as there is room."
    )

    @model_validator(mode="after")
    def _by_something(self) -> Self:
        if self.method == "none":
            if self.bed is None and not self.toe_clamps:
                raise ValueError('method = "none" needs what holds instead; write bed or toe_clamps')
        elif self.bed is not None or self.toe_clamps:
            raise ValueError(f'bed and toe_clamps are for method = "none", and not for "{self.method}"')
        for x0, y0, x1, y1, top in self.toe_clamps:
            if not (x0 < x1 and y0 < y1 and top > 0):
                raise ValueError(
                    f"toe_clamps: [{x0:g}, {y0:g}, {x1:g}, {y1:g}, {top:g}] is no clamp on the plate; write "
                    "[x0, y0, x1, y1, top] with x0 below x1, y0 below y1 and top above 0"
                )
        return self


class SecondSide(Parameters):
    """How the plate is turned over for features that only the underside shows."""

    work_offset: WorkOffset = Field("G55", description="Work offset of the second side.")
    more_offsets: tuple[WorkOffset, ...] = Field(
        (), description="Further work offsets of second sides, each with a plate of its own."
    )
    flip: Literal["x", "y"] = Field("x", description="The plate is turned over about this axis.")
    locate: Literal["bore", "edges", "dowels"] = Field(
        "bore", description="Reference of X0 Y0: the largest bore, the plate's edges, or two dowels."
    )
    dowel_diameter: Millimetres = Field(
        6.0, ge=2, le=20, description="Diameter of the dowel holes, bored beside the part on the flip axis."
    )
    x: Place = Field(None, description="Machine X of its work offset, if measured.")
    y: Place = Field(None, description="Machine Y of its work offset, if measured.")
    z: Place = Field(None, description="Machine Z of its work offset, if measured.")

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if 0 < [self.x, self.y, self.z].count(None) < 3:
            raise ValueError("give x, y and z of the measured work offset, or none of them")
        if self.x is not None and self.more_offsets:
            raise ValueError("x, y and z are of one work offset; leave them out with more_offsets")
        return self
