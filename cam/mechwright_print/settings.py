"""The keys of ``[print]``."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from mechwright.contracts.parameters import FIRST, GIVEN, Parameters
from mechwright.contracts.part import NAME_PATTERN
from mechwright.units import Millimetres, Ratio

PartName = Annotated[str, Field(pattern=f"^{NAME_PATTERN}$")]
PRINT = "print"
"""The name of the process, of its table and of its command."""
HoleKind = Literal["press", "snug", "sliding", "loose", "turning", "ream", "bush", "drawn"]
"""How a hole with a fit is printed: with a joint's clearance, for a reamer, for a bush, or as drawn."""


class PrintSettings(Parameters):
    """The table ``[print]``."""

    printer: str = Field(
        "",
        max_length=200,
        description="File of the printer beside the design. Default: published figures of printers.",
        json_schema_extra=FIRST,
    )
    fits: Literal["open", "ream", "drawn"] = Field(
        "open",
        description=(
            "Holes with a fit: open by the printer's clearance, for a reamer, or in their drawn size."
        ),
        json_schema_extra=FIRST,
    )
    holes: Mapping[str, HoleKind] = Field(
        default_factory=dict,
        description='Single holes, as { "crank.pin-1" = "press" }: part, point, name of the hole.',
    )
    threads: Literal["insert", "screw", "tap"] = Field(
        "insert",
        description="Threaded holes: for a heat-set insert, for a screw through, or for a tap.",
        json_schema_extra=FIRST,
    )
    compensate: Literal["model", "slicer"] = Field(
        "model", description="Who corrects the printer's deviations; the slicer's own have to be 0 for model."
    )
    flip: Annotated[tuple[PartName, ...], Field(max_length=200)] = Field(
        (), description="Parts that lie on their top face."
    )
    walls: int = Field(4, ge=1, le=50, description="Lines around each layer.", json_schema_extra=FIRST)
    skins: int = Field(5, ge=0, le=50, description="Full layers at each bottom and top.")
    infill: Annotated[Ratio, Field(ge=0, le=1)] = Field(
        0.3, description="Share of the inside that is filled.", json_schema_extra=FIRST
    )
    allowance: Millimetres = Field(0.4, ge=0.05, le=2, description="Stock for a reamer, on the diameter.")
    greatest_play: Millimetres | None = Field(
        None,
        gt=0,
        le=10,
        description="Most play of a shaft in a printed hole, on the diameter. Default: no limit.",
        json_schema_extra=GIVEN,
    )
    gap: Millimetres = Field(5.0, ge=0.5, le=100, description="Between two parts on the bed, at least.")
