"""The design table of a plate."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from mechwright import FIRST, InputFile, MaterialName, Parameters
from mechwright.drawings.asked import Asked, Origin
from mechwright.drawings.units import UnitName
from mechwright.units import Millimetres, Unit, convert

Word = Annotated[str, Field(max_length=200)]


class PlateParams(Parameters):
    """A drawing, and how it is to be read.

    Examples
    --------
    >>> PlateParams(thickness=6).thickness
    6.0
    """

    drawing: InputFile = Field(
        InputFile(),
        description="DXF file beside the design file; empty for a sample that shows what layers mean.",
        json_schema_extra=FIRST,
    )
    thickness: Millimetres = Field(
        10.0, ge=0.1, le=500, description="Thickness of the plate.", json_schema_extra=FIRST
    )
    material: MaterialName = Field("aluminium", description="Material.", json_schema_extra=FIRST)
    units: UnitName = Field(
        "drawing",
        description="Unit that it is drawn in; drawing: the one that it says itself.",
        json_schema_extra=FIRST,
    )
    scale: Annotated[float, Unit("")] = Field(
        1.0, ge=0.001, le=1000, description="Size of the plate over that of the drawing."
    )
    join: Millimetres = Field(
        0.01, ge=0.0001, le=1, description="Gaps in contours up to this are closed; wider ones are refused."
    )
    origin: Origin = Field(
        "drawing", description="Where the part's origin lies: as drawn, at its lower left corner, or centred."
    )
    layers: dict[str, Word] = Field(
        default_factory=dict,
        description='Meaning of layers or colours, as { "Layer 1" = "pocket 3", "colour 1" = "bore H7" }.',
        json_schema_extra=FIRST,
    )
    holes: dict[str, Word] = Field(
        default_factory=dict,
        description='Meaning of circles of a diameter, as { "5" = "bore H7", "4.2" = "M5" }.',
        json_schema_extra=FIRST,
    )

    def __hash__(self) -> int:
        return hash((self.drawing, self.thickness, self.material, self.asked))

    @model_validator(mode="after")
    def _diameters(self) -> Self:
        for text in self.holes:
            try:
                diameter = convert(text, "mm")
            except ValueError as error:
                raise ValueError(f"holes: {error}") from error
            if not 0 < diameter <= 1000:
                raise ValueError(f"holes: {text!r} is no diameter; above 0, and 1000 mm at most")
        return self

    @property
    def asked(self) -> Asked:
        """How the drawing is to be read."""
        holes = tuple((convert(diameter, "mm"), meant) for diameter, meant in self.holes.items())
        layers = tuple(self.layers.items())
        return Asked(self.units, self.scale, self.join, self.origin, layers, holes=holes)
