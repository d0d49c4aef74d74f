"""A printer with one filament, one nozzle and one layer height: the file ``printer.toml``."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from mechwright.contracts.parameters import Parameters
from mechwright.units import Millimetres, Ratio
from mechwright_print.printer.facts import CLEARANCES, FILAMENTS, LINE, Filament, JointKind, hole_deviation

Off = Annotated[Millimetres, Field(ge=-2, le=2)]
Error = Annotated[Millimetres, Field(ge=0, le=2)]
Side = Annotated[Millimetres, Field(ge=-0.5, le=2)]

SIGMAS = 3.0
"""A printer's sizes lie within so many standard deviations."""


class Bed(Parameters):
    """The table ``[bed]``: what a print may fill."""

    x: Millimetres = Field(220.0, gt=0, le=2000, description="Width that can be printed.")
    y: Millimetres = Field(220.0, gt=0, le=2000, description="Depth that can be printed.")
    z: Millimetres = Field(250.0, gt=0, le=2000, description="Height that can be printed.")
    margin: Millimetres = Field(5.0, ge=0, le=100, description="Rim of the bed that stays free.")


class Deviation(Parameters):
    """The table ``[deviation]``: printed size less drawn size, after the scale."""

    hole: Off | None = Field(
        None, description="Diameter of round holes. Default: by diameter, as published of printers."
    )
    slot: Off = Field(-0.15, description="Width of slots and other openings.")
    pin: Off = Field(0.0, description="Diameter of round pins and rims.")
    wall: Off = Field(0.0, description="Width of walls, outlines and teeth.")
    foot: Annotated[Millimetres, Field(ge=0, le=1)] = Field(
        0.1, description="By how much the first layer stands out on each side."
    )
    scale_x: Annotated[Ratio, Field(ge=0.9, le=1.1)] = Field(
        1.0, description="Growth of lengths along X, 1 for none."
    )
    scale_y: Annotated[Ratio, Field(ge=0.9, le=1.1)] = Field(
        1.0, description="Growth of lengths along Y, 1 for none."
    )


class Uncertainty(Parameters):
    """The table ``[uncertainty]``: standard errors of the deviations, from the coupon."""

    hole: Error = Field(0.0, description="Of deviation.hole.")
    slot: Error = Field(0.0, description="Of deviation.slot.")
    pin: Error = Field(0.0, description="Of deviation.pin.")
    wall: Error = Field(0.0, description="Of deviation.wall.")
    foot: Error = Field(0.0, description="Of deviation.foot.")


class Clearances(Parameters):
    """The table ``[clearance]``: on each side, of shafts in holes that have their size."""

    press: Side = Field(CLEARANCES["press"], description="A shaft is driven in and stays.")
    snug: Side = Field(CLEARANCES["snug"], description="A shaft is pushed in by hand, and is located.")
    sliding: Side = Field(CLEARANCES["sliding"], description="A shaft slides along its axis.")
    loose: Side = Field(CLEARANCES["loose"], description="A shaft falls in.")
    turning: Side = Field(CLEARANCES["turning"], description="A shaft turns freely.")


class Printer(Parameters):
    """A printer as it is set up; the keys of ``printer.toml``."""

    name: str = Field("printer", max_length=60, description="On sheets.")
    filament: Literal["pla", "petg", "abs", "asa", "pa"] = Field("pla", description="Filament.")
    density: Annotated[Ratio, Field(gt=0, le=10)] | None = Field(
        None, description="Density of the filament in g/cm³. Default: by filament."
    )
    nozzle: Millimetres = Field(0.4, ge=0.1, le=2, description="Diameter of the nozzle.")
    layer: Millimetres = Field(0.2, ge=0.02, le=1.5, description="Height of a layer.")
    first_layer: Millimetres | None = Field(
        None, ge=0.02, le=1.5, description="Height of the first layer. Default: layer."
    )
    line: Millimetres | None = Field(
        None, ge=0.1, le=3, description="Width of a printed line. Default: 1.05 nozzle."
    )
    flow: Annotated[Ratio, Field(gt=0, le=200)] = Field(
        5.0, description="Filament laid down on the average, in mm³/s, for the time on the sheet."
    )
    spread: Error = Field(
        0.1, description="Standard deviation of a size from one print, or one place, to the next."
    )
    measured: bool = Field(False, description="Whether the figures are those of a measured coupon.")
    bed: Bed = Field(default_factory=Bed, description="Room for a print.")
    deviation: Deviation = Field(default_factory=Deviation, description="Printed size less drawn size.")
    uncertainty: Uncertainty = Field(
        default_factory=Uncertainty, description="Standard errors of the deviations."
    )
    clearance: Clearances = Field(default_factory=Clearances, description="Clearances on each side.")

    @property
    def material(self) -> Filament:
        """The filament."""
        return FILAMENTS[self.filament]

    @property
    def grams_per_mm3(self) -> float:
        """Density of the filament, g/mm³."""
        return (self.material.density if self.density is None else self.density) / 1000

    @property
    def first(self) -> float:
        """Height of the first layer, mm."""
        return self.layer if self.first_layer is None else self.first_layer

    @property
    def line_width(self) -> float:
        """Width of a printed line, mm."""
        return LINE * self.nozzle if self.line is None else self.line

    def hole_off(self, diameter: float) -> float:
        """Deviation of a round hole of that diameter, mm."""
        return hole_deviation(diameter) if self.deviation.hole is None else self.deviation.hole

    def side_clearance(self, kind: JointKind) -> float:
        """Clearance on each side, mm; other filaments than PLA take more where no coupon was measured."""
        own: float = getattr(self.clearance, kind)
        return own if self.measured else own + self.material.more

    def scatter(self, *others: Literal["hole", "slot", "pin", "wall"]) -> float:
        """Half the range of what is between sizes of these kinds, mm: three standard deviations.

        The spread of each size and the standard error of its deviation are independent, and add as squares.
        """
        errors: Mapping[str, float] = self.uncertainty.model_dump()
        variance = sum(self.spread**2 + errors[one] ** 2 for one in others)
        return float(SIGMAS * variance**0.5)
